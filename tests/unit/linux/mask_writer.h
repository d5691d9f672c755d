// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <fcntl.h>
#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <vector>

#include "disflow/depth/depth_frame.h"
#include "disflow/hal/little_endian.h"
#include "disflow/posix/file_descriptor.h"
#include "disflow/posix/mask_stream.h"

namespace disflow::posix {

/// The other side of a mask stream, with every fault that a writer can have.
class MaskWriter {
 public:
  explicit MaskWriter(std::string path) : path_(std::move(path)) { Create(); }
  ~MaskWriter() { Remove(); }
  MaskWriter(const MaskWriter&) = delete;
  MaskWriter& operator=(const MaskWriter&) = delete;

  void Create() {
    file_ = FileDescriptor(::open(path_.c_str(), O_RDWR | O_CREAT | O_TRUNC, 0600));
    ASSERT_TRUE(file_.is_open());
    sequence_ = 0;
  }
  void Remove() {
    (void)::unlink(path_.c_str());
    file_.Reset();
  }
  /// A whole mask, every pixel of the same value.
  void Write(std::int64_t stamp_ns, std::uint32_t width, std::uint32_t height, std::uint8_t value,
             std::uint32_t padding = 0) {
    ++sequence_;
    Header(stamp_ns, width, height, width + padding);
    const std::vector<std::uint8_t> row(width + padding, value);
    for (std::uint32_t v = 0; v < height; ++v) {
      Put(row.data(), row.size(), MaskHeader::kSize + v * row.size());
    }
    ++sequence_;
    Header(stamp_ns, width, height, width + padding);
  }
  /// A mask as it was given.
  void Write(std::int64_t stamp_ns, const MaskView& mask) {
    const auto width = static_cast<std::uint32_t>(mask.width_px);
    const auto height = static_cast<std::uint32_t>(mask.height_px);
    Begin(stamp_ns, width, height);
    for (std::uint32_t v = 0; v < height; ++v)
      Put(mask.row(static_cast<int>(v)), width, MaskHeader::kSize + std::size_t{v} * width);
    ++sequence_;
    Header(stamp_ns, width, height, width);
  }
  /// A writer that stopped in the middle.
  void Begin(std::int64_t stamp_ns, std::uint32_t width, std::uint32_t height) {
    ++sequence_;
    Header(stamp_ns, width, height, width);
  }
  void PutByte(std::size_t offset, std::uint8_t value) { Put(&value, 1, offset); }
  void Truncate(std::size_t size) {
    ASSERT_EQ(::ftruncate(file_.get(), static_cast<off_t>(size)), 0);
  }

 private:
  void Header(std::int64_t stamp_ns, std::uint32_t width, std::uint32_t height,
              std::uint32_t stride) {
    std::array<std::byte, MaskHeader::kSize> header{};
    std::memcpy(header.data(), MaskHeader::kMagic, 8);
    const std::span<std::byte> out(header);
    hal::StoreLittleEndian(sequence_, out.subspan(8));
    hal::StoreLittleEndian(stamp_ns, out.subspan(16));
    hal::StoreLittleEndian(width, out.subspan(24));
    hal::StoreLittleEndian(height, out.subspan(28));
    hal::StoreLittleEndian(stride, out.subspan(32));
    Put(reinterpret_cast<const std::uint8_t*>(header.data()), header.size(), 0);
  }
  void Put(const std::uint8_t* bytes, std::size_t size, std::size_t offset) {
    ASSERT_EQ(::pwrite(file_.get(), bytes, size, static_cast<off_t>(offset)),
              static_cast<ssize_t>(size));
  }

  std::string path_;
  FileDescriptor file_;
  std::uint64_t sequence_ = 0;
};

}  // namespace disflow::posix
