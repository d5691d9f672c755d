// SPDX-License-Identifier: BSD-3-Clause
#include "service_status.h"

#include <array>
#include <cstdio>

namespace disflow::apps {
namespace {

constexpr std::int64_t kInterval_ns = 2'000'000'000;

}  // namespace

void ServiceStatus::Turn(const FrameResult& result, bool source_is_alive,
                         std::int64_t now_ns) noexcept {
  if (!notifier_.active()) return;
  if (source_is_alive) notifier_.Beat(now_ns);
  if (reported_ns_ == 0 || now_ns - reported_ns_ >= kInterval_ns) Report(result, now_ns);
}

void ServiceStatus::Report(const FrameResult& result, std::int64_t now_ns) noexcept {
  std::array<char, 160> text{};
  if (result.frame == reported_frame_) {
    (void)std::snprintf(text.data(), text.size(), "no frames from the sensor");
  } else {
    const double seconds = static_cast<double>(now_ns - reported_ns_) * 1e-9;
    const double rate_hz =
        reported_ns_ == 0 ? 0.0 : static_cast<double>(result.frame - reported_frame_) / seconds;
    (void)std::snprintf(
        text.data(), text.size(), "%s, quality %d, %.1f frames/s, %u frames dropped",
        Name(result.estimate.state), result.estimate.quality, rate_hz, result.sensor.dropped);
  }
  notifier_.Status(text.data());
  reported_ns_ = now_ns;
  reported_frame_ = result.frame;
}

}  // namespace disflow::apps
