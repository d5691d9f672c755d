// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "disflow/posix/mask_source.h"
#include "disflow/posix/triple_buffer.h"
#include "disflow/saturating.h"

namespace disflow::apps {

/// The newest mask on its way from another thread of this program to the tracking thread. Neither
/// side waits for the other's copying.
class MaskMailbox final : public posix::MaskSource {
 public:
  MaskMailbox(const std::string& name, int width_px, int height_px, std::int64_t max_age_ns)
      : MaskSource(name, width_px, height_px, max_age_ns) {
    const auto size = static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px);
    masks_.ForEach([size](Mask& mask) { mask.pixels.resize(size); });
  }

  /// By another thread.
  /// @param pixels Rows `stride` apart. A mask that is not as large as the images, or has fewer
  /// bytes than it says, takes the place of the one before and is counted as of the wrong size.
  void Put(StampNs stamp_ns, std::int64_t width_px, std::int64_t height_px, std::size_t stride,
           std::span<const std::uint8_t> pixels) {
    Mask& mask = masks_.back();
    mask.stamp_ns = stamp_ns;
    const auto width = static_cast<std::size_t>(width_px_);
    const auto height = static_cast<std::size_t>(height_px_);
    mask.fits = width_px == width_px_ && height_px == height_px_ && stride >= width &&
                stride <= pixels.size() && pixels.size() / stride >= height;
    for (std::size_t v = 0; mask.fits && v < height; ++v) {
      const auto row = pixels.subspan(v * stride, width);
      std::copy(row.begin(), row.end(),
                mask.pixels.begin() + static_cast<std::ptrdiff_t>(v * width));
    }
    (void)masks_.Publish();
  }

 private:
  struct Mask {
    StampNs stamp_ns = 0;
    bool fits = false;
    std::vector<std::uint8_t> pixels;
  };

  [[nodiscard]] Status DoNewest(Newest& newest) noexcept override {
    has_any_ = masks_.Take() || has_any_;
    if (!has_any_) {
      AddSaturating(counters_.missing);
      return Status::kNotFound;
    }
    const Mask& mask = masks_.front();
    if (!mask.fits) {
      AddSaturating(counters_.wrong_size);
      return Status::kMaskSizeMismatch;
    }
    newest = {mask.pixels.data(), mask.stamp_ns};
    return Status::kOk;
  }

  posix::TripleBuffer<Mask> masks_;
  bool has_any_ = false;  ///< The tracking thread's own.
};

}  // namespace disflow::apps
