// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "disflow/posix/file_descriptor.h"
#include "disflow/posix/mask_source.h"

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

  /// @return false if the magic, the sizes or the stride are impossible.
  [[nodiscard]] bool Parse(std::span<const std::byte, kSize> bytes) noexcept;
};

/// Masks that another process writes into shared memory. The memory is read by copying, so that a
/// writer that dies, lies or shrinks it does no harm. Nothing is allocated after construction.
class MaskStream final : public MaskSource {
 public:
  /// @param name "/name" of shm_open(3), i.e. /dev/shm/name, or "file:PATH".
  MaskStream(const std::string& name, int width_px, int height_px, std::int64_t max_age_ns);

  /// @return Whether it looks like one.
  [[nodiscard]] static bool IsName(const std::string& name) noexcept;

 private:
  enum class Reading : std::uint8_t { kDone, kUnchanged, kMissing, kTorn, kWrongSize, kCorrupt };

  [[nodiscard]] Status DoNewest(Newest& newest) noexcept override;
  [[nodiscard]] Reading ReadNewest() noexcept;
  [[nodiscard]] Reading ReadOnce() noexcept;
  [[nodiscard]] bool ReadHeader(MaskHeader& header, Reading& verdict) noexcept;
  [[nodiscard]] bool ReadPixels(std::size_t stride_bytes) noexcept;
  void OpenAgainIfGone() noexcept;

  std::string path_;
  FileDescriptor file_;
  std::vector<std::uint8_t> incoming_;
  std::vector<std::uint8_t> mask_;  ///< The newest whole one.
  std::uint64_t sequence_ = 0;      ///< Of mask_; 0: none yet.
  std::int64_t stamp_ns_ = 0;
};

}  // namespace disflow::posix
