// SPDX-License-Identifier: BSD-3-Clause
#include <array>
#include <cstring>
#include <vector>

#include "depth_image_check.h"
#include "disflow/posix/ros/ros_camera_info.h"
#include "disflow/posix/ros/ros_depth_decoder.h"
#include "file_in_memory.h"
#include "fuzzed_numbers.h"

namespace {

using namespace disflow;
using fuzz::FuzzedNumbers;
using fuzz::Require;

void CheckImage(const hal::Fault& fault, const DepthView& depth) {
  Require(fault.ok() == (fault.message[0] == '\0'));
  for (const char* c = fault.message; *c != '\0'; ++c) Require(*c >= ' ' && *c <= '~');
  if (fault.ok()) fuzz::CheckDepth(depth);
}

void CheckPlain(FuzzedNumbers& input, posix::RosDepthDecoder& decoder) {
  const std::string encoding = input.TakeText();
  posix::RosImage image{.encoding = encoding,
                        .width_px = input.Take<std::uint32_t>(),
                        .height_px = input.Take<std::uint32_t>(),
                        .step_bytes = input.Take<std::uint32_t>(),
                        .is_big_endian = input.Take<std::uint8_t>() % 2 != 0,
                        .data = {}};
  image.data = input.rest();
  DepthView depth;
  const hal::Fault fault = decoder.Decode(image, depth);
  CheckImage(fault, depth);
}

void CheckPacked(FuzzedNumbers& input, posix::RosDepthDecoder& decoder) {
  const std::string format = input.TakeText();
  DepthView depth;
  const hal::Fault fault = decoder.DecodeCompressed(format, input.rest(), depth);
  CheckImage(fault, depth);
}

void CheckInfo(FuzzedNumbers& input) {
  const std::string model = input.TakeText();
  posix::RosIntrinsics intrinsics;
  const auto k = input.Take<std::array<double, 9>>();
  const auto p = input.Take<std::array<double, 12>>();
  const auto numbers = input.Take<std::array<std::uint32_t, 8>>();
  const bool rectified = input.Take<std::uint8_t>() % 2 != 0;
  std::vector<double> d(input.rest().size() / sizeof(double));
  if (!d.empty()) std::memcpy(d.data(), input.rest().data(), d.size() * sizeof(double));
  const hal::Fault fault = posix::ReadCameraInfo({.width_px = numbers[0],
                                                  .height_px = numbers[1],
                                                  .distortion_model = model,
                                                  .d = d,
                                                  .k = std::span<const double, 9>(k),
                                                  .p = std::span<const double, 12>(p),
                                                  .binning_x = numbers[2],
                                                  .binning_y = numbers[3],
                                                  .roi_x_px = numbers[4],
                                                  .roi_y_px = numbers[5],
                                                  .roi_width_px = numbers[6],
                                                  .roi_height_px = numbers[7]},
                                                 rectified, intrinsics);
  Require(fault.ok() == intrinsics.camera.IsValid());
}

}  // namespace

/// The first byte chooses the message and whether the size is fixed.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  FuzzedNumbers input(data + 1, size - 1);
  posix::RosDepthDecoder decoder;
  if ((data[0] & 4U) != 0) decoder.FixSize(8, 6);
  switch (data[0] % 4) {
    case 0:
      CheckPlain(input, decoder);
      break;
    case 1:
      CheckPacked(input, decoder);
      break;
    default:
      CheckInfo(input);
      break;
  }
  return 0;
}
