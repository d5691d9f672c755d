// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <condition_variable>
#include <cstdint>
#include <limits>
#include <mutex>
#include <vector>

#include "run/recording.h"

namespace disflow::apps {

/// A disk that takes its time: it is given leave for so many frames. Outlives its recordings.
class HeldDisk {
 public:
  void Allow(int frames) {
    {
      const std::lock_guard lock(mutex_);
      allowed_ += frames;
    }
    changed_.notify_all();
  }
  void AwaitLeave() {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return allowed_ > 0; });
    --allowed_;
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  int allowed_ = 0;
};

/// What was written of a frame.
struct Written {
  StampNs stamp_ns = -1;  ///< -1: the frame could not be read.
  float depth_m = 0.0F;   ///< Of all its pixels; NaN if they differ.
  std::uint8_t mask = 0;
  std::int64_t result = -1;  ///< FrameResult::frame; -1: none.
};

/// Writes into memory as fast as a disk allows it, and fails when it has so many frames.
class HeldRecording final : public Recording {
 public:
  HeldRecording(HeldDisk& disk, std::vector<Written>& written, int room = 1'000'000)
      : disk_(disk), written_(written), room_(room) {}

  [[nodiscard]] hal::Fault Add(const RecordedFrame& recorded) override {
    disk_.AwaitLeave();
    if (count_ == room_) return hal::MakeFault(Status::kIoError, "held: cannot be written");
    ++count_;
    Written written;
    if (recorded.frame != nullptr) {
      const DepthFrame& frame = *recorded.frame;
      written.stamp_ns = frame.stamp_ns;
      written.depth_m = ValueOf(frame.depth);
      if (frame.mask.given()) written.mask = frame.mask.row(frame.mask.height_px - 1)[0];
    }
    if (!recorded.results.empty()) written.result = recorded.results.front().frame;
    written_.push_back(written);
    return {};
  }
  [[nodiscard]] hal::Fault Finish() override { return {}; }
  [[nodiscard]] int frame_count() const noexcept override { return count_; }
  [[nodiscard]] std::int64_t size_bytes() const noexcept override { return count_; }
  [[nodiscard]] bool has_results() const noexcept override { return true; }

 private:
  static float ValueOf(const DepthView& depth) {
    const auto* const first = reinterpret_cast<const float*>(depth.row(0));
    for (int v = 0; v < depth.height_px; ++v) {
      const auto* const row = reinterpret_cast<const float*>(depth.row(v));
      for (int u = 0; u < depth.width_px; ++u)
        if (row[u] != *first) return std::numeric_limits<float>::quiet_NaN();
    }
    return *first;
  }

  HeldDisk& disk_;
  std::vector<Written>& written_;
  int room_;
  int count_ = 0;
};

}  // namespace disflow::apps
