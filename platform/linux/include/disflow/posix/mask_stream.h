// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "disflow/depth/depth_frame.h"
#include "disflow/hal/fault.h"
#include "disflow/posix/file_descriptor.h"

namespace disflow::posix {

/// What lies at the start of the shared memory, little endian; the mask follows at once, row by
/// row. docs/masks.md is the contract.
struct MaskHeader {
  static constexpr std::size_t kSize = 64;
  static constexpr char kMagic[9] = "DFMASK01";

  std::uint64_t sequence = 0;  ///< Odd while the writer is at work.
  std::int64_t stamp_ns = 0;   ///< Capture stamp of the image that the mask belongs to.
  std::uint32_t width_px = 0;
  std::uint32_t height_px = 0;
  std::uint32_t stride_bytes = 0;

  /// @return false if the magic, the sizes or the stride cannot be.
  [[nodiscard]] bool Parse(std::span<const std::byte, kSize> bytes) noexcept;
};

/// What became of the masks, frame by frame; saturating. A frame whose newest mask was torn may
/// still use the one before, and counts for both.
struct MaskCounters {
  std::uint32_t used = 0;
  std::uint32_t missing = 0;     ///< No shared memory there, or nothing written yet.
  std::uint32_t late = 0;        ///< Too old or too new for the frame; also of a dead writer.
  std::uint32_t torn = 0;        ///< Written to all the while it was read.
  std::uint32_t wrong_size = 0;  ///< Not as large as the depth image.
  std::uint32_t corrupt = 0;     ///< Header without sense, or fewer bytes than it says.
};

/// Masks that another process writes into shared memory. The memory is read by copying, so that a
/// writer that dies, lies or shrinks it does no harm. Nothing is allocated after construction.
class MaskStream {
 public:
  /// @param path "/name" of shm_open(3), i.e. /dev/shm/name, or "file:PATH".
  /// @param max_age_ns A mask farther than this from the frame's stamp is not used.
  MaskStream(const std::string& path, int width_px, int height_px, std::int64_t max_age_ns);

  /// @return kOk, or kInvalidUri with what a name looks like.
  [[nodiscard]] static hal::Fault CheckName(const std::string& path) noexcept;

  /// Gives the frame the newest mask if that fits; else the frame is left without one.
  /// @return kOk if `frame` has a mask now, else why not; the mask's pixels stay valid until the
  /// next call.
  [[nodiscard]] Status Attach(DepthFrame& frame) noexcept;

  [[nodiscard]] const MaskCounters& counters() const noexcept { return counters_; }
  [[nodiscard]] const std::string& name() const noexcept { return name_; }

 private:
  enum class Reading : std::uint8_t { kDone, kUnchanged, kMissing, kTorn, kWrongSize, kCorrupt };

  [[nodiscard]] Reading ReadNewest() noexcept;
  [[nodiscard]] Reading ReadOnce() noexcept;
  [[nodiscard]] bool ReadHeader(MaskHeader& header, Reading& verdict) noexcept;
  [[nodiscard]] bool ReadPixels(std::size_t stride_bytes) noexcept;
  void OpenAgainIfGone() noexcept;

  std::string name_;
  std::string path_;
  int width_px_;
  int height_px_;
  std::int64_t max_age_ns_;
  FileDescriptor file_;
  std::vector<std::uint8_t> incoming_;
  std::vector<std::uint8_t> mask_;  ///< The newest whole one.
  std::uint64_t sequence_ = 0;      ///< Of mask_; 0: none yet.
  std::int64_t stamp_ns_ = 0;
  MaskCounters counters_;
};

}  // namespace disflow::posix
