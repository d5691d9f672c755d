// SPDX-License-Identifier: BSD-3-Clause
#include "dds/dds_output.h"

#include <atomic>
#include <chrono>
#include <deque>
#include <optional>
#include <thread>

#include "dds/dds_inputs.h"
#include "dds/dds_lifecycle.h"
#include "dds/dds_object.h"
#include "dds/dds_parameters.h"
#include "disflow/posix/monotonic_clock.h"
#include "input/ros_node_options.h"
#include "program/exit_status.h"
#include "settings/dds_address.h"

namespace disflow::apps {

/// The node, its objects and the thread that serves them.
class DdsPublisher {
 public:
  DdsPublisher(const std::string& uri, std::span<ObjectChannel* const> channels,
               const hal::SensorInfo& sensor, SideInputs& inputs,
               std::shared_ptr<posix::RosNode> node)
      : uri_(uri), clock_(StampsOf(sensor)), node_(std::move(node)) {
    DdsAddress address = ParseDdsAddress(uri);
    if (node_ && node_->options().network.domain == address.domain) {
      address.name = node_->options().name;  // which the sensor's address may have said
    } else {
      node_ = std::make_shared<posix::RosNode>();
      RequireLink(node_->Open(NodeOptions(address)));
    }
    RequireLink(node_->Advertise("/tf", posix::RosQos::kReliable, transforms_));
    const ImageSize image{sensor.width_px, sensor.height_px};
    for (ObjectChannel* const channel : channels) {
      objects_.emplace_back(address, image, objects_.empty(), *channel, signal_, clock_, *node_,
                            transforms_, counters_);
    }
    if (address.may_set) parameters_.emplace(node_->full_name(), channels, *node_);
    if (address.may_pause) lifecycle_.emplace(node_->full_name(), channels, *node_);
    inputs_.emplace(address, *node_, inputs.pose_mailbox(), inputs.mask_mailbox());
    RequireLink(node_->Announce());
    thread_ = std::thread([this] { Serve(); });
  }
  DdsPublisher(const DdsPublisher&) = delete;
  DdsPublisher& operator=(const DdsPublisher&) = delete;
  ~DdsPublisher() { Finish(); }

  void Finish() {
    if (!thread_.joinable()) return;
    stop_ = true;
    signal_.Raise();
    thread_.join();
  }

  [[nodiscard]] std::string Summary() const {
    std::uint64_t lost = 0;
    for (const DdsObject& object : objects_) lost += object.lost();
    return uri_ + ": " + std::to_string(counters_.sent) + " messages sent, " +
           std::to_string(counters_.failed) + " failed, " + std::to_string(lost) +
           " results too late to be sent";
  }

 private:
  [[nodiscard]] static DdsClock::Stamps StampsOf(const hal::SensorInfo& sensor) noexcept {
    if (sensor.has_monotonic_stamps()) return DdsClock::Stamps::kMonotonic;
    return sensor.epoch_stamps ? DdsClock::Stamps::kRos : DdsClock::Stamps::kSequence;
  }

  static constexpr std::int64_t kPatience_ns = 5'000'000;
  static constexpr std::int64_t kFarewell_ns = 1'000'000'000;
  static constexpr int kTurns = 75;
  static constexpr std::chrono::milliseconds kTurn{20};
  static constexpr std::chrono::milliseconds kSettle{250};

  void RequireLink(const hal::Fault& fault) const {
    if (!fault.ok()) throw Failure(kOutputFailed, "link '" + uri_ + "': " + fault.message);
  }

  /// Who was there before needs a moment to find this node, and is to miss nothing: results wait in
  /// their queues meanwhile.
  void AwaitListeners() {
    for (int i = 0; i < kTurns && !node_->HasListeners(); ++i) std::this_thread::sleep_for(kTurn);
    // They find one topic after the other.
    if (node_->HasListeners()) std::this_thread::sleep_for(kSettle);
  }

  void Serve() {
    AwaitListeners();
    while (!stop_) {
      // Also without news: requests do not raise the signal.
      (void)signal_.WaitFor(kPatience_ns);
      inputs_->Turn(clock_);
      for (DdsObject& object : objects_) object.Turn(steady_.NowNs());
      if (parameters_) parameters_->Turn();
      if (lifecycle_) lifecycle_->Turn();
    }
    for (DdsObject& object : objects_) object.Finish(steady_.NowNs());
    node_->WaitForAcknowledgments(kFarewell_ns);
  }

  std::string uri_;
  NewsSignal signal_;
  DdsClock clock_;
  posix::MonotonicClock steady_;
  std::shared_ptr<posix::RosNode> node_;
  DdsObject::TransformPublisher transforms_;
  DdsCounters counters_;
  std::deque<DdsObject> objects_;
  // Not there unless the address allows it.
  std::optional<DdsParameters> parameters_;
  std::optional<DdsLifecycle> lifecycle_;
  std::optional<DdsInputs> inputs_;
  std::atomic<bool> stop_ = false;
  std::thread thread_;
};

DdsOutput::DdsOutput(const std::string& uri, std::span<ObjectChannel* const> objects,
                     const hal::SensorInfo& sensor, SideInputs& inputs,
                     std::shared_ptr<posix::RosNode> node) {
  if (uri.empty()) return;
  publisher_ = std::make_unique<DdsPublisher>(uri, objects, sensor, inputs, std::move(node));
}

DdsOutput::~DdsOutput() = default;

void DdsOutput::Finish() {
  if (publisher_) publisher_->Finish();
}

std::vector<std::string> DdsOutput::Summary() const {
  if (!publisher_) return {};
  return {publisher_->Summary()};
}

}  // namespace disflow::apps
