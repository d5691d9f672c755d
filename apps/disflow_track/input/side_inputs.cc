// SPDX-License-Identifier: BSD-3-Clause
#include "input/side_inputs.h"

#include <cmath>
#include <utility>

#include "settings/camera_in_body.h"
#include "settings/dds_address.h"

namespace disflow::apps {
namespace {

/// By how much the clock of another machine may be ahead although both are kept in step.
constexpr std::int64_t kMaxLead_ns = 50'000'000;
/// Some nodes of ROS date a transform to when it ceases to hold.
constexpr std::int64_t kMaxTfLead_ns = 1'000'000'000;

/// @param on_time What arrives can be compared with the time of now.
hal::CameraPoseHistory::Settings PoseSettings(const CameraPoseOptions& options, bool on_time) {
  hal::CameraPoseHistory::Settings settings{.T_bc = CameraInBody(options).Cast<float>()};
  // Nobody knows where the carrier will be; but what is sent to a replay may come at any pace.
  if (on_time) settings.max_lead_ns = kMaxLead_ns;
  return settings;
}

std::string Line(const std::string& name,
                 std::initializer_list<std::pair<const char*, std::uint32_t>> counts) {
  std::string line = name + ":";
  for (const auto& [what, count] : counts) {
    line.append(line.back() == ':' ? " " : ", ")
        .append(std::to_string(count))
        .append(" ")
        .append(what);
  }
  return line;
}

}  // namespace

SideInputs::SideInputs(const Options& options, const hal::SensorInfo& sensor) {
  if (!options.mask_stream.empty()) {
    masks_ = posix::MakeMaskSource(options.mask_stream, sensor.width_px, sensor.height_px,
                                   std::llround(options.mask_max_age_s * 1e9));
  }
  if (options.camera_pose.system_id != 0) {
    poses_.emplace(PoseSettings(options.camera_pose, sensor.has_monotonic_stamps()));
  }
  if (options.dds_link.empty()) return;
  const DdsAddress address = ParseDdsAddress(options.dds_link);
  if (!address.mask_topic.empty()) {
    auto mailbox =
        std::make_unique<MaskMailbox>(address.mask_topic, sensor.width_px, sensor.height_px,
                                      std::llround(options.mask_max_age_s * 1e9));
    mask_mailbox_ = mailbox.get();
    masks_ = std::move(mailbox);
  }
  if (!address.world_frame.empty()) {
    // tf leads to the optical frame itself.
    hal::CameraPoseHistory::Settings settings;
    if (sensor.live) settings.max_lead_ns = kMaxTfLead_ns;
    poses_.emplace(settings);
    pose_mailbox_.emplace();
  }
}

void SideInputs::Attach(DepthFrame& frame, Console& console) noexcept {
  if (masks_) TellOfMasks(masks_->Attach(frame), frame.depth, console);
  if (pose_mailbox_) pose_mailbox_->MoveTo(*poses_, frame.stamp_ns);
  if (poses_) frame.has_T_wc = poses_->At(frame.stamp_ns, frame.T_wc) == Status::kOk;
}

void SideInputs::TellOfMasks(Status status, const DepthView& depth, Console& console) noexcept {
  // A writer that is wrong now in one way, now in the other must not fill the log: each is said
  // once.
  if (status == Status::kMaskSizeMismatch && !std::exchange(said_wrong_size_, true)) {
    console.Say(masks_->name() + ": masks are not as large as the depth images (" +
                std::to_string(depth.width_px) + " x " + std::to_string(depth.height_px) +
                "); frames go without");
  } else if (status == Status::kCorrupt && !std::exchange(said_corrupt_, true)) {
    console.Say(masks_->name() + ": is no mask stream, see docs/masks.md; frames go without");
  }
}

std::vector<std::string> SideInputs::Summary() const {
  std::vector<std::string> lines;
  if (masks_) {
    const posix::MaskCounters& counters = masks_->counters();
    lines.push_back(Line("masks from " + masks_->name(), {{"used", counters.used},
                                                          {"missing", counters.missing},
                                                          {"late", counters.late},
                                                          {"torn", counters.torn},
                                                          {"of another size", counters.wrong_size},
                                                          {"corrupt", counters.corrupt}}));
  }
  if (poses_) {
    const hal::CameraPoseHistory::Counters& counters = poses_->counters();
    lines.push_back(Line("camera poses", {{"received", counters.poses},
                                          {"refused", counters.refused},
                                          {"of them for their stamp", counters.wrong_stamp},
                                          {"jumps", counters.jumps},
                                          {"frames matched", counters.matched},
                                          {"of them extrapolated", counters.continued},
                                          {"frames without", counters.unmatched}}));
  }
  return lines;
}

}  // namespace disflow::apps
