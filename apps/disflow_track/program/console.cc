// SPDX-License-Identifier: BSD-3-Clause
#include "program/console.h"

#include <unistd.h>

#include <algorithm>
#include <cstdio>

namespace disflow::apps {
namespace {

constexpr std::int64_t kPaintInterval_ns = 100'000'000;
constexpr double kDegreesPerRadian = 57.29577951308232;
// Without automatic line wrap a narrow terminal cuts the line instead of scrolling.
constexpr const char* kBeginLine = "\r\033[?7l";
constexpr const char* kClearLine = "\r\033[K";
constexpr const char* kEndLine = "\033[K\033[?7h";

const char* Colour(TrackingState state) noexcept {
  switch (state) {
    case TrackingState::kInitialising:
      return "\033[36m";  // cyan
    case TrackingState::kTracking:
      return "\033[32m";  // green
    case TrackingState::kDegraded:
      return "\033[33m";  // yellow
    case TrackingState::kLost:
      return "\033[31m";  // red
    case TrackingState::kRecovered:
      return "\033[34m";  // blue
  }
  return "";
}

}  // namespace

Console::Console(bool live_line, const std::string& log)
    : target_(log),
      live_line_(live_line && !target_.is_journal() && ::isatty(STDERR_FILENO) != 0) {}

void Console::Say(std::string_view message, Severity severity,
                  std::span<const LogField> fields) noexcept {
  const std::lock_guard lock(mutex_);
  if (target_.is_journal()) {
    Write(MakeJournalEntry(message, severity, fields).bytes());
    return;
  }
  std::array<char, 1024> text;
  const int length = std::snprintf(text.data(), text.size(), "%sdisflow_track: %.*s\n",
                                   line_shown_ ? kClearLine : "", static_cast<int>(message.size()),
                                   message.data());
  line_shown_ = false;
  if (length < 0) return;
  // The reports at the end of a run may be longer; nothing waits for them.
  if (static_cast<std::size_t>(length) < text.size()) {
    Write({text.data(), static_cast<std::size_t>(length)});
    return;
  }
  Write("disflow_track: ");
  Write(message);
  Write("\n");
}

void Console::Show(std::span<const FrameResult> results, std::int64_t now_ns) noexcept {
  if (!live_line_) return;
  if (painted_ns_ == 0) painted_ns_ = now_ns;
  ++frames_;
  for (const FrameResult& result : results) {
    total_ns_ += result.total_ns;
    for (std::size_t i = 0; i < stage_ns_.size(); ++i) stage_ns_[i] += result.estimate.stage_ns[i];
  }
  if (now_ns - painted_ns_ < kPaintInterval_ns) return;
  Paint(results, static_cast<double>(now_ns - painted_ns_) * 1e-9);
  painted_ns_ = now_ns;
  frames_ = 0;
  total_ns_ = 0;
  stage_ns_.fill(0);
}

void Console::ClearLine() noexcept {
  const std::lock_guard lock(mutex_);
  if (line_shown_) Write(kClearLine);
  line_shown_ = false;
}

void Console::Write(std::string_view text) noexcept {
  if (writer_) {
    writer_->Push(text);
    return;
  }
  target_.Write(text);
}

void Console::Paint(std::span<const FrameResult> results, double seconds) noexcept {
  const std::lock_guard lock(mutex_);
  std::array<char, 1024> text{};
  std::size_t size = 0;
  const auto add = [&text, &size](const char* format, auto... values) {
    const int length = std::snprintf(text.data() + size, text.size() - size, format, values...);
    if (length > 0) size = std::min(size + static_cast<std::size_t>(length), text.size() - 1);
  };
  const auto mean_ms = [this](std::int64_t sum_ns) {
    return static_cast<double>(sum_ns) * 1e-6 / frames_;
  };
  add("%sframe %lld  %.1f/s", kBeginLine, static_cast<long long>(results.front().frame),
      frames_ / seconds);
  for (const FrameResult& result : results) {
    const Estimate& estimate = result.estimate;
    add("  %s%s\033[0m  quality %d  %.3f m/s  %.1f deg/s", Colour(estimate.state),
        Name(estimate.state), estimate.quality,
        static_cast<double>(estimate.twist.linear_mps.norm()),
        static_cast<double>(estimate.twist.angular_rps.norm()) * kDegreesPerRadian);
  }
  add("  %.2f ms (", mean_ms(total_ns_));
  for (std::size_t i = 0; i < stage_ns_.size(); ++i) {
    add("%s%s %.2f", i > 0 ? ", " : "", Name(static_cast<Stage>(i)), mean_ms(stage_ns_[i]));
  }
  add(")%s", kEndLine);
  Write({text.data(), size});
  line_shown_ = true;
}

}  // namespace disflow::apps
