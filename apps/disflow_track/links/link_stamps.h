// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>

#include "disflow/hal/depth_sensor.h"
#include "disflow/hal/link_address.h"
#include "disflow/hal/mavlink/time_sync.h"

namespace disflow::apps {

/// The same moment on two clocks.
struct ClockReading {
  std::int64_t monotonic_ns = 0;  ///< CLOCK_MONOTONIC.
  std::int64_t epoch_ns = 0;      ///< CLOCK_REALTIME.
};
[[nodiscard]] ClockReading ReadClocks() noexcept;

/// From capture stamps to those that a link carries. A recording that is played looks as if it were
/// captured now: as late as it may be so that no frame comes before it was captured.
class LinkStamps {
 public:
  using Stamps = hal::LinkAddress::Stamps;
  /// Stamps of a recording that lie farther apart are no pause of the camera: the recording begins
  /// anew there, as for who plays it (StampPacer).
  static constexpr std::int64_t kLongestStep_ns = 5'000'000'000;

  LinkStamps(Stamps wanted, const hal::SensorInfo& sensor) noexcept
      : wanted_(wanted), source_(SourceOf(sensor)) {}

  /// To be told of each frame before its stamps are asked for.
  void Play(StampNs capture_ns, const ClockReading& now) noexcept;
  /// @param other The clock of the autopilot, if that is wanted.
  /// @return Nothing while that is not known.
  [[nodiscard]] std::optional<StampNs> Of(StampNs capture_ns, const ClockReading& now,
                                          const hal::mavlink::TimeSync& other) const noexcept;
  /// @return Now, on the clock of what Of() returns.
  [[nodiscard]] std::optional<StampNs> Now(const ClockReading& now,
                                           const hal::mavlink::TimeSync& other) const noexcept;
  [[nodiscard]] bool wants_autopilot() const noexcept { return wanted_ == Stamps::kAutopilot; }

 private:
  /// What capture stamps are of.
  enum class Source : std::uint8_t { kMonotonic, kEpoch, kRecording };

  [[nodiscard]] static Source SourceOf(const hal::SensorInfo& sensor) noexcept;
  [[nodiscard]] std::optional<StampNs> OfMonotonic(
      std::int64_t monotonic_ns, const ClockReading& now,
      const hal::mavlink::TimeSync& other) const noexcept;

  Stamps wanted_;
  Source source_;
  bool played_ = false;
  StampNs played_ns_ = 0;              ///< The last frame's.
  std::int64_t played_offset_ns_ = 0;  ///< CLOCK_MONOTONIC minus the recording's clock.
};

}  // namespace disflow::apps
