// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "disflow/depth/depth_frame.h"
#include "disflow/hal/fault.h"
#include "disflow/posix/dds/ros_node.h"
#include "disflow/posix/ros/ros_depth_decoder.h"

namespace disflow::posix {

/// The depth images of one topic. Two are in memory at a time: one that is kept, and one that is
/// just coming in.
class RosDepthTopic {
 public:
  struct Image {
    hal::Fault fault;  ///< Why it cannot be used; the rest is meaningless then.
    StampNs stamp_ns = 0;
    DepthView depth;
  };

  /// @param topic `…/compressedDepth` brings sensor_msgs/CompressedImage, others sensor_msgs/Image.
  [[nodiscard]] hal::Fault Subscribe(RosNode& node, const std::string& topic);

  /// Takes the oldest image that waits; never waits itself.
  /// @param image Points to memory of this, valid until the next call.
  /// @return false if there is none.
  [[nodiscard]] bool Take(Image& image) noexcept;
  /// The image just taken stays valid until Take() was called after the next Keep().
  void Keep() noexcept { back_ = 1 - back_; }
  /// From now on images must be as large as this one, the one just taken; they go into memory that
  /// is got here.
  void FixSize(const DepthView& depth);

  [[nodiscard]] std::uint32_t writers() const noexcept {
    return compressed_ ? packed_.writers() : plain_.writers();
  }
  [[nodiscard]] dds_entity_t reader() const noexcept {
    return compressed_ ? packed_.reader() : plain_.reader();
  }
  /// The type that is wanted, as ROS names it.
  [[nodiscard]] const char* type() const noexcept {
    return compressed_ ? "sensor_msgs/msg/CompressedImage" : "sensor_msgs/msg/Image";
  }

 private:
  struct Slot {
    RosSample<ros::Image> plain;
    RosSample<ros::CompressedImage> packed;
    std::vector<std::uint8_t> bytes;
    RosDepthDecoder decoder;
  };

  [[nodiscard]] bool TakePlain(Slot& slot, Image& image) noexcept;
  [[nodiscard]] bool TakePacked(Slot& slot, Image& image) noexcept;

  bool compressed_ = false;
  RosSubscription<ros::Image> plain_;
  RosSubscription<ros::CompressedImage> packed_;
  std::array<Slot, 2> slots_;
  std::size_t back_ = 0;
};

}  // namespace disflow::posix
