// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "disflow/hal/mavlink/standard_messages.h"

/// @file
/// DisFlow's private messages, see docs/disflow.xml and messages.h.

namespace disflow::hal::mavlink {

/// DISFLOW_STATUS (#13721360 = 0xD15F10), private: see docs/disflow.xml.
struct DisflowStatus {
  static constexpr std::uint32_t kId = 0xD15F10;
  static constexpr std::string_view kName = "DISFLOW_STATUS";

  static constexpr std::uint32_t kAgeUnknown = 0xFFFFFFFF;

  std::uint64_t time_usec = 0;         ///< Capture time, as in ODOMETRY.
  float score = 0.0F;                  ///< Share of samples that the model explains, 0..1.
  float rms_m = 0.0F;                  ///< Root mean square of the inliers' distances.
  std::uint32_t age_us = kAgeUnknown;  ///< From capture to sending.
  // Totals since the tracker was constructed, so that a lost packet loses no count.
  std::uint32_t frames = 0;
  std::uint32_t dropped_frames = 0;  ///< Lost between sensor and tracker.
  std::uint32_t frames_rejected = 0;
  std::uint32_t frames_unregistered = 0;
  std::uint32_t observations_rejected = 0;
  std::uint32_t samples_dropped = 0;
  std::uint32_t samples_refused = 0;
  std::uint32_t clusters_evicted = 0;
  // Of this frame.
  std::uint16_t samples = 0;
  std::uint16_t inliers = 0;
  std::uint16_t edge_inliers = 0;
  std::uint16_t residuals_unmatched = 0;
  std::uint16_t residuals_truncated = 0;
  std::uint16_t residuals_normal_mismatch = 0;
  std::uint8_t state = 0;   ///< TrackingState.
  std::uint8_t status = 0;  ///< disflow::Status.
  std::uint8_t quality = 0;
  std::uint8_t reset_counter = 0;
  // Totals of the sensor, extension fields.
  std::uint32_t corrupt_frames = 0;
  std::uint16_t sensor_restarts = 0;
  std::uint16_t sensor_reconnects = 0;

  template <class Self, class Visitor>
  static constexpr void VisitFields(Self& message, Visitor& field) {
    field("time_usec", message.time_usec);
    field("score", message.score);
    field("rms_m", message.rms_m);
    field("age_us", message.age_us);
    field("frames", message.frames);
    field("dropped_frames", message.dropped_frames);
    field("frames_rejected", message.frames_rejected);
    field("frames_unregistered", message.frames_unregistered);
    field("observations_rejected", message.observations_rejected);
    field("samples_dropped", message.samples_dropped);
    field("samples_refused", message.samples_refused);
    field("clusters_evicted", message.clusters_evicted);
    field("samples", message.samples);
    field("inliers", message.inliers);
    field("edge_inliers", message.edge_inliers);
    field("residuals_unmatched", message.residuals_unmatched);
    field("residuals_truncated", message.residuals_truncated);
    field("residuals_normal_mismatch", message.residuals_normal_mismatch);
    field("state", message.state);
    field("status", message.status);
    field("quality", message.quality);
    field("reset_counter", message.reset_counter);
    field("corrupt_frames", message.corrupt_frames, FieldKind::kExtension);
    field("sensor_restarts", message.sensor_restarts, FieldKind::kExtension);
    field("sensor_reconnects", message.sensor_reconnects, FieldKind::kExtension);
  }
};

/// DISFLOW_READY (#13721361 = 0xD15F11), private: a controller that gets its depth images over this
/// line can take the next one. Counts since it started.
struct DisflowReady {
  static constexpr std::uint32_t kId = 0xD15F11;
  static constexpr std::string_view kName = "DISFLOW_READY";

  std::uint32_t sequence = 0;         ///< Of the frame or poll that this answers; 0 = none yet.
  std::uint32_t frames = 0;           ///< Whole frames handed to the tracker.
  std::uint32_t frames_lost = 0;      ///< Begun, but not received whole.
  std::uint32_t frames_refused = 0;   ///< Larger than the memory for them, or without intrinsics.
  std::uint32_t packets = 0;          ///< With a correct checksum.
  std::uint32_t packets_corrupt = 0;  ///< What lay between two delimiters was no valid packet.
  std::uint32_t bytes_lost = 0;       ///< Arrived while the receive buffer was full.

  template <class Self, class Visitor>
  static constexpr void VisitFields(Self& message, Visitor& field) {
    field("sequence", message.sequence);
    field("frames", message.frames);
    field("frames_lost", message.frames_lost);
    field("frames_refused", message.frames_refused);
    field("packets", message.packets);
    field("packets_corrupt", message.packets_corrupt);
    field("bytes_lost", message.bytes_lost);
  }
};

/// DISFLOW_TIMING (#13721362 = 0xD15F12), private: where a controller's time and stack went.
struct DisflowTiming {
  static constexpr std::uint32_t kId = 0xD15F12;
  static constexpr std::string_view kName = "DISFLOW_TIMING";
  static constexpr std::size_t kStages = 6;

  std::uint64_t time_usec = 0;                    ///< Capture time, as in ODOMETRY.
  std::uint64_t frame_ns = 0;                     ///< The tracker's whole work on this frame.
  std::array<std::uint64_t, kStages> stage_ns{};  ///< In the order of disflow::Stage.
  std::uint32_t stages_late = 0;                  ///< Stages beyond their budget, since the start.
  std::uint32_t restarts = 0;                     ///< By the watchdog or a fault, since power-on.
  std::uint32_t stack_bytes = 0;                  ///< High-water mark of the stack.

  template <class Self, class Visitor>
  static constexpr void VisitFields(Self& message, Visitor& field) {
    field("time_usec", message.time_usec);
    field("frame_ns", message.frame_ns);
    field("stage_ns", message.stage_ns);
    field("stages_late", message.stages_late);
    field("restarts", message.restarts);
    field("stack_bytes", message.stack_bytes);
  }
};

/// DISFLOW_QUERY (#13721363 = 0xD15F13), private: asks for the distance field at points of the
/// object frame. Answered by DISFLOW_FIELD.
struct DisflowQuery {
  static constexpr std::uint32_t kId = 0xD15F13;
  static constexpr std::string_view kName = "DISFLOW_QUERY";
  static constexpr std::size_t kPoints = 10;

  std::uint32_t request = 0;  ///< Comes back with the answer.
  std::array<float, kPoints> x{};
  std::array<float, kPoints> y{};
  std::array<float, kPoints> z{};
  std::uint8_t target_system = 0;
  std::uint8_t target_component = 0;  ///< Of the object; 0 = the first.
  std::uint8_t count = 0;             ///< Points used, 1 to kPoints.

  template <class Self, class Visitor>
  static constexpr void VisitFields(Self& message, Visitor& field) {
    field("request", message.request);
    field("x", message.x);
    field("y", message.y);
    field("z", message.z);
    field("target_system", message.target_system);
    field("target_component", message.target_component);
    field("count", message.count);
  }
};

/// DISFLOW_FIELD (#13721364 = 0xD15F14), private: the answer to a DISFLOW_QUERY, point by point.
struct DisflowField {
  static constexpr std::uint32_t kId = 0xD15F14;
  static constexpr std::string_view kName = "DISFLOW_FIELD";
  static constexpr std::size_t kPoints = DisflowQuery::kPoints;

  std::uint64_t time_usec = 0;  ///< Capture time of the frame that the model has learnt from.
  std::uint32_t request = 0;
  std::array<float, kPoints> distance{};  ///< m; NaN: no answer for this point.
  std::array<float, kPoints> gradient_x{};
  std::array<float, kPoints> gradient_y{};
  std::array<float, kPoints> gradient_z{};
  std::array<float, kPoints> variance{};  ///< Of the distance, m^2.
  std::uint16_t in_bounds = 0;            ///< Bit i: surface was seen near point i.
  std::uint8_t count = 0;
  std::uint8_t status = 0;  ///< disflow::Status; kNotInitialised: there is no model.

  template <class Self, class Visitor>
  static constexpr void VisitFields(Self& message, Visitor& field) {
    field("time_usec", message.time_usec);
    field("request", message.request);
    field("distance", message.distance);
    field("gradient_x", message.gradient_x);
    field("gradient_y", message.gradient_y);
    field("gradient_z", message.gradient_z);
    field("variance", message.variance);
    field("in_bounds", message.in_bounds);
    field("count", message.count);
    field("status", message.status);
  }
};

}  // namespace disflow::hal::mavlink
