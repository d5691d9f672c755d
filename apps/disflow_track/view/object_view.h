// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <cstdint>
#include <vector>

#include "disflow/posix/view/message_board.h"
#include "objects/object_channel.h"
#include "view/run_metrics.h"
#include "view/view_texts.h"

namespace disflow::apps {

/// Puts on the board what browsers see of one object. All but the constructor by the view's thread.
class ObjectView {
 public:
  static constexpr std::size_t kTopics = 5;  ///< Status, surface, flow, depth, settings.

  /// @param first_topic Of kTopics that are this object's.
  /// @param metrics Gets every result.
  ObjectView(ObjectChannel& channel, int object, std::size_t first_topic, NewsSignal& signal,
             posix::MessageBoard& board, RunMetrics& metrics)
      : channel_(channel),
        reader_(channel.AddReader(signal)),
        object_(object),
        first_topic_(first_topic),
        board_(board),
        metrics_(metrics) {}

  /// @param watched Somebody looks: pictures are worth their work.
  void Update(bool watched, bool ended, std::int64_t now_ns);

  [[nodiscard]] ObjectChannel& channel() noexcept { return channel_; }
  /// By any thread: browsers show the settings as they are, whatever they believed.
  void ShowSettingsAgain() noexcept { settings_wanted_ = true; }

 private:
  enum Topic : std::size_t { kStatus, kSurface, kFlow, kDepth, kSettings };

  void TakeResults();
  void UpdateStatus(bool ended, std::int64_t now_ns);
  void UpdateSettings();
  void Draw(ModelSnapshot& snapshot, std::int64_t now_ns);
  void DrawSurface(ModelSnapshot& snapshot, std::int64_t now_ns);
  void Put(Topic topic, posix::MessageBoard::Bytes bytes) {
    board_.Put(first_topic_ + topic, std::move(bytes));
  }

  ObjectChannel& channel_;
  ChannelReader& reader_;
  int object_;
  std::size_t first_topic_;
  posix::MessageBoard& board_;
  RunMetrics& metrics_;

  std::vector<FrameResult> results_;  ///< New ones.
  FrameResult newest_;
  ViewStatus status_;
  std::int64_t status_ns_ = 0;   ///< When it was sent.
  std::int64_t counted_ns_ = 0;  ///< Since when frames are counted.
  int counted_ = 0;

  std::atomic<bool> settings_wanted_ = true;
  std::uint32_t settings_version_ = 0;

  bool requested_ = false;
  std::int64_t surface_due_ns_ = 0;
  std::uint8_t surface_reset_ = 0;
  /// Than the model's own detail.
  static constexpr float kCoarserAtFirst = 2.0F;
  float coarser_ = kCoarserAtFirst;
};

}  // namespace disflow::apps
