// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "disflow/depth/depth_frame.h"
#include "disflow/hal/fault.h"

namespace disflow::posix {

/// What became of the masks, frame by frame; saturating. A frame whose newest mask was torn may
/// still use the one before, and counts for both.
struct MaskCounters {
  std::uint32_t used = 0;
  std::uint32_t missing = 0;     ///< No source there, or nothing delivered yet.
  std::uint32_t late = 0;        ///< Too old or too new for the frame; also of a dead source.
  std::uint32_t torn = 0;        ///< Being written every time it was read.
  std::uint32_t wrong_size = 0;  ///< Of another size than the depth image.
  std::uint32_t corrupt = 0;     ///< Header makes no sense, or bytes are missing.
};

/// Masks that somebody else makes: 8 bits per pixel, as large as the depth image. docs/masks.md.
class MaskSource {
 public:
  MaskSource(const MaskSource&) = delete;
  MaskSource& operator=(const MaskSource&) = delete;
  virtual ~MaskSource() = default;

  /// Gives the frame the newest mask if that fits; else the frame is left without one. Never waits
  /// and does not allocate.
  /// @return kOk if `frame` has a mask now, else why not; the mask's pixels stay valid until the
  /// next call.
  [[nodiscard]] Status Attach(DepthFrame& frame) noexcept;

  [[nodiscard]] const MaskCounters& counters() const noexcept { return counters_; }
  [[nodiscard]] const std::string& name() const noexcept { return name_; }

 protected:
  struct Newest {
    const std::uint8_t* data = nullptr;  ///< Rows without gaps; valid until the next call.
    StampNs stamp_ns = 0;                ///< Of the image that the mask belongs to.
  };

  /// @param max_age_ns A mask farther than this from the frame's stamp is not used.
  MaskSource(std::string name, int width_px, int height_px, std::int64_t max_age_ns)
      : width_px_(width_px),
        height_px_(height_px),
        name_(std::move(name)),
        max_age_ns_(max_age_ns) {}

  const int width_px_;
  const int height_px_;
  MaskCounters counters_;

 private:
  /// @return kOk, or what Attach() returns; counts why.
  [[nodiscard]] virtual Status DoNewest(Newest& newest) noexcept = 0;

  std::string name_;
  std::int64_t max_age_ns_;
};

/// @param name "/NAME" of shared memory, "file:PATH" or "v4l2:DEVICE", see docs/masks.md.
/// @return kOk, or kInvalidUri with what a name looks like.
[[nodiscard]] hal::Fault CheckMaskName(const std::string& name) noexcept;

/// @param name Passes CheckMaskName().
[[nodiscard]] std::unique_ptr<MaskSource> MakeMaskSource(const std::string& name, int width_px,
                                                         int height_px, std::int64_t max_age_ns);

}  // namespace disflow::posix
