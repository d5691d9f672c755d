// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/posix/mask_stream.h"

#include <fcntl.h>
#include <sys/stat.h>

#include <array>
#include <atomic>
#include <cstring>

#include "disflow/hal/little_endian.h"
#include "disflow/saturating.h"

namespace disflow::posix {
namespace {

constexpr std::uint32_t kMaxSide_px = 16384;
constexpr int kAttempts = 3;
constexpr std::string_view kFilePrefix = "file:";
constexpr std::string_view kSharedMemory = "/dev/shm";

bool ReadFully(int fd, void* out, std::size_t size, std::size_t offset) noexcept {
  auto* bytes = static_cast<std::byte*>(out);
  while (size > 0) {
    const ssize_t got =
        RetryOnSignal([&] { return ::pread(fd, bytes, size, static_cast<off_t>(offset)); });
    if (got <= 0) return false;
    bytes += got;
    offset += static_cast<std::size_t>(got);
    size -= static_cast<std::size_t>(got);
  }
  return true;
}

std::string PathOf(const std::string& name) {
  return name.starts_with(kFilePrefix) ? name.substr(kFilePrefix.size())
                                       : std::string(kSharedMemory) + name;
}

}  // namespace

bool MaskHeader::Parse(std::span<const std::byte, kSize> bytes) noexcept {
  if (std::memcmp(bytes.data(), kMagic, 8) != 0) return false;
  sequence = hal::LoadLittleEndian<std::uint64_t>(bytes.subspan(8));
  stamp_ns = hal::LoadLittleEndian<std::int64_t>(bytes.subspan(16));
  width_px = hal::LoadLittleEndian<std::uint32_t>(bytes.subspan(24));
  height_px = hal::LoadLittleEndian<std::uint32_t>(bytes.subspan(28));
  stride_bytes = hal::LoadLittleEndian<std::uint32_t>(bytes.subspan(32));
  return width_px > 0 && width_px <= kMaxSide_px && height_px > 0 && height_px <= kMaxSide_px &&
         stride_bytes >= width_px && stride_bytes <= 4 * kMaxSide_px;
}

bool MaskStream::IsName(const std::string& name) noexcept {
  const bool is_file = name.starts_with(kFilePrefix) && name.size() > kFilePrefix.size();
  return is_file || (name.size() > 1 && name[0] == '/' && name.find('/', 1) == std::string::npos);
}

MaskStream::MaskStream(const std::string& name, int width_px, int height_px,
                       std::int64_t max_age_ns)
    : MaskSource(name, width_px, height_px, max_age_ns),
      path_(PathOf(name)),
      incoming_(static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px)),
      mask_(incoming_.size()) {}

Status MaskStream::DoNewest(Newest& newest) noexcept {
  switch (ReadNewest()) {
    case Reading::kDone:
    case Reading::kUnchanged:
      newest = {mask_.data(), stamp_ns_};
      return Status::kOk;
    case Reading::kMissing:
      AddSaturating(counters_.missing);
      return Status::kNotFound;
    case Reading::kWrongSize:
      AddSaturating(counters_.wrong_size);
      return Status::kMaskSizeMismatch;
    case Reading::kCorrupt:
      AddSaturating(counters_.corrupt);
      return Status::kCorrupt;
    case Reading::kTorn:
      break;
  }
  AddSaturating(counters_.torn);
  return Status::kWouldBlock;
}

MaskStream::Reading MaskStream::ReadNewest() noexcept {
  OpenAgainIfGone();
  if (!file_.is_open()) return Reading::kMissing;
  Reading reading = Reading::kTorn;
  for (int i = 0; i < kAttempts && reading == Reading::kTorn; ++i) reading = ReadOnce();
  if (reading != Reading::kTorn || sequence_ == 0) return reading;
  AddSaturating(counters_.torn);
  // The previous mask is whole; its stamp decides whether it is still of use.
  return Reading::kUnchanged;
}

MaskStream::Reading MaskStream::ReadOnce() noexcept {
  MaskHeader before;
  Reading verdict = Reading::kDone;
  if (!ReadHeader(before, verdict)) return verdict;
  if (before.sequence == 0) return Reading::kMissing;
  if (before.sequence % 2 != 0) return Reading::kTorn;
  if (before.sequence == sequence_) return Reading::kUnchanged;
  if (before.width_px != static_cast<std::uint32_t>(width_px_) ||
      before.height_px != static_cast<std::uint32_t>(height_px_)) {
    return Reading::kWrongSize;
  }
  if (!ReadPixels(before.stride_bytes)) return Reading::kCorrupt;
  std::atomic_thread_fence(std::memory_order_acquire);
  MaskHeader after;
  if (!ReadHeader(after, verdict)) return verdict;
  if (after.sequence != before.sequence) return Reading::kTorn;
  incoming_.swap(mask_);
  sequence_ = before.sequence;
  stamp_ns_ = before.stamp_ns;
  return Reading::kDone;
}

bool MaskStream::ReadPixels(std::size_t stride_bytes) noexcept {
  const auto width = static_cast<std::size_t>(width_px_);
  if (stride_bytes == width) {
    return ReadFully(file_.get(), incoming_.data(), incoming_.size(), MaskHeader::kSize);
  }
  for (std::size_t v = 0; v < static_cast<std::size_t>(height_px_); ++v) {
    if (!ReadFully(file_.get(), incoming_.data() + v * width, width,
                   MaskHeader::kSize + v * stride_bytes)) {
      return false;
    }
  }
  return true;
}

bool MaskStream::ReadHeader(MaskHeader& header, Reading& verdict) noexcept {
  std::array<std::byte, MaskHeader::kSize> bytes{};
  if (ReadFully(file_.get(), bytes.data(), bytes.size(), 0) && header.Parse(bytes)) return true;
  verdict = Reading::kCorrupt;
  return false;
}

void MaskStream::OpenAgainIfGone() noexcept {
  // A writer that was started anew may have made a new object of the same name.
  struct stat status {};
  if (file_.is_open() && ::fstat(file_.get(), &status) == 0 && status.st_nlink > 0) return;
  file_ = FileDescriptor(::open(path_.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
  sequence_ = 0;
}

}  // namespace disflow::posix
