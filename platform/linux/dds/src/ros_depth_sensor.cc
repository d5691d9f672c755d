// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/posix/dds/ros_depth_sensor.h"

#include <algorithm>

#include "disflow/saturating.h"

namespace disflow::posix {
namespace {

using hal::Fault;
using hal::MakeFault;

constexpr std::int64_t kOpenTurn_ns = 200'000'000;
/// As of a camera that stalls.
constexpr std::int64_t kSilence_ns = 2'000'000'000;
/// A writer that is always faster than the reader must not keep it for ever.
constexpr int kMostAtOnce = 8;

/// Whether no later message will better it.
bool IsForGood(Status status) noexcept {
  return status == Status::kUnsupported || status == Status::kInvalidIntrinsics ||
         status == Status::kImageTooLarge || status == Status::kIoError;
}

RosCameraInfo InfoOf(const ros::CameraInfo& message) noexcept {
  return {.width_px = message.width,
          .height_px = message.height,
          .distortion_model = TextOf(message.distortion_model),
          .d = {message.d._buffer, message.d._length},
          .k = std::span<const double, 9>(message.k),
          .p = std::span<const double, 12>(message.p),
          .binning_x = message.binning_x,
          .binning_y = message.binning_y,
          .roi_x_px = message.roi.x_offset,
          .roi_y_px = message.roi.y_offset,
          .roi_width_px = message.roi.width,
          .roi_height_px = message.roi.height};
}

}  // namespace

RosDepthSensor::RosDepthSensor(std::shared_ptr<RosNode> node, const Options& options)
    : node_(std::move(node)), options_(options), name_("dds:" + options.depth_topic) {}

Fault RosDepthSensor::Subscribe() {
  if (subscribed_) return {};
  Fault fault = images_.Subscribe(*node_, options_.depth_topic);
  if (fault.ok()) fault = infos_.Subscribe(*node_, options_.info_topic, RosQos::kLatched);
  if (fault.ok()) {
    fault = wait_.Open(node_->participant(),
                       {images_.reader(), infos_.wanted_reader(), infos_.all_reader()});
  }
  if (fault.ok()) fault = node_->Announce();
  intrinsics_fault_ = MakeFault(Status::kNotFound, "has not come");
  subscribed_ = fault.ok();
  return fault;
}

Fault RosDepthSensor::DoOpen() noexcept {
  if (open_) return {};
  if (const Fault fault = Subscribe(); !fault.ok()) return fault;
  if (lost_) return Reopen();
  const std::int64_t deadline_ns = clock_.NowNs() + kOpenTurn_ns;
  Fault reason;
  for (;;) {
    TakeInfos();
    Fault fault = TakeImages();
    if (pending_) fault = JudgePending();
    open_ = pending_ && fault.ok();
    if (open_ || IsForGood(fault.status)) return fault;
    if (!fault.ok()) reason = fault;
    const std::int64_t now_ns = clock_.NowNs();
    if (now_ns < deadline_ns) {
      wait_.For(deadline_ns - now_ns);
      continue;
    }
    return reason.ok() ? Missing() : MakeFault(Status::kNotFound, "%s", reason.message);
  }
}

/// The publisher was gone, and may be back as another one.
Fault RosDepthSensor::Reopen() {
  if (images_.writers() == 0) return Missing();
  ForgetIntrinsics();
  AddSaturating(counters_.reconnects);
  lost_ = false;
  open_ = true;
  alive_ns_ = clock_.NowNs();
  return {};
}

/// Who publishes images now may have other intrinsics; but whoever published them once and has been
/// there all the time does not say them again.
void RosDepthSensor::ForgetIntrinsics() {
  if (!lost_infos_.empty() && infos_.WantedWriters() == lost_infos_) return;
  intrinsics_fault_ = MakeFault(Status::kNotFound, "has not come");
}

void RosDepthSensor::TakeInfos() {
  infos_.TakeAll([this](const ros::CameraInfo& message) {
    intrinsics_fault_ = ReadCameraInfo(InfoOf(message), options_.rectified, intrinsics_);
  });
}

/// Empties the reader's queue and keeps the last good image.
/// @return Why there is no image, if what came is of no use.
Fault RosDepthSensor::TakeImages() {
  Fault verdict;
  RosDepthTopic::Image image;
  for (int i = 0; i < kMostAtOnce && images_.Take(image); ++i) {
    alive_ns_ = clock_.NowNs();
    silent_ = false;
    if (!image.fault.ok()) {
      verdict = Refuse(image.fault);
      continue;
    }
    // Before the first frame nobody misses any.
    if (pending_ && open_) AddSaturating(counters_.skipped);
    if (width_px_ == 0) FixSize(image.depth);
    images_.Keep();
    newest_ = image;
    pending_ = true;
  }
  return verdict;
}

/// The first image says how large all are.
void RosDepthSensor::FixSize(const DepthView& depth) {
  images_.FixSize(depth);
  width_px_ = depth.width_px;
  height_px_ = depth.height_px;
}

Fault RosDepthSensor::Refuse(const Fault& fault) {
  AddSaturating(counters_.corrupt);
  if (fault.status == Status::kTruncated) AddSaturating(counters_.short_frames);
  return MakeFault(fault.status, "%s: %s", name_.c_str(), fault.message);
}

/// Whether the image that waits has intrinsics that belong to it.
Fault RosDepthSensor::JudgePending() const {
  const char* const topic = options_.info_topic.c_str();
  if (!intrinsics_fault_.ok()) {
    return MakeFault(intrinsics_fault_.status, "%s: %s", topic,
                     intrinsics_fault_.status == Status::kNotFound && infos_.writers() == 0
                         ? "nobody publishes this sensor_msgs/msg/CameraInfo"
                         : intrinsics_fault_.message);
  }
  const DepthView& depth = newest_.depth;
  if (intrinsics_.width_px == static_cast<std::uint32_t>(depth.width_px) &&
      intrinsics_.height_px == static_cast<std::uint32_t>(depth.height_px)) {
    return {};
  }
  return MakeFault(Status::kCorrupt,
                   "%s: is of images of %u x %u pixels, but those of %s have %d x %d", topic,
                   intrinsics_.width_px, intrinsics_.height_px, options_.depth_topic.c_str(),
                   depth.width_px, depth.height_px);
}

Fault RosDepthSensor::Missing() const {
  const std::uint32_t writers = images_.writers();
  if (writers == 0) {
    return MakeFault(Status::kNotFound, "%s: nobody publishes this %s in domain %u", name_.c_str(),
                     images_.type(), static_cast<unsigned>(node_->options().network.domain));
  }
  return MakeFault(Status::kNotFound,
                   "%s: its %u publishers have sent nothing yet, or nothing that came through "
                   "(rmem_max in docs/ros2.md)",
                   name_.c_str(), writers);
}

Fault RosDepthSensor::DoNext(std::int64_t timeout_ns, DepthFrame& frame) noexcept {
  if (!open_) {
    return MakeFault(lost_ ? Status::kDeviceLost : Status::kNotOpen, "%s: %s", name_.c_str(),
                     lost_ ? "its publisher is gone" : "is not open");
  }
  const std::int64_t deadline_ns = clock_.NowNs() + timeout_ns;
  for (;;) {
    TakeInfos();
    const Fault taken = TakeImages();
    if (pending_) {
      const Fault judged = JudgePending();
      if (judged.ok()) {
        Lend(frame);
        return {};
      }
      // The intrinsics may be just behind their image.
      if (judged.status != Status::kNotFound) {
        pending_ = false;
        AddSaturating(counters_.corrupt);
        return MakeFault(Status::kCorrupt, "%s", judged.message);
      }
    }
    if (!taken.ok()) {
      const bool is_short = taken.status == Status::kTruncated;
      return MakeFault(is_short ? Status::kTruncated : Status::kCorrupt, "%s", taken.message);
    }
    const std::int64_t now_ns = clock_.NowNs();
    if (const Fault fault = Silence(now_ns, deadline_ns); !fault.ok()) return fault;
    wait_.For(deadline_ns - now_ns);
  }
}

/// Nothing came: is there anybody, and how long has it been?
Fault RosDepthSensor::Silence(std::int64_t now_ns, std::int64_t deadline_ns) {
  if (images_.writers() == 0) {
    open_ = false;
    lost_ = true;
    pending_ = false;
    lost_infos_ = infos_.WantedWriters();
    return MakeFault(Status::kDeviceLost, "%s: its publisher is gone", name_.c_str());
  }
  if (now_ns < deadline_ns) return {};
  if (!silent_ && now_ns - alive_ns_ > kSilence_ns) {
    silent_ = true;
    AddSaturating(counters_.restarts);
    return MakeFault(Status::kTimeout, "%s: its publisher is there, but no image has come for 2 s",
                     name_.c_str());
  }
  return MakeFault(Status::kTimeout, "%s: no image came in time", name_.c_str());
}

void RosDepthSensor::Lend(DepthFrame& frame) {
  frame = {};
  frame.depth = newest_.depth;
  frame.camera = intrinsics_.camera;
  frame.stamp_ns = newest_.stamp_ns;
  pending_ = false;
  AddSaturating(counters_.frames);
}

void RosDepthSensor::DoClose() noexcept {
  if (lost_) ForgetIntrinsics();
  open_ = false;
  lost_ = false;
  pending_ = false;
}

hal::SensorInfo RosDepthSensor::DoInfo() const noexcept {
  hal::SensorInfo info;
  info.name = name_.c_str();
  info.width_px = width_px_;
  info.height_px = height_px_;
  info.live = true;
  info.epoch_stamps = true;
  return info;
}

hal::SensorCounters RosDepthSensor::DoCounters() const noexcept {
  hal::SensorCounters counters = counters_;
  counters.dropped = counters.skipped;  // nobody tells what was lost on the way
  return counters;
}

}  // namespace disflow::posix
