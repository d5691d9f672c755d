// SPDX-License-Identifier: BSD-3-Clause
#include "input/frame_handover.h"

#include <chrono>
#include <cstring>
#include <utility>

#include "disflow/saturating.h"

namespace disflow::apps {
namespace {

constexpr std::size_t kLargestPixel_bytes = 4;

void CopyRows(const std::byte* source, std::ptrdiff_t stride_bytes, std::size_t row_bytes, int rows,
              std::byte* target) noexcept {
  for (int v = 0; v < rows; ++v) {
    std::memcpy(target + static_cast<std::size_t>(v) * row_bytes, source + v * stride_bytes,
                row_bytes);
  }
}

}  // namespace

FrameHandover::FrameHandover(int width_px, int height_px, bool with_mask) {
  const std::size_t pixels =
      static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px);
  slots_.ForEach([pixels, with_mask](Slot& slot) {
    slot.depth.resize(pixels * kLargestPixel_bytes);
    if (with_mask) slot.mask.resize(pixels);
  });
}

void FrameHandover::Slot::Copy(const DepthFrame& source) {
  frame = source;
  const DepthView& from = source.depth;
  const auto row_bytes = static_cast<std::size_t>(from.width_px * from.bytes_per_pixel());
  const auto rows = static_cast<std::size_t>(from.height_px);
  if (depth.size() < rows * row_bytes) depth.resize(rows * row_bytes);
  CopyRows(from.row(0), from.stride_bytes, row_bytes, from.height_px, depth.data());
  frame.depth.data = depth.data();
  frame.depth.stride_bytes = static_cast<std::ptrdiff_t>(row_bytes);
  if (!source.mask.given()) return;
  const auto mask_row = static_cast<std::size_t>(source.mask.width_px);
  const std::size_t mask_bytes = mask_row * static_cast<std::size_t>(source.mask.height_px);
  if (mask.size() < mask_bytes) mask.resize(mask_bytes);
  CopyRows(reinterpret_cast<const std::byte*>(source.mask.data), source.mask.stride_bytes, mask_row,
           source.mask.height_px, reinterpret_cast<std::byte*>(mask.data()));
  frame.mask.data = mask.data();
  frame.mask.stride_bytes = static_cast<std::ptrdiff_t>(mask_row);
}

void FrameHandover::Put(const DepthFrame& frame) {
  slots_.back().Copy(frame);
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
  {
    const std::lock_guard lock(mutex_);
    ended_ = true;
    failure_ = std::move(failure);
  }
  changed_.notify_one();
}

FrameHandover::Taken FrameHandover::Take(std::int64_t timeout_ns, DepthFrame& frame,
                                         Status& fault) {
  const bool ended = AwaitNews(timeout_ns);
  if (slots_.Take()) {
    fault = slots_.front().fault;
    if (fault != Status::kOk) return Taken::kFault;
    frame = slots_.front().frame;
    return Taken::kFrame;
  }
  if (!ended) return Taken::kNothing;
  // After the end this thread is the only one left.
  if (failure_) std::rethrow_exception(std::exchange(failure_, nullptr));
  return Taken::kEnd;
}

bool FrameHandover::AwaitNews(std::int64_t timeout_ns) {
  std::unique_lock lock(mutex_);
  changed_.wait_for(lock, std::chrono::nanoseconds(timeout_ns),
                    [this] { return slots_.HasNews() || ended_; });
  return ended_;
}

/// Who waits has looked for news with the mutex locked: it either has seen this, or sleeps by now.
void FrameHandover::Wake() noexcept {
  { const std::lock_guard lock(mutex_); }
  changed_.notify_one();
}

}  // namespace disflow::apps
