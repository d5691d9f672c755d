// SPDX-License-Identifier: BSD-3-Clause
#include "frame_table.h"

#include <cmath>
#include <limits>

#include "units.h"

namespace disflow::apps {
namespace {

double NeesAt(const std::optional<Consistency>& consistency, std::size_t i) {
  return consistency ? consistency->by_frame[i] : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace

std::string FormatFrames(const Report& report) {
  std::string text =
      "frame,time_s,translation_m,rotation_deg,add_m,add_s_m,linear_mps,angular_degps,pose_nees,"
      "twist_nees,state\n";
  for (std::size_t i = 0; i < report.poses.frames.size(); ++i) {
    const FrameError& error = report.poses.frames[i];
    text += Format("%d,%.6f,%.7f,%.6f,%.7f,%.7f,%.6f,%.5f,%.5g,%.5g,%s\n", error.frame,
                   error.timestamp_s - report.poses.frames.front().timestamp_s, error.translation_m,
                   kDegrees * error.rotation_rad, error.add_m, error.add_s_m, error.linear_mps,
                   kDegrees * error.angular_rps, NeesAt(report.pose_consistency, i),
                   NeesAt(report.twist_consistency, i), report.run.frames[i].row->state.c_str());
  }
  return text;
}

}  // namespace disflow::apps
