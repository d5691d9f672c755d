// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <exception>
#include <mutex>
#include <vector>

#include "disflow/depth/depth_frame.h"
#include "disflow/posix/triple_buffer.h"

namespace disflow::apps {

/// Hands frames from the capture thread to the tracking thread: room for one, and the newest wins.
/// Frames are copied, because a driver's buffers are few and their owner reuses them; neither side
/// waits for the other's copying.
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
  [[nodiscard]] std::uint32_t dropped() const noexcept { return dropped_; }

 private:
  struct Slot {
    Status fault = Status::kOk;
    DepthFrame frame;
    std::vector<std::byte> depth;
    std::vector<std::uint8_t> mask;

    void Copy(const DepthFrame& source);
  };

  /// @return true if there is nothing more to wait for.
  [[nodiscard]] bool AwaitNews(std::int64_t timeout_ns);
  void Wake() noexcept;

  posix::TripleBuffer<Slot> slots_;
  std::atomic<std::uint32_t> dropped_ = 0;
  std::mutex mutex_;
  std::condition_variable changed_;  ///< There is news in slots_, or an end.
  // Under the mutex.
  bool ended_ = false;
  std::exception_ptr failure_;
};

}  // namespace disflow::apps
