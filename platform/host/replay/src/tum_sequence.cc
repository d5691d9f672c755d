// SPDX-License-Identifier: BSD-3-Clause
#include "tum_sequence.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "disflow/host/rigid_state.h"
#include "disflow/host/sequence_layout.h"
#include "stamp_text.h"
#include "text_table.h"

namespace disflow::host {
namespace {

namespace fs = std::filesystem;

using WorldPose = Transform<World, Camera, double>;

struct StampedWorldPose {
  StampNs stamp_ns = 0;
  WorldPose T_wc;
};

/// Names come from a file of others and must stay in its folder.
bool IsInside(const fs::path& name) {
  return name.is_relative() && std::find(name.begin(), name.end(), "..") == name.end();
}

/// `stamp tx ty tz qx qy qz qw`.
hal::Fault ParsePose(const TextTable& table, const TableRow& row, StampedWorldPose& pose) {
  std::vector<double> n;
  const hal::Fault fault = table.ParseNumbers(row, 8, n);
  if (!fault.ok()) return fault;
  if (!ParseStamp(row.fields[0], pose.stamp_ns))
    return table.LineFault(row, "does not begin with a stamp in seconds");
  const WorldPose::Quaternion rotation(n[7], n[4], n[5], n[6]);
  constexpr double kTolerance = 0.01;
  if (std::abs(rotation.norm() - 1.0) > kTolerance)
    return table.LineFault(row, "qx qy qz qw is no unit quaternion");
  pose.T_wc = WorldPose(rotation, Vec3d(n[1], n[2], n[3]));
  return {};
}

hal::Fault ReadPoses(const fs::path& file, std::vector<StampedWorldPose>& poses) {
  TextTable table;
  hal::Fault fault = table.Read(file);
  if (!fault.ok()) return fault;
  for (const TableRow& row : table.rows()) {
    StampedWorldPose pose;
    fault = ParsePose(table, row, pose);
    if (!fault.ok()) return fault;
    if (!poses.empty() && pose.stamp_ns <= poses.back().stamp_ns)
      return table.LineFault(row, "its stamp is not later than that of the line before");
    poses.push_back(pose);
  }
  return {};
}

/// Share 0 gives `a`, 1 gives `b`.
WorldPose Between(const WorldPose& a, const WorldPose& b, double share) {
  return a * Transform<Camera, Camera, double>::Exp(share * (a.Inverse() * b).Log());
}

}  // namespace

hal::Fault ListTumSequence(const ReplayOptions& options, SequenceIndex& index) {
  constexpr float kTumUnit_m = 1.0F / 5000.0F;
  index.layout = SequenceLayout::kTum;
  hal::Fault fault = CheckRate(options, kTumDepthFile);
  if (fault.ok() && !options.camera) fault = ReadCamera(options.dir, index.camera);
  TextTable table;
  if (fault.ok()) fault = table.Read(options.dir / kTumDepthFile);
  if (!fault.ok()) return fault;
  for (const TableRow& row : table.rows()) {
    RecordedFrame& frame = index.frames.emplace_back();
    if (row.fields.size() < 2 || !ParseStamp(row.fields[0], frame.stamp_ns))
      return table.LineFault(row, "a stamp in seconds and the name of an image are needed");
    if (!IsInside(row.fields[1]))
      return table.LineFault(row, "names an image that is not in this folder");
    frame.number = index.frames.size() - 1;
    frame.depth = (options.dir / row.fields[1]).string();
    frame.unit_m = kTumUnit_m;
  }
  if (!index.frames.empty()) return {};
  return hal::MakeFault(Status::kNotFound, "%s: names no image",
                        (options.dir / kTumDepthFile).c_str());
}

hal::Fault ReadTumWorldPoses(const fs::path& dir, std::vector<RecordedFrame>& frames) {
  constexpr StampNs kLongestGap_ns = 100'000'000;
  std::vector<StampedWorldPose> poses;
  const hal::Fault fault = ReadPoses(dir / kTumPoseFile, poses);
  if (!fault.ok()) return fault;
  for (RecordedFrame& frame : frames) {
    const auto b = std::upper_bound(
        poses.begin(), poses.end(), frame.stamp_ns,
        [](StampNs stamp_ns, const StampedWorldPose& pose) { return stamp_ns < pose.stamp_ns; });
    if (b == poses.begin() || b == poses.end()) continue;
    const auto a = b - 1;
    const StampNs gap_ns = b->stamp_ns - a->stamp_ns;
    if (gap_ns > kLongestGap_ns) continue;
    const double share =
        static_cast<double>(frame.stamp_ns - a->stamp_ns) / static_cast<double>(gap_ns);
    frame.T_wc = Between(a->T_wc, b->T_wc, share).Cast<float>();
    frame.has_T_wc = true;
  }
  return {};
}

}  // namespace disflow::host
