// SPDX-License-Identifier: BSD-3-Clause
#include "run/state_log.h"

#include <array>
#include <charconv>
#include <cstdio>

#include "program/status_token.h"

namespace disflow::apps {
namespace {

constexpr std::int64_t kQuiet_ns = 1'000'000'000;
/// `journalctl MESSAGE_ID=…` finds all of them.
constexpr std::string_view kMessageId = "6d1f0c5b7a3e4f6e9b0c8a2d4e5f7a91";

/// A number as text, in fixed memory.
class Digits {
 public:
  explicit Digits(std::int64_t value) noexcept
      : size_(static_cast<std::size_t>(
            std::to_chars(text_.data(), text_.data() + text_.size(), value).ptr - text_.data())) {}
  [[nodiscard]] std::string_view text() const noexcept { return {text_.data(), size_}; }

 private:
  std::array<char, 24> text_;
  std::size_t size_;
};

Severity SeverityOf(TrackingState state) noexcept {
  return state == TrackingState::kLost || state == TrackingState::kDegraded ? Severity::kWarning
                                                                            : Severity::kNotice;
}

}  // namespace

void StateLog::Turn(std::span<const FrameResult> results, std::int64_t now_ns,
                    Console& console) noexcept {
  if (!console.is_structured()) return;
  for (std::size_t i = 0; i < objects_.size(); ++i) {
    Object& object = objects_[i];
    const FrameResult& result = results[i];
    const Estimate& estimate = result.estimate;
    if (estimate.state != object.seen) ++object.changes;
    object.seen = estimate.state;
    if (object.changes == 0 || (object.any_said && now_ns - object.said_ns < kQuiet_ns)) continue;
    std::array<char, 256> message{};
    const int length =
        std::snprintf(message.data(), message.size(), "%s: %s (was %s), quality %d",
                      names_[i].c_str(), Name(estimate.state), Name(object.said), estimate.quality);
    if (length < 0) continue;
    const Digits quality(estimate.quality);
    const Digits frame(result.frame);
    const Digits restarts(estimate.reset_counter);
    const Digits changes(object.changes);
    const std::array<LogField, 9> fields = {{{"MESSAGE_ID", kMessageId},
                                             {"DISFLOW_OBJECT", names_[i]},
                                             {"DISFLOW_STATE", Name(estimate.state)},
                                             {"DISFLOW_STATE_BEFORE", Name(object.said)},
                                             {"DISFLOW_STATE_CHANGES", changes.text()},
                                             {"DISFLOW_STATUS", StatusToken(estimate.status)},
                                             {"DISFLOW_QUALITY", quality.text()},
                                             {"DISFLOW_FRAME", frame.text()},
                                             {"DISFLOW_RESET_COUNTER", restarts.text()}}};
    console.Say({message.data(), std::min(message.size() - 1, static_cast<std::size_t>(length))},
                SeverityOf(estimate.state), fields);
    object.said = estimate.state;
    object.changes = 0;
    object.any_said = true;
    object.said_ns = now_ns;
  }
}

}  // namespace disflow::apps
