// SPDX-License-Identifier: BSD-3-Clause
#include "run/service_status.h"

#include <algorithm>
#include <array>
#include <cstdio>

namespace disflow::apps {
namespace {

constexpr std::int64_t kReportEvery_ns = 2'000'000'000;

}  // namespace

void ServiceStatus::Turn(std::span<const FrameResult> results, bool source_is_alive,
                         std::int64_t now_ns) noexcept {
  if (!notifier_.active()) return;
  if (source_is_alive) notifier_.Beat(now_ns);
  if (reported_ns_ == 0 || now_ns - reported_ns_ >= kReportEvery_ns) Report(results, now_ns);
}

void ServiceStatus::Report(std::span<const FrameResult> results, std::int64_t now_ns) noexcept {
  std::array<char, 160> text{};
  const FrameResult& result = results.front();  // what is the same for all objects is in each
  if (result.frame == reported_frame_) {
    (void)std::snprintf(text.data(), text.size(), "no frames from the sensor");
  } else {
    const double seconds = static_cast<double>(now_ns - reported_ns_) * 1e-9;
    const double rate_hz =
        reported_ns_ == 0 ? 0.0 : static_cast<double>(result.frame - reported_frame_) / seconds;
    std::size_t size = 0;
    for (const FrameResult& object : results) {
      const int length = std::snprintf(text.data() + size, text.size() - size, "%s, quality %d, ",
                                       Name(object.estimate.state), object.estimate.quality);
      if (length > 0) size = std::min(size + static_cast<std::size_t>(length), text.size() - 1);
    }
    (void)std::snprintf(text.data() + size, text.size() - size, "%.1f frames/s, %u frames dropped",
                        rate_hz, result.sensor.dropped);
  }
  notifier_.Status(text.data());
  reported_ns_ = now_ns;
  reported_frame_ = result.frame;
}

}  // namespace disflow::apps
