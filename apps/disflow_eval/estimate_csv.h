// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "frames.h"

namespace disflow::apps {

/// One frame as the tracker saw it.
struct EstimateRow {
  int frame = 0;  ///< Position in the sequence, from 0.
  double timestamp_s = 0.0;
  bool has_motion = true;  ///< false: the frame was refused, and neither pose nor twist are known.
  EstimatedPose T_co;
  PointTwist twist;                      ///< Of the object frame's origin.
  std::string status;                    ///< Empty if the file has no such column.
  std::string state;                     ///< Empty if the file has no such column.
  std::optional<Mat6d> pose_covariance;  ///< (x y z rx ry rz), camera axes; columns cov_pose_0..20.
  std::optional<Mat6d> twist_covariance;  ///< (v, omega), camera axes; columns cov_twist_0..20.
  /// Milliseconds per stage, in the order of EstimateTable::stage_names; NaN = not given.
  std::vector<double> stage_ms;
};

/// A trajectory file: rows with increasing frame numbers.
struct EstimateTable {
  std::vector<EstimateRow> rows;  ///< Never empty.
  bool has_twists = true;
  std::vector<std::string> stage_names;  ///< Columns that end in "_ms", without that suffix.

  /// @return Position of a stage in stage_ms, or nothing.
  [[nodiscard]] std::optional<std::size_t> FindStage(std::string_view name) const;
};

/// Reads a CSV with the columns frame, timestamp, x..z, qx..qw, vx..vz, wx..wz in any order; others
/// are optional. Covers empty fields and NaN in optional columns (= not given), and NaN
/// for pose and twist as a whole where the status is not "ok".
/// @param frame_count Frames of the sequence; a row beyond them is refused.
/// @throws InputError naming file, line and reason.
[[nodiscard]] EstimateTable LoadEstimates(const std::filesystem::path& file, int frame_count);

}  // namespace disflow::apps
