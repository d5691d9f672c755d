// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "objects/model_snapshot.h"
#include "objects/object_choice.h"
#include "objects/running_settings.h"

/// @file
/// What a tracked object shows to other threads, and what they ask of it. The tracking thread never
/// waits for them and does not allocate.

namespace disflow::apps {

/// Wakes a thread that waits for news of any number of objects.
class NewsSignal {
 public:
  void Raise() noexcept;
  /// @return true if there was news since the last call that returned true.
  bool WaitFor(std::int64_t timeout_ns);

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  bool raised_ = false;
};

/// One listener's end of an object's channel. All is called by the listener's thread but for what
/// the channel itself calls.
class ChannelReader {
 public:
  ChannelReader(NewsSignal& signal, std::unique_ptr<ModelSnapshot> snapshot)
      : signal_(signal), results_(kResults), snapshot_(std::move(snapshot)) {}

  /// The oldest result not taken yet. @return false: there is none.
  [[nodiscard]] bool Pop(FrameResult& result);
  /// Results that found no room since the listener was too slow: the oldest make way. Saturating.
  [[nodiscard]] std::uint32_t lost() const;

  /// Asks for a copy after the next frame. The one before is given back, must not be used any more.
  void RequestSnapshot() noexcept { state_.store(State::kWanted, std::memory_order_release); }
  /// @return Null until the copy is there; then the listener's own until it asks for the next.
  [[nodiscard]] ModelSnapshot* snapshot() noexcept {
    return state_.load(std::memory_order_acquire) == State::kReady ? snapshot_.get() : nullptr;
  }

 private:
  friend class ObjectChannel;
  static constexpr std::size_t kResults = 64;
  enum class State : std::uint8_t { kNone, kWanted, kReady };

  // By the tracking thread.
  void Push(const FrameResult& result) noexcept;
  template <class Snapshot, class Tracker>
  void Offer(const Tracker& tracker, const FrameResult& result, const DepthFrame* frame) {
    if (state_.load(std::memory_order_acquire) == State::kWanted) {
      static_cast<Snapshot&>(*snapshot_).Take(tracker, result, frame);
      state_.store(State::kReady, std::memory_order_release);
    }
    Push(result);
    signal_.Raise();
  }

  NewsSignal& signal_;
  mutable std::mutex mutex_;
  // Under the mutex.
  std::vector<FrameResult> results_;
  std::size_t first_ = 0;
  std::size_t count_ = 0;
  std::uint32_t lost_ = 0;

  std::atomic<State> state_ = State::kNone;
  std::unique_ptr<ModelSnapshot> snapshot_;
};

/// One tracked object as other threads see it.
class ObjectChannel {
 public:
  /// @param index As in the MAVLink component id: 0 for the first object.
  /// @param new_snapshot Makes the snapshots of this object's kind of tracker.
  /// @param config The tracker's settings at the start.
  ObjectChannel(std::string name, int index,
                std::function<std::unique_ptr<ModelSnapshot>()> new_snapshot,
                const Config& config = {})
      : name_(std::move(name)),
        index_(index),
        new_snapshot_(std::move(new_snapshot)),
        settings_(config) {}

  template <class Limits>
  [[nodiscard]] static std::unique_ptr<ModelSnapshot> NewSnapshot() {
    return std::make_unique<TrackerSnapshot<Limits>>();
  }

  /// Adds a listener with a queue and a snapshot of its own. Only before the run starts.
  /// @param signal Raised after every frame; outlives the channel.
  /// @return Lives as long as the channel.
  [[nodiscard]] ChannelReader& AddReader(NewsSignal& signal);

  [[nodiscard]] const std::string& name() const noexcept { return name_; }
  [[nodiscard]] int index() const noexcept { return index_; }

  // By any thread.
  /// The object is forgotten before the next frame.
  void RequestReset() noexcept { reset_ = true; }
  /// The object is forgotten for the chosen one, which the next frame begins if it shows it. Of
  /// several choices the last one counts.
  void Choose(ObjectChoice choice);
  /// While paused no frames are taken.
  void SetPaused(bool paused) noexcept { paused_ = paused; }
  [[nodiscard]] bool paused() const noexcept { return paused_; }
  [[nodiscard]] RunningSettings& settings() noexcept { return settings_; }

  // By the tracking thread.
  [[nodiscard]] bool TakeReset() noexcept { return reset_.exchange(false); }
  /// @return false, and `choice` is unchanged, if nothing was chosen since. What it held before is
  /// freed by whoever chooses next.
  [[nodiscard]] bool TakeChoice(ObjectChoice& choice) noexcept;
  /// @param frame Null if it could not be read.
  template <class Limits>
  void Offer(const Tracker<Limits>& tracker, const FrameResult& result, const DepthFrame* frame) {
    for (ChannelReader& reader : readers_) {
      reader.Offer<TrackerSnapshot<Limits>>(tracker, result, frame);
    }
  }

 private:
  std::string name_;
  int index_;
  std::function<std::unique_ptr<ModelSnapshot>()> new_snapshot_;
  std::deque<ChannelReader> readers_;
  RunningSettings settings_;
  std::atomic<bool> reset_ = false;
  std::atomic<bool> paused_ = false;
  std::atomic<bool> chosen_ = false;
  std::mutex choice_mutex_;
  ObjectChoice choice_;  ///< Under the mutex.
};

}  // namespace disflow::apps
