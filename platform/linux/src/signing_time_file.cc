// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/posix/signing_time_file.h"

#include <fcntl.h>
#include <sys/stat.h>

#include <algorithm>
#include <array>
#include <ctime>
#include <span>

#include "disflow/hal/little_endian.h"
#include "disflow/types.h"
#include "errno_fault.h"

namespace disflow::posix {
namespace {

using hal::mavlink::SigningTime;

/// One copy of the time: the number and its complement, by which a torn one is known.
using TimeCopy = std::array<std::byte, 2 * sizeof(SigningTime)>;

TimeCopy CopyOf(SigningTime time) noexcept {
  TimeCopy copy;
  hal::StoreLittleEndian(time, std::span(copy));
  hal::StoreLittleEndian(~time, std::span(copy).subspan(sizeof(time)));
  return copy;
}

off_t OffsetOf(int copy) noexcept { return static_cast<off_t>(copy) * off_t{sizeof(TimeCopy)}; }

SigningTime LoadCopy(int fd, int which) noexcept {
  TimeCopy copy{};
  const ssize_t size =
      RetryOnSignal([&] { return ::pread(fd, copy.data(), copy.size(), OffsetOf(which)); });
  const auto time = hal::LoadLittleEndian<SigningTime>(copy);
  const bool is_whole =
      size == ssize_t{copy.size()} && copy == CopyOf(time) && time <= hal::mavlink::kMaxSigningTime;
  return is_whole ? time : 0;
}

}  // namespace

hal::Fault SigningTimeFile::Open(const std::string& path) {
  file_ = FileDescriptor(RetryOnSignal([&] {
    return ::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOCTTY | O_NONBLOCK | O_NOFOLLOW,
                  S_IRUSR | S_IWUSR);
  }));
  if (!file_.is_open()) {
    return ErrnoFault(Status::kIoError, path.c_str(), "cannot keep the signing time", errno);
  }
  next_copy_ = LoadCopy(file_.get(), 0) <= LoadCopy(file_.get(), 1) ? 0 : 1;
  return {};
}

SigningTime SigningTimeFile::Load() const noexcept {
  if (!file_.is_open()) return 0;
  return std::max(LoadCopy(file_.get(), 0), LoadCopy(file_.get(), 1));
}

bool SigningTimeFile::Save(SigningTime time) noexcept {
  if (!file_.is_open()) return false;
  const TimeCopy copy = CopyOf(time);
  const ssize_t size = RetryOnSignal(
      [&] { return ::pwrite(file_.get(), copy.data(), copy.size(), OffsetOf(next_copy_)); });
  if (size != ssize_t{copy.size()}) return false;
  next_copy_ = 1 - next_copy_;
  return true;
}

SigningTime SigningTimeNow() noexcept {
  timespec now{};
  (void)::clock_gettime(CLOCK_REALTIME, &now);
  return hal::mavlink::SigningTimeOf(std::int64_t{now.tv_sec} * kSecond_ns + now.tv_nsec);
}

}  // namespace disflow::posix
