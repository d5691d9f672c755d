// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <condition_variable>
#include <cstdint>
#include <exception>
#include <mutex>
#include <vector>

#include "disflow/depth/depth_frame.h"

namespace disflow::apps {

/// Hands frames from the capture thread to the tracking thread: room for one, and the newest wins.
/// Three buffers, one on either side and one between, so that neither side waits for the other.
/// Frames are copied, because a driver's buffers are few and their owner reuses them.
class FrameHandover {
 public:
  enum class Taken : std::uint8_t { kFrame, kFault, kNothing, kEnd };

  /// Allocates all buffers. A larger frame later is taken as well, but allocates.
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
  /// @throws What End() was given, once all frames are taken.
  [[nodiscard]] Taken Take(std::int64_t timeout_ns, DepthFrame& frame, Status& fault);

  /// Frames that were replaced by newer ones; saturating.
  [[nodiscard]] std::uint32_t dropped() const noexcept;

 private:
  struct Slot {
    Status fault = Status::kOk;
    DepthFrame frame;
    std::vector<std::byte> depth;
    std::vector<std::uint8_t> mask;

    void Copy(const DepthFrame& source);
  };

  std::array<Slot, 3> slots_;
  std::size_t filling_ = 0;  ///< The capture thread's own.
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  // Under the mutex.
  std::size_t between_ = 1;
  bool waiting_ = false;
  bool ended_ = false;
  std::exception_ptr failure_;
  std::uint32_t dropped_ = 0;
  std::size_t taken_ = 2;  ///< The tracking thread's own.
};

}  // namespace disflow::apps
