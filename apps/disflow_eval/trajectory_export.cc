// SPDX-License-Identifier: BSD-3-Clause
#include "trajectory_export.h"

#include <cmath>
#include <filesystem>

#include "errors.h"
#include "text_file.h"
#include "units.h"

namespace disflow::apps {
namespace {

std::string TumLine(double stamp_s, const TruePose& T_ct) {
  const Vec3d& t = T_ct.translation();
  const auto q = T_ct.rotation_quaternion();
  return Format("%.9f %.9f %.9f %.9f %.9f %.9f %.9f %.9f\n", stamp_s, t.x(), t.y(), t.z(), q.x(),
                q.y(), q.z(), q.w());
}

/// @return 1 if it is no whole number from 0 on.
int NumberOr1(const std::string& text) {
  const std::optional<double> number = ParseNumber(text);
  const bool is_whole = number && *number >= 0.0 && *number < 1e9 && std::floor(*number) == *number;
  return is_whole ? static_cast<int>(*number) : 1;
}

std::string SceneName(const std::string& sequence) {
  const std::filesystem::path path(sequence);
  return (path.has_filename() ? path : path.parent_path()).filename().string();
}

}  // namespace

std::string FormatTum(const Report& report) {
  std::string text = "# stamp tx ty tz qx qy qz qw, object in the camera's frame, m\n";
  for (const AlignedFrame& frame : report.run.frames) {
    if (IsMeasured(*frame.row)) text += TumLine(frame.row->timestamp_s, frame.T_ct_estimated);
  }
  return text;
}

std::string FormatTumTruth(const Report& report) {
  if (report.truth.stamps_s.empty())
    throw InputError(report.sequence, "has no stamps, which a TUM trajectory needs");
  std::string text = "# stamp tx ty tz qx qy qz qw, object in the camera's frame, m\n";
  for (std::size_t k = 0; k < report.truth.T_ct.size(); ++k)
    text += TumLine(report.truth.stamps_s[k], report.truth.T_ct[k]);
  return text;
}

std::string FormatBop(const Report& report, const std::string& object) {
  constexpr double kSecondsPerMs = 1e-3;
  const std::optional<std::size_t> total = report.estimates.FindStage("total");
  const int scene = NumberOr1(SceneName(report.sequence));
  const int id = NumberOr1(object);
  std::string text = "scene_id,im_id,obj_id,score,R,t,time\n";
  for (const AlignedFrame& frame : report.run.frames) {
    if (!IsMeasured(*frame.row)) continue;
    const Mat3d r = frame.T_ct_estimated.rotation();
    const Vec3d t = kMillimetres * frame.T_ct_estimated.translation();
    const double ms = total ? frame.row->stage_ms[*total] : -1.0;
    text += Format("%d,%d,%d,1,%.9f %.9f %.9f %.9f %.9f %.9f %.9f %.9f %.9f,%.6f %.6f %.6f,%.6f\n",
                   scene, report.truth.file_indices[static_cast<std::size_t>(frame.row->frame)], id,
                   r(0, 0), r(0, 1), r(0, 2), r(1, 0), r(1, 1), r(1, 2), r(2, 0), r(2, 1), r(2, 2),
                   t.x(), t.y(), t.z(), ms >= 0.0 ? kSecondsPerMs * ms : -1.0);
  }
  return text;
}

}  // namespace disflow::apps
