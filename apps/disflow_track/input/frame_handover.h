// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <cstdint>
#include <exception>
#include <span>

#include "disflow/depth/depth_frame.h"
#include "disflow/posix/file_descriptor.h"
#include "disflow/posix/triple_buffer.h"
#include "input/frame_copy.h"

namespace disflow::apps {

/// Hands frames from the capture thread to the tracking thread: room for one, and the newest wins.
/// Frames are copied; neither side waits for the other's copying.
class FrameHandover {
 public:
  /// kInput: no frame yet, but one of the inputs that the caller also waits for.
  enum class Taken : std::uint8_t { kFrame, kFault, kNothing, kInput, kEnd };
  /// As many of those are waited for; further ones show nothing.
  static constexpr std::size_t kMaxInputs = 31;

  /// Allocates all buffers. A larger frame later is taken as well, but allocates.
  /// @throws std::system_error if the system has no descriptor left.
  FrameHandover(int width_px, int height_px, bool with_mask);

  /// By the capture thread. A frame that still waits is dropped and counted.
  void Put(const DepthFrame& frame);
  /// By the capture thread: a frame could not be read. A frame that still waits goes first, and
  /// the fault is then left out.
  void PutFault(Status fault);
  /// By the capture thread: nothing more will come.
  /// @param failure What broke the input off; null if it came to its end.
  void End(std::exception_ptr failure) noexcept;

  /// By the tracking thread. Gives back the frame taken before.
  /// @param frame Valid until the next call.
  /// @param fault Why there is no frame, if kFault is returned.
  /// @param inputs Descriptors that may show input, which ends the wait; those of -1 and those that
  /// are broken are left out.
  /// @throws What End() was given, once all frames are taken.
  [[nodiscard]] Taken Take(std::int64_t timeout_ns, DepthFrame& frame, Status& fault,
                           std::span<const int> inputs = {});

  /// Frames that were replaced by newer ones; saturating.
  [[nodiscard]] std::uint32_t dropped() const noexcept { return dropped_; }

 private:
  struct Slot {
    Status fault = Status::kOk;
    FrameCopy image;
  };

  /// @return true if it was one of the inputs that ended the wait.
  [[nodiscard]] bool AwaitNews(std::int64_t timeout_ns, std::span<const int> inputs) noexcept;
  [[nodiscard]] bool HasNews() const noexcept { return slots_.HasNews() || ended_; }
  void Wake() noexcept;

  posix::TripleBuffer<Slot> slots_;
  std::atomic<std::uint32_t> dropped_ = 0;
  posix::FileDescriptor changed_;  ///< Shows input: there is news in slots_, or an end.
  std::atomic<bool> ended_ = false;
  std::exception_ptr failure_;  ///< Written before ended_ is set.
};

}  // namespace disflow::apps
