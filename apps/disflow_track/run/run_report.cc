// SPDX-License-Identifier: BSD-3-Clause
#include "run/run_report.h"

#include <algorithm>

#include "program/counter_names.h"
#include "program/status_token.h"

namespace disflow::apps {
namespace {

/// What the first lines of a report say of frames.
[[nodiscard]] bool IsSaidOtherwise(std::uint32_t Counters::*counter) noexcept {
  return counter == &Counters::frames || counter == &Counters::frames_rejected ||
         counter == &Counters::frames_unregistered;
}

template <class... Values>
std::string Print(const char* format, Values... values) {
  std::array<char, 256> text{};
  (void)std::snprintf(text.data(), text.size(), format, values...);
  return text.data();
}

/// What the sensor had to struggle with; empty if nothing.
std::string FormatSensor(const hal::SensorCounters& sensor) {
  std::string text;
  if (sensor.dropped > 0) {
    text += Print(" (%u in the driver, %u for a newer one)", sensor.gaps, sensor.skipped);
  }
  if (sensor.corrupt > 0) text += Print(", %u corrupt", sensor.corrupt);
  if (sensor.restarts > 0) text += Print(", stream stalled or failed %u times", sensor.restarts);
  if (sensor.reconnects > 0) text += Print(", sensor came back %u times", sensor.reconnects);
  return text;
}

}  // namespace

std::string FormatTimes(const DurationHistogram& times) {
  return Print("time per frame: median %.2f ms, 99 %% below %.2f ms", times.Percentile_ms(0.5),
               times.Percentile_ms(0.99));
}

void RunReport::Add(const FrameResult& result) noexcept {
  const Estimate& estimate = result.estimate;
  ++frames_;
  ++by_status_[static_cast<std::size_t>(estimate.status)];
  if (KindOf(estimate) == EstimateKind::kMeasured) ++registered_;
  total_.Add(result.total_ns);
  totals_ = result.totals;
  model_coarseness_ = result.model_coarseness;
  sensor_ = result.sensor;
  state_ = estimate.state;
  quality_ = estimate.quality;
  restarts_ = estimate.reset_counter;
}

Status RunReport::most_frequent_fault() const noexcept {
  const auto first = by_status_.begin() + 1;  // 0 is kOk
  const auto most = std::max_element(first, by_status_.end());
  return *most > 0 ? static_cast<Status>(most - by_status_.begin()) : Status::kOk;
}

std::string RunReport::Format(double seconds) const {
  std::string text = Print("%lld frames in %.2f s (%.1f/s), %lld with a measured pose",
                           static_cast<long long>(frames_), seconds,
                           static_cast<double>(frames_) / std::max(seconds, 1e-9),
                           static_cast<long long>(registered_));
  for (std::size_t i = 1; i < by_status_.size(); ++i) {
    if (by_status_[i] > 0) {
      text += Print(", %lld %s", static_cast<long long>(by_status_[i]),
                    StatusToken(static_cast<Status>(i)));
    }
  }
  text += Print("\n  at the end: %s, quality %d, %d restarts, %u frames dropped", Name(state_),
                quality_, restarts_, sensor_.dropped);
  text += FormatSensor(sensor_);
  text += "\n  " + FormatTimes(total_);
  if (model_coarseness_ > 1.0F) {
    text += Print(
        "\n  model: %.1f times coarser than set, to hold all of so large an object "
        "(field.fit_to_object); a larger profile holds it finer",
        static_cast<double>(model_coarseness_));
  }
  text += "\n  rejected:";
  const std::size_t without_counters = text.size();
  for (const auto& counter : kTrackerCounters) {
    const std::uint32_t value = totals_.*counter.member;
    if (value == 0 || IsSaidOtherwise(counter.member)) continue;
    if (text.size() > without_counters) text += ",";
    text += Print(" %s %u", counter.words, value);
  }
  if (text.size() == without_counters) text += " nothing";
  return text;
}

}  // namespace disflow::apps
