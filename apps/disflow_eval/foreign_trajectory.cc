// SPDX-License-Identifier: BSD-3-Clause
#include "foreign_trajectory.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "errors.h"
#include "text_file.h"

namespace disflow::apps {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kBopHeader = "scene_id,im_id,obj_id,score,R,t,time";
constexpr std::size_t kBopFields = 7;
/// Stamps are printed with six digits at least, or by tools that use float seconds since 1970.
constexpr double kSameStamp_s = 0.002;
/// Rotations are printed with four digits at least.
constexpr double kRotationTolerance = 0.01;

/// Rows in the order of the frames; of several for one frame the one with the best score.
class RowsByFrame {
 public:
  void Put(EstimateRow row, double score) {
    const auto frame = row.frame;
    const auto at = rows_.find(frame);
    if (at != rows_.end() && at->second.score >= score) return;
    rows_.insert_or_assign(frame, Scored{std::move(row), score});
  }
  [[nodiscard]] EstimateTable Take(const fs::path& file) {
    if (rows_.empty()) throw InputError(file, "holds no pose of this object and sequence");
    EstimateTable table;
    table.has_twists = false;
    for (auto& [frame, scored] : rows_) table.rows.push_back(std::move(scored.row));
    return table;
  }

 private:
  struct Scored {
    EstimateRow row;
    double score;
  };
  std::map<int, Scored> rows_;
};

EstimateRow RowOf(int frame, double timestamp_s, const EstimatedPose& T_co) {
  EstimateRow row;
  row.frame = frame;
  row.timestamp_s = timestamp_s;
  row.T_co = T_co;
  return row;
}

/// The frame with the nearest stamp, if that is the same.
std::optional<int> FrameAt(const std::vector<double>& stamps_s, double stamp_s) {
  const auto after = std::lower_bound(stamps_s.begin(), stamps_s.end(), stamp_s - kSameStamp_s);
  if (after == stamps_s.end() || std::abs(*after - stamp_s) > kSameStamp_s) return std::nullopt;
  return static_cast<int>(after - stamps_s.begin());
}

EstimateTable LoadTum(const fs::path& file, std::string_view text, const GroundTruth& truth) {
  if (truth.stamps_s.empty()) {
    throw InputError(file, "rows belong to frames by their stamps, and the sequence has none");
  }
  RowsByFrame rows;
  LineReader lines(text);
  for (Line line; lines.Next(line);) {
    if (line.text.starts_with('#')) continue;
    const std::vector<double> n = ParseNumbers(file, line, 8);
    const std::optional<int> frame = FrameAt(truth.stamps_s, n[0]);
    if (!frame) {
      throw InputError(file, line.number,
                       "no frame of the sequence has this stamp; its first is " +
                           std::to_string(truth.stamps_s.front()) + ", its last " +
                           std::to_string(truth.stamps_s.back()));
    }
    const EstimatedPose::Quaternion q(n[7], n[4], n[5], n[6]);
    if (std::abs(q.norm() - 1.0) > kRotationTolerance) {
      throw InputError(file, line.number,
                       "quaternion has length " + std::to_string(q.norm()) + ", 1 is needed");
    }
    rows.Put(RowOf(*frame, n[0], EstimatedPose(q, Vec3d(n[1], n[2], n[3]))), 0.0);
  }
  return rows.Take(file);
}

/// Numbers between spaces in one field.
std::vector<double> NumbersOf(const fs::path& file, const Line& line, std::string_view field,
                              std::size_t count, const char* name) {
  try {
    return ParseNumbers(file, {line.number, field}, count);
  } catch (const InputError&) {
    throw InputError(file, line.number,
                     std::string("field ") + name + " does not hold " + std::to_string(count) +
                         " numbers between spaces");
  }
}

EstimatedPose BopPose(const fs::path& file, const Line& line,
                      const std::vector<std::string_view>& fields) {
  constexpr double kMillimetre_m = 1e-3;
  const std::vector<double> r = NumbersOf(file, line, fields[4], 9, "R");
  const std::vector<double> t = NumbersOf(file, line, fields[5], 3, "t");
  Mat3d rotation;
  rotation << r[0], r[1], r[2], r[3], r[4], r[5], r[6], r[7], r[8];
  const bool is_rotation =
      (rotation * rotation.transpose() - Mat3d::Identity()).cwiseAbs().maxCoeff() <
          kRotationTolerance &&
      rotation.determinant() > 0.0;
  if (!is_rotation) throw InputError(file, line.number, "R is no rotation");
  const EstimatedPose::Quaternion q(rotation);
  return {q.normalized(), kMillimetre_m * Vec3d(t[0], t[1], t[2])};
}

EstimateTable LoadBop(const fs::path& file, std::string_view text, const GroundTruth& truth,
                      const std::string& object) {
  constexpr double kMilliseconds = 1e3;
  RowsByFrame rows;
  LineReader lines(text);
  Line line;
  (void)lines.Next(line);  // the header
  std::optional<double> object_id = ParseNumber(object);
  std::optional<double> scene_id;
  bool has_times = true;
  while (lines.Next(line)) {
    const std::vector<std::string_view> fields = SplitAt(line.text, ',');
    if (fields.size() != kBopFields) {
      throw InputError(file, line.number,
                       "holds " + std::to_string(fields.size()) + " fields, " +
                           std::string(kBopHeader) + " are needed");
    }
    const double scene = ParseFinite(file, line, "scene_id", fields[0]);
    const double id = ParseFinite(file, line, "obj_id", fields[2]);
    if (!object.empty() && object_id && id != *object_id) continue;
    if (!object_id) object_id = id;
    if (!scene_id) scene_id = scene;
    if (id != *object_id || scene != *scene_id) {
      throw InputError(file, line.number,
                       "is of another scene or object than the rows before; one scene is judged at "
                       "a time, and --object names the obj_id");
    }
    const int image = ParseIndex(file, line, "im_id", fields[1]);
    const auto at = std::find(truth.file_indices.begin(), truth.file_indices.end(), image);
    if (at == truth.file_indices.end()) {
      throw InputError(file, line.number,
                       "image " + std::to_string(image) + " is not in the sequence");
    }
    const auto frame = static_cast<std::size_t>(at - truth.file_indices.begin());
    EstimateRow row =
        RowOf(static_cast<int>(frame), truth.stamps_s.empty() ? 0.0 : truth.stamps_s[frame],
              BopPose(file, line, fields));
    const double time_s = ParseFinite(file, line, "time", fields[6]);
    has_times = has_times && time_s >= 0.0;
    row.stage_ms = {kMilliseconds * time_s};
    rows.Put(std::move(row), ParseFinite(file, line, "score", fields[3]));
  }
  EstimateTable table = rows.Take(file);
  // By the benchmark's rule -1 says that it was not measured.
  if (has_times) table.stage_names = {"total"};
  return table;
}

}  // namespace

EstimateTable LoadTrajectory(const fs::path& file, const GroundTruth& truth,
                             const std::string& object) {
  const std::string text = ReadFile(file);
  LineReader lines(text);
  Line first;
  while (lines.Next(first) && first.text.starts_with('#')) {
  }
  if (first.text.starts_with("scene_id")) return LoadBop(file, text, truth, object);
  const bool has_commas = first.text.find(',') != std::string_view::npos;
  if (!has_commas && SplitAtSpaces(first.text).size() == 8) return LoadTum(file, text, truth);
  return LoadEstimates(file, static_cast<int>(truth.T_ct.size()));
}

}  // namespace disflow::apps
