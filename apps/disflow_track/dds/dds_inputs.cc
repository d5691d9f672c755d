// SPDX-License-Identifier: BSD-3-Clause
#include "dds/dds_inputs.h"

#include <string_view>

#include "program/exit_status.h"

namespace disflow::apps {
namespace {

namespace ros = posix::ros;
using posix::RosQos;

}  // namespace

void PutMask(const ros::Image& image, const DdsClock& clock, MaskMailbox& masks) {
  const std::string_view encoding = posix::TextOf(image.encoding);
  const bool is_mask = encoding == "mono8" || encoding == "8UC1";
  masks.Put(clock.FromRos(posix::RosNanoseconds(image.header.stamp)), is_mask ? image.width : 0,
            is_mask ? image.height : 0, image.step, {image.data._buffer, image.data._length});
}

posix::RosTransform TransformOf(const ros::TransformStamped& message) noexcept {
  const auto& [translation, rotation] = message.transform;
  return {posix::TextOf(message.header.frame_id),
          posix::TextOf(message.child_frame_id),
          {rotation.w, rotation.x, rotation.y, rotation.z},
          {translation.x, translation.y, translation.z},
          posix::RosNanoseconds(message.header.stamp)};
}

DdsInputs::DdsInputs(const DdsAddress& address, posix::RosNode& node, PoseMailbox* poses,
                     MaskMailbox* masks)
    : poses_(poses), masks_(masks), transforms_(address.world_frame, address.camera_frame) {
  if (poses_ != nullptr) {
    Require(tf_.Subscribe(node, "/tf", RosQos::kReliable));
    Require(tf_static_.Subscribe(node, "/tf_static", RosQos::kLatchedMany));
  }
  // Best effort takes from reliable writers too.
  if (masks_ != nullptr) {
    Require(node.Subscribe(address.mask_topic, RosQos::kSensorData, images_));
  }
}

void DdsInputs::Turn(const DdsClock& clock) {
  if (poses_ != nullptr) TakeTransforms(clock);
  if (masks_ == nullptr) return;
  images_.TakeAll([this, &clock](const ros::Image& image) {
    if (clock.known()) PutMask(image, clock, *masks_);
  });
}

void DdsInputs::TakeTransforms(const DdsClock& clock) {
  const auto add = [this, &clock](const ros::TFMessage& message, bool fixed) {
    for (std::uint32_t i = 0; i < message.transforms._length; ++i) {
      transforms_.Add(TransformOf(message.transforms._buffer[i]), fixed);
    }
    // After every message: each is a moment of its own.
    const auto camera = transforms_.Camera();
    if (!camera || !clock.known()) return;
    poses_->Put(clock.FromRosOfOthers(camera->ros_ns), camera->T_wc);
  };
  tf_static_.TakeAll([&add](const ros::TFMessage& message) { add(message, true); });
  tf_.TakeAll([&add](const ros::TFMessage& message) { add(message, false); });
}

}  // namespace disflow::apps
