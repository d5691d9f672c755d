// SPDX-License-Identifier: BSD-3-Clause
#include "dds/dds_status.h"

#include <charconv>

#include "program/status_token.h"

namespace disflow::apps {
namespace {

namespace ros = posix::ros;

enum Level : std::uint8_t { kOk = 0, kWarn = 1, kError = 2 };

Level LevelOf(const Estimate& estimate) noexcept {
  if (estimate.state == TrackingState::kLost) return kError;
  const bool measured = KindOf(estimate) == EstimateKind::kMeasured;
  return measured && estimate.state != TrackingState::kDegraded ? kOk : kWarn;
}

std::string Text(float value) {
  std::array<char, 32> text;
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value).ptr;
  return {text.data(), end};
}

}  // namespace

ros::DiagnosticArray DdsStatus::Message(const FrameResult& result, std::uint32_t lost,
                                        std::int64_t ros_ns, const DdsFrames& frames) {
  const Estimate estimate = Published(result.estimate);
  message_ = std::string(Name(estimate.state)) + ", " + StatusToken(estimate.status);
  pairs_.clear();
  Add("frame", std::to_string(result.frame));
  Add("kind", Name(KindOf(estimate)));
  Add("state", Name(estimate.state));
  Add("status", StatusToken(estimate.status));
  Add("quality", std::to_string(estimate.quality));
  Add("reset_counter", std::to_string(estimate.reset_counter));
  Add("score", Text(estimate.score));
  Add("rms_m", Text(estimate.rms_m));
  Add("samples", std::to_string(estimate.samples));
  Add("inliers", std::to_string(estimate.inliers));
  Add("edge_inliers", std::to_string(estimate.edge_inliers));
  Add("conflict", Text(estimate.conflict));
  Add("visible", Text(estimate.visible));
  Add("weak", Name(estimate.weak.kind));
  Add("weak_std", Text(estimate.weak.std));
  Add("total_ms", Text(static_cast<float>(static_cast<double>(result.total_ns) * 1e-6)));
  Add("frames", std::to_string(result.totals.frames));
  Add("frames_rejected", std::to_string(result.totals.frames_rejected));
  Add("frames_unregistered", std::to_string(result.totals.frames_unregistered));
  Add("clusters_evicted", std::to_string(result.totals.clusters_evicted));
  Add("model_coarseness", Text(result.model_coarseness));
  Add("sensor_dropped", std::to_string(result.sensor.dropped));
  Add("results_lost", std::to_string(lost));

  values_.clear();
  for (const auto& [key, value] : pairs_) values_.push_back({posix::Lend(key), posix::Lend(value)});
  status_.resize(1);
  status_[0] = {
      LevelOf(estimate), posix::Lend(name_), posix::Lend(message_), posix::Lend(hardware_), {}};
  posix::Lend(values_, status_[0].values);
  ros::DiagnosticArray message{};
  message.header = RosHeader(ros_ns, frames.camera);
  posix::Lend(status_, message.status);
  return message;
}

void DdsStatus::Add(const char* key, std::string value) {
  pairs_.push_back({key, std::move(value)});
}

}  // namespace disflow::apps
