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
  for (Slot& slot : slots_) {
    slot.depth.resize(pixels * kLargestPixel_bytes);
    if (with_mask) slot.mask.resize(pixels);
  }
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
  slots_[filling_].Copy(frame);
  slots_[filling_].fault = Status::kOk;
  {
    const std::lock_guard lock(mutex_);
    if (waiting_ && slots_[between_].fault == Status::kOk) AddSaturating(dropped_);
    std::swap(filling_, between_);
    waiting_ = true;
  }
  changed_.notify_one();
}

void FrameHandover::PutFault(Status fault) {
  {
    const std::lock_guard lock(mutex_);
    if (waiting_) return;
    slots_[between_].fault = fault;
    waiting_ = true;
  }
  changed_.notify_one();
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
  std::unique_lock lock(mutex_);
  changed_.wait_for(lock, std::chrono::nanoseconds(timeout_ns),
                    [this] { return waiting_ || ended_; });
  if (waiting_) {
    std::swap(between_, taken_);
    waiting_ = false;
    fault = slots_[taken_].fault;
    if (fault != Status::kOk) return Taken::kFault;
    frame = slots_[taken_].frame;
    return Taken::kFrame;
  }
  if (!ended_) return Taken::kNothing;
  if (failure_) std::rethrow_exception(std::exchange(failure_, nullptr));
  return Taken::kEnd;
}

std::uint32_t FrameHandover::dropped() const noexcept {
  const std::lock_guard lock(mutex_);
  return dropped_;
}

}  // namespace disflow::apps
