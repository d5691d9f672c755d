// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "disflow/depth/depth_frame.h"
#include "disflow/hal/fault.h"
#include "disflow/host/png_image.h"

namespace disflow::posix {

/// A sensor_msgs/Image as it came; nothing of it is trusted.
struct RosImage {
  std::string_view encoding;
  std::uint32_t width_px = 0;
  std::uint32_t height_px = 0;
  std::uint32_t step_bytes = 0;  ///< From one row's start to the next's.
  bool is_big_endian = false;
  std::span<std::uint8_t> data;
};

/// Makes depth images of ROS messages: REP 118's 16UC1 (millimetres) and 32FC1 (metres), and what
/// compressed_depth_image_transport makes of them. Bounded in everything; once the size is fixed,
/// no memory is got beside libpng's own.
/// Faults: kUnsupported for what no later message will better (encoding, codec), kImageTooLarge for
/// another size than the fixed one or a size beyond all bounds, kTruncated and kCorrupt for a
/// message that contradicts itself.
class RosDepthDecoder {
 public:
  /// From now on images must be of this size.
  void FixSize(int width_px, int height_px) noexcept {
    width_px_ = width_px;
    height_px_ = height_px;
  }

  /// @param image Its data are put into this machine's byte order, and rows that begin at odd
  /// addresses close together.
  /// @param depth Points into the image's data.
  [[nodiscard]] hal::Fault Decode(const RosImage& image, DepthView& depth) const noexcept;

  /// @param format,data Of a sensor_msgs/CompressedImage: twelve bytes of parameters and a PNG.
  /// @param depth Points into this, valid until the next call.
  [[nodiscard]] hal::Fault DecodeCompressed(std::string_view format,
                                            std::span<const std::uint8_t> data,
                                            DepthView& depth) noexcept;

  /// @return Bytes that the data of a compressed image of this size cannot exceed, unless its
  /// sender does not want to compress.
  [[nodiscard]] static std::size_t MostCompressedBytes(int width_px, int height_px) noexcept;

 private:
  [[nodiscard]] hal::Fault CheckSize(std::uint32_t width_px,
                                     std::uint32_t height_px) const noexcept;
  [[nodiscard]] hal::Fault CheckHeader(std::span<const std::uint8_t> png) const noexcept;

  int width_px_ = 0;  ///< 0: not fixed.
  int height_px_ = 0;
  host::GrayImage picture_;
  std::vector<float> metres_;
};

}  // namespace disflow::posix
