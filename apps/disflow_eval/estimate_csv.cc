// SPDX-License-Identifier: BSD-3-Clause
#include "estimate_csv.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>

#include "errors.h"
#include "text_file.h"

namespace disflow::apps {
namespace {

namespace fs = std::filesystem;

constexpr std::array<std::string_view, 15> kRequired = {"frame", "timestamp", "x",  "y",  "z",
                                                        "qx",    "qy",        "qz", "qw", "vx",
                                                        "vy",    "vz",        "wx", "wy", "wz"};
constexpr std::size_t kFirstOfMotion = 2;  // of kRequired: x
constexpr std::string_view kMillisecondsSuffix = "_ms";
/// Quaternions are printed with at least three digits; farther from unit length is no rotation.
constexpr double kQuaternionTolerance = 0.01;
constexpr std::size_t kTriangle = 21;  // upper triangle of a 6x6 matrix

/// Which column holds what.
struct Columns {
  std::map<std::string, std::size_t, std::less<>> by_name;
  std::array<std::size_t, kRequired.size()> required{};
  std::vector<std::size_t> stages;
  std::vector<std::size_t> pose_covariance;   // empty or kTriangle
  std::vector<std::size_t> twist_covariance;  // empty or kTriangle
};

std::vector<std::size_t> CovarianceColumns(const fs::path& file, const Line& header,
                                           const Columns& columns, const std::string& prefix) {
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < kTriangle; ++i) {
    const auto column = columns.by_name.find(prefix + std::to_string(i));
    if (column != columns.by_name.end()) found.push_back(column->second);
  }
  if (!found.empty() && found.size() != kTriangle) {
    throw InputError(file, header.number,
                     "of the columns " + prefix + "0.." + prefix + "20 only " +
                         std::to_string(found.size()) + " are there; all 21 or none are needed");
  }
  return found;
}

Columns ParseHeader(const fs::path& file, const Line& header, EstimateTable& table) {
  Columns columns;
  const std::vector<std::string_view> names = SplitAt(header.text, ',');
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (!columns.by_name.emplace(names[i], i).second) {
      throw InputError(file, header.number, "column " + std::string(names[i]) + " is there twice");
    }
    if (names[i].ends_with(kMillisecondsSuffix)) {
      columns.stages.push_back(i);
      table.stage_names.emplace_back(
          names[i].substr(0, names[i].size() - kMillisecondsSuffix.size()));
    }
  }
  for (std::size_t i = 0; i < kRequired.size(); ++i) {
    const auto column = columns.by_name.find(kRequired[i]);
    if (column == columns.by_name.end()) {
      throw InputError(file, header.number,
                       "column " + std::string(kRequired[i]) + " is missing in the header");
    }
    columns.required[i] = column->second;
  }
  columns.pose_covariance = CovarianceColumns(file, header, columns, "cov_pose_");
  columns.twist_covariance = CovarianceColumns(file, header, columns, "cov_twist_");
  return columns;
}

/// NaN for a field that is empty or says so.
double ParseOptional(const fs::path& file, const Line& line, std::size_t column,
                     std::string_view field) {
  if (field.empty()) return std::numeric_limits<double>::quiet_NaN();
  const std::optional<double> value = ParseNumber(field);
  if (!value) {
    throw InputError(file, line.number,
                     "column " + std::to_string(column + 1) + " is '" + std::string(field) +
                         "', a number is needed");
  }
  return *value;
}

std::optional<Mat6d> ParseCovariance(const fs::path& file, const Line& line,
                                     const std::vector<std::string_view>& fields,
                                     const std::vector<std::size_t>& columns) {
  if (columns.empty()) return std::nullopt;
  Mat6d covariance;
  std::size_t next = 0;
  for (int row = 0; row < 6; ++row) {
    for (int column = row; column < 6; ++column) {
      const std::size_t i = columns[next++];
      covariance(row, column) = covariance(column, row) = ParseOptional(file, line, i, fields[i]);
    }
  }
  if (!covariance.allFinite()) return std::nullopt;
  return covariance;
}

std::string TextField(const Columns& columns, const std::vector<std::string_view>& fields,
                      std::string_view name) {
  const auto column = columns.by_name.find(name);
  return column == columns.by_name.end() ? std::string() : std::string(fields[column->second]);
}

/// Whether nothing at all is said of the motion.
bool IsAllNan(const Columns& columns, const std::vector<std::string_view>& fields) {
  return std::all_of(columns.required.begin() + kFirstOfMotion, columns.required.end(),
                     [&](std::size_t column) {
                       const std::optional<double> value = ParseNumber(fields[column]);
                       return value && std::isnan(*value);
                     });
}

void ParseMotion(const fs::path& file, const Line& line, const Columns& columns,
                 const std::vector<std::string_view>& fields, EstimateRow& row) {
  std::array<double, kRequired.size()> n{};
  for (std::size_t i = kFirstOfMotion; i < kRequired.size(); ++i) {
    n[i] = ParseFinite(file, line, kRequired[i], fields[columns.required[i]]);
  }
  const EstimatedPose::Quaternion q(n[8], n[5], n[6], n[7]);
  if (std::abs(q.norm() - 1.0) > kQuaternionTolerance) {
    throw InputError(file, line.number,
                     "quaternion has length " + std::to_string(q.norm()) + ", 1 is needed");
  }
  row.T_co = EstimatedPose(q, Vec3d(n[2], n[3], n[4]));
  row.twist = {Vec3d(n[9], n[10], n[11]), Vec3d(n[12], n[13], n[14])};
}

EstimateRow ParseRow(const fs::path& file, const Line& line, const Columns& columns) {
  const std::vector<std::string_view> fields = SplitAt(line.text, ',');
  if (fields.size() != columns.by_name.size()) {
    throw InputError(file, line.number,
                     "holds " + std::to_string(fields.size()) + " fields, the header " +
                         std::to_string(columns.by_name.size()));
  }
  EstimateRow row;
  row.frame = ParseIndex(file, line, kRequired[0], fields[columns.required[0]]);
  row.timestamp_s = ParseFinite(file, line, kRequired[1], fields[columns.required[1]]);
  row.status = TextField(columns, fields, "status");
  row.state = TextField(columns, fields, "state");
  row.has_motion = row.status.empty() || row.status == "ok" || !IsAllNan(columns, fields);
  if (row.has_motion) ParseMotion(file, line, columns, fields, row);
  row.pose_covariance = ParseCovariance(file, line, fields, columns.pose_covariance);
  row.twist_covariance = ParseCovariance(file, line, fields, columns.twist_covariance);
  for (const std::size_t i : columns.stages) {
    row.stage_ms.push_back(ParseOptional(file, line, i, fields[i]));
  }
  return row;
}

}  // namespace

std::optional<std::size_t> EstimateTable::FindStage(std::string_view name) const {
  const auto found = std::find(stage_names.begin(), stage_names.end(), name);
  if (found == stage_names.end()) return std::nullopt;
  return static_cast<std::size_t>(found - stage_names.begin());
}

EstimateTable LoadEstimates(const fs::path& file, int frame_count) {
  const std::string text = ReadFile(file);
  LineReader lines(text);
  Line header;
  Line line;
  if (!lines.Next(header) || !lines.Next(line))
    throw InputError(file, "holds no frame; a header and rows are needed");
  EstimateTable table;
  const Columns columns = ParseHeader(file, header, table);
  do {
    EstimateRow row = ParseRow(file, line, columns);
    if (row.frame >= frame_count) {
      throw InputError(file, line.number,
                       "frame " + std::to_string(row.frame) + " is not in the sequence of " +
                           std::to_string(frame_count) + " frames");
    }
    if (!table.rows.empty() && row.frame <= table.rows.back().frame) {
      throw InputError(file, line.number,
                       "frame " + std::to_string(row.frame) + " follows frame " +
                           std::to_string(table.rows.back().frame) +
                           "; frame numbers must increase");
    }
    table.rows.push_back(std::move(row));
  } while (lines.Next(line));
  return table;
}

}  // namespace disflow::apps
