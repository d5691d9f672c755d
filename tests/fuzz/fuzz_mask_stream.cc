// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cstring>
#include <vector>

#include "disflow/posix/mask_stream.h"
#include "file_in_memory.h"

/// The shared memory of a hostile writer; the magic is right more often than chance would have it.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace disflow;
  constexpr int kWidth = 16;
  constexpr int kHeight = 12;
  static fuzz::FileInMemory file;
  static std::uint16_t pixels[kWidth * kHeight] = {};
  std::vector<std::uint8_t> bytes(data, data + size);
  if (size > 8 && data[size - 1] % 4 != 0) {
    std::memcpy(bytes.data(), posix::MaskHeader::kMagic, 8);
  }
  file.Fill(bytes.data(), bytes.size());
  posix::MaskStream stream("file:" + file.path(), kWidth, kHeight, 100'000'000);
  for (const StampNs stamp_ns : {StampNs{0}, StampNs{1} << 62}) {
    DepthFrame frame;
    frame.depth = {pixels, kWidth, kHeight, kWidth * 2, DepthFormat::kUint16, 0.001F};
    frame.stamp_ns = stamp_ns;
    const Status status = stream.Attach(frame);
    fuzz::Require((status == Status::kOk) == frame.mask.given());
    if (!frame.mask.given()) continue;
    fuzz::Require(frame.mask.width_px == kWidth && frame.mask.height_px == kHeight);
    unsigned sum = 0;
    for (int v = 0; v < kHeight; ++v) {
      for (int u = 0; u < kWidth; ++u) sum += frame.mask.row(v)[u];
    }
    fuzz::Require(sum <= 255U * kWidth * kHeight);
  }
  return 0;
}
