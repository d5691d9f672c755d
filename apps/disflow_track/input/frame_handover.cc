// SPDX-License-Identifier: BSD-3-Clause
#include "input/frame_handover.h"

#include <poll.h>
#include <sys/eventfd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <system_error>
#include <utility>

#include "disflow/posix/timespec.h"
#include "disflow/saturating.h"

namespace disflow::apps {

FrameHandover::FrameHandover(int width_px, int height_px, bool with_mask)
    : changed_(::eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)) {
  if (!changed_.is_open()) throw std::system_error(errno, std::generic_category(), "eventfd");
  slots_.ForEach([=](Slot& slot) { slot.image.Reserve(width_px, height_px, with_mask); });
}

void FrameHandover::Put(const DepthFrame& frame) {
  slots_.back().image.Take(frame);
  slots_.back().fault = Status::kOk;
  const bool replaced = slots_.Publish();
  if (replaced && slots_.back().fault == Status::kOk) {
    std::uint32_t dropped = dropped_;
    AddSaturating(dropped);
    dropped_ = dropped;
  }
  Wake();
}

void FrameHandover::PutFault(Status fault) {
  // Only this thread puts something in, so that nothing can get in between.
  if (slots_.HasNews()) return;
  slots_.back().fault = fault;
  (void)slots_.Publish();
  Wake();
}

void FrameHandover::End(std::exception_ptr failure) noexcept {
  failure_ = std::move(failure);
  ended_ = true;
  Wake();
}

FrameHandover::Taken FrameHandover::Take(std::int64_t timeout_ns, DepthFrame& frame, Status& fault,
                                         std::span<const int> inputs) {
  if (AwaitNews(timeout_ns, inputs)) return Taken::kInput;
  // Ahead of the last look for a frame, since one may have come before the end.
  const bool ended = ended_;
  if (slots_.Take()) {
    fault = slots_.front().fault;
    if (fault != Status::kOk) return Taken::kFault;
    frame = slots_.front().image.frame();
    return Taken::kFrame;
  }
  if (!ended) return Taken::kNothing;
  // After the end this thread is the only one left.
  if (failure_) std::rethrow_exception(std::exchange(failure_, nullptr));
  return Taken::kEnd;
}

bool FrameHandover::AwaitNews(std::int64_t timeout_ns, std::span<const int> inputs) noexcept {
  using Clock = std::chrono::steady_clock;
  std::array<pollfd, 1 + kMaxInputs> waiting;
  std::size_t count = 0;
  waiting[count++] = {.fd = changed_.get(), .events = POLLIN, .revents = 0};
  for (const int fd : inputs.first(std::min(inputs.size(), kMaxInputs))) {
    waiting[count++] = {.fd = fd, .events = POLLIN, .revents = 0};
  }
  const Clock::time_point end = Clock::now() + std::chrono::nanoseconds(timeout_ns);
  while (!HasNews()) {
    const std::chrono::nanoseconds left = end - Clock::now();
    if (left.count() <= 0) return false;
    const timespec timeout = posix::ToTimespec(left.count());
    if (::ppoll(waiting.data(), count, &timeout, nullptr) <= 0) continue;
    eventfd_t wakes = 0;
    if (waiting[0].revents != 0) (void)::eventfd_read(changed_.get(), &wakes);
    for (pollfd& input : std::span(waiting).subspan(1, count - 1)) {
      if (input.revents == POLLIN) return true;
      // It would end every wait at once; who reads it finds out.
      if (input.revents != 0) input.fd = -1;
    }
  }
  return false;
}

/// Who waits looks for news after each wake, and a wake before the wait ends that at once.
void FrameHandover::Wake() noexcept { (void)::eventfd_write(changed_.get(), 1); }

}  // namespace disflow::apps
