// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <span>
#include <thread>
#include <vector>

#include "disflow/posix/file_descriptor.h"
#include "input/frame_copy.h"
#include "objects/tracked_object.h"
#include "run/recording.h"

namespace disflow::apps {

/// Writes recordings in a thread of its own: a disk that takes its time holds up no tracking. What
/// waits for it is bounded, and allocated at the start.
class RecordingQueue {
 public:
  /// A second of most cameras.
  static constexpr std::size_t kMostFrames = 30;
  /// Of large images fewer frames wait, but two at least.
  static constexpr std::size_t kMostBytes = 64U << 20U;
  /// Models are recorded twice a second and wait no longer than the frames.
  static constexpr std::size_t kMostModels = 3;

  /// What a frame may need.
  struct Room {
    int width_px = 0;
    int height_px = 0;
    std::size_t objects = 0;        ///< Whose results are recorded.
    std::size_t model_samples = 0;  ///< Of each of them.
  };
  /// What of a frame was put in.
  struct Taken {
    bool frame = false;
    bool models = false;
  };

  /// @throws Failure kOutputFailed if the system has no descriptor left.
  explicit RecordingQueue(const Room& room);
  RecordingQueue(const RecordingQueue&) = delete;
  RecordingQueue& operator=(const RecordingQueue&) = delete;
  /// Writes what waits.
  ~RecordingQueue();

  /// By one thread, which never waits: a frame that finds no room is left out and counted.
  /// @param writer Outlives the frame, see AwaitWritten().
  /// @param frame Null if it could not be read.
  /// @param objects Whose models are to be recorded; null: none.
  Taken Put(RecordingWriter& writer, const DepthFrame* frame, std::span<const FrameResult> results,
            const TrackedObjects* objects);
  /// By any thread: waits until all is written that was put in before the call.
  void AwaitWritten();

  /// Frames that were left out; saturating.
  [[nodiscard]] std::uint32_t dropped() const noexcept { return dropped_; }
  /// How many frames may wait, the one that is being written among them.
  [[nodiscard]] std::size_t capacity() const noexcept { return slots_.size(); }

 private:
  struct Slot {
    RecordingWriter* writer = nullptr;
    bool readable = false;
    FrameCopy image;
    std::vector<FrameResult> results;
    std::size_t result_count = 0;
    const std::vector<SampleList>* models = nullptr;
  };

  void Work();
  [[nodiscard]] static RecordedFrame ViewOf(const Slot& slot);

  std::vector<Slot> slots_;
  std::array<std::vector<SampleList>, kMostModels> models_;  ///< Used in turn, as the slots are.
  posix::FileDescriptor waiting_;                            ///< Counts the frames put in.
  std::atomic<std::uint32_t> put_ = 0;                       ///< Written by who puts in.
  std::atomic<std::uint32_t> dropped_ = 0;
  std::atomic<std::uint32_t> written_ = 0;  ///< Written by the thread, under the mutex.
  std::atomic<std::size_t> models_waiting_ = 0;
  // Of who puts in.
  std::size_t next_slot_ = 0;
  std::size_t next_models_ = 0;
  // Never locked by who puts in.
  std::mutex mutex_;
  std::condition_variable is_written_;
  std::thread thread_;
};

}  // namespace disflow::apps
