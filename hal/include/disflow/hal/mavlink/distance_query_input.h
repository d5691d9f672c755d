// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "disflow/field/distance_query.h"
#include "disflow/hal/mavlink/frame.h"
#include "disflow/hal/mavlink/messages.h"
#include "disflow/hal/mavlink/telemetry.h"
#include "disflow/memory/fixed_vector.h"

namespace disflow::hal::mavlink {

/// Keeps the questions of one link until they are answered. There is room for few: answering is
/// bounded work between two frames.
class DistanceQueryInput {
 public:
  static constexpr int kMaxWaiting = 4;

  /// @param system_id Who is asked; questions to others are not for us.
  explicit DistanceQueryInput(std::uint8_t system_id = TelemetryOptions{}.system_id) noexcept
      : system_id_(system_id) {}

  /// Other messages are passed over.
  void Take(const FrameView& frame) noexcept;

  /// Oldest first; `count` is from 1 to DisflowQuery::kPoints.
  [[nodiscard]] const FixedVector<DisflowQuery, kMaxWaiting>& waiting() const noexcept {
    return waiting_;
  }
  void Clear() noexcept { waiting_.clear(); }
  /// Questions that found no room or made no sense; saturating.
  [[nodiscard]] std::uint32_t refused() const noexcept { return refused_; }

 private:
  std::uint8_t system_id_;
  FixedVector<DisflowQuery, kMaxWaiting> waiting_;
  std::uint32_t refused_ = 0;
};

/// @param stamp_ns Of the frame that the model has learnt from.
/// @param ask Expected<DistanceQuery>(const Vec3& x_m), see DistanceQuerier::Query().
template <class Ask>
[[nodiscard]] DisflowField AnswerQuery(const DisflowQuery& query, StampNs stamp_ns,
                                       Ask&& ask) noexcept {
  DisflowField field;
  field.time_usec = MicrosecondsOf(stamp_ns);
  field.request = query.request;
  field.count = std::min<std::uint8_t>(query.count, DisflowQuery::kPoints);
  for (std::size_t i = 0; i < field.count; ++i) {
    const Expected<DistanceQuery> answer = ask(Vec3(query.x[i], query.y[i], query.z[i]));
    if (answer.status == Status::kNotInitialised) {
      field.status = static_cast<std::uint8_t>(answer.status);
    }
    if (!answer.ok()) {
      field.distance[i] = std::numeric_limits<float>::quiet_NaN();
      continue;
    }
    field.distance[i] = answer.value.distance_m;
    field.gradient_x[i] = answer.value.gradient.x();
    field.gradient_y[i] = answer.value.gradient.y();
    field.gradient_z[i] = answer.value.gradient.z();
    field.variance[i] = answer.value.variance_m2;
    if (answer.value.in_bounds) {
      field.in_bounds = static_cast<std::uint16_t>(field.in_bounds | (1U << i));
    }
  }
  return field;
}

}  // namespace disflow::hal::mavlink
