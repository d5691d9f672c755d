// SPDX-License-Identifier: BSD-3-Clause
#include "comparison.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <limits>

#include "units.h"

namespace disflow::apps {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

/// A number that runs are compared by.
struct Measure {
  const char* name;   ///< For a terminal.
  const char* latex;  ///< Head of the column; null: not in the paper's form.
  int digits;
  bool more_is_better;
  double (*of)(const Report& report);  ///< In the unit of the name; NaN: not measured.
};

double TotalMs(const Report& report) {
  for (const StageTiming& stage : report.stages) {
    if (stage.name == "total") return stage.ms.median;
  }
  return kNone;
}

constexpr std::array kMeasures{
    Measure{"ADD-AUC (%)", "ADD-AUC (\\%)", 2, true,
            [](const Report& r) { return kPercent * r.poses.add_auc; }},
    Measure{"ADD-S-AUC (%)", nullptr, 2, true,
            [](const Report& r) { return kPercent * r.poses.add_s_auc; }},
    Measure{"RMSE e_t (cm)", "RMSE $e_t$ (cm)", 3, false,
            [](const Report& r) { return kCentimetres * r.poses.translation_m.rms; }},
    Measure{"RMSE e_a (deg)", "RMSE $e_a$ (deg)", 3, false,
            [](const Report& r) { return kDegrees * r.poses.rotation_rad.rms; }},
    Measure{"RMSE e_v (cm/s)", "RMSE $e_v$ (cm/s)", 3, false,
            [](const Report& r) {
              return r.has_velocities ? kCentimetres * r.poses.linear_mps.rms : kNone;
            }},
    Measure{"RMSE e_w (deg/s)", "RMSE $e_\\omega$ (deg/s)", 3, false,
            [](const Report& r) {
              return r.has_velocities ? kDegrees * r.poses.angular_rps.rms : kNone;
            }},
    Measure{"frames missing or lost", nullptr, 0, false,
            [](const Report& r) { return static_cast<double>(r.run.missing() + r.run.lost); }},
    Measure{"time, median (ms)", "Time (ms)", 3, false, TotalMs},
};

/// Files of the same name are told apart by their folders.
std::vector<std::string> NamesOf(const std::vector<const Report*>& reports) {
  std::vector<std::string> names;
  names.reserve(reports.size());
  for (const Report* report : reports)
    names.push_back(std::filesystem::path(report->csv).stem().string());
  for (std::size_t i = 0; i < names.size(); ++i) {
    const bool is_alone = std::count(names.begin(), names.end(), names[i]) == 1;
    if (!is_alone) names[i] = std::filesystem::path(reports[i]->csv).string();
  }
  return names;
}

/// One measure of all runs.
struct Compared {
  std::vector<double> values;
  double best = kNone;  ///< NaN if there is nothing to compare.

  [[nodiscard]] bool IsBest(std::size_t i) const { return values[i] == best; }
};

Compared Compare(const Measure& measure, const std::vector<const Report*>& reports) {
  Compared compared;
  std::size_t measured = 0;
  for (const Report* report : reports) {
    const double value = measure.of(*report);
    compared.values.push_back(value);
    if (!std::isfinite(value)) continue;
    ++measured;
    const bool better = !std::isfinite(compared.best) ||
                        (measure.more_is_better ? value > compared.best : value < compared.best);
    if (better) compared.best = value;
  }
  if (measured < 2) compared.best = kNone;
  return compared;
}

std::string Shown(const Measure& measure, double value) {
  return std::isfinite(value) ? Format("%.*f", measure.digits, value) : "-";
}

/// Text in which LaTeX sees no markup.
std::string Escape(const std::string& text) {
  std::string escaped;
  for (const char c : text) {
    if (std::string_view("&%$#_{}").find(c) != std::string_view::npos) {
      escaped += '\\';
      escaped += c;
    } else if (c == '\\') {
      escaped += "\\textbackslash{}";
    } else if (c == '~' || c == '^') {
      escaped += std::string("\\") + c + "{}";
    } else {
      escaped += c;
    }
  }
  return escaped;
}

}  // namespace

std::string FormatComparison(const std::vector<const Report*>& reports) {
  const std::vector<std::string> names = NamesOf(reports);
  std::size_t width = 12;
  for (const std::string& name : names) width = std::max(width, name.size() + 2);
  const int cell = static_cast<int>(width);
  std::string table = Format("%-24s", "");
  for (const std::string& name : names) table += Format("%*s ", cell, name.c_str());
  table += "\n";
  for (const Measure& measure : kMeasures) {
    const Compared compared = Compare(measure, reports);
    table += Format("%-24s", measure.name);
    for (std::size_t i = 0; i < reports.size(); ++i) {
      table += Format("%*s%s", cell, Shown(measure, compared.values[i]).c_str(),
                      compared.IsBest(i) ? "*" : " ");
    }
    table += "\n";
  }
  return table + "* best\n";
}

std::string FormatLatex(const std::vector<const Report*>& reports) {
  std::vector<const Measure*> columns;
  std::vector<Compared> compared;
  for (const Measure& measure : kMeasures) {
    Compared values = Compare(measure, reports);
    const bool any = std::any_of(values.values.begin(), values.values.end(),
                                 [](double value) { return std::isfinite(value); });
    if (measure.latex == nullptr || !any) continue;
    columns.push_back(&measure);
    compared.push_back(std::move(values));
  }
  std::string table =
      "\\begin{tabular}{l" + std::string(columns.size(), 'c') + "}\n\\toprule\nMethod";
  for (const Measure* column : columns) table += std::string(" & ") + column->latex;
  table += " \\\\\n\\midrule\n";
  const std::vector<std::string> names = NamesOf(reports);
  for (std::size_t i = 0; i < reports.size(); ++i) {
    table += Escape(names[i]);
    for (std::size_t k = 0; k < columns.size(); ++k) {
      const std::string value = Shown(*columns[k], compared[k].values[i]);
      table += " & " + (compared[k].IsBest(i) ? "\\textbf{" + value + "}" : value);
    }
    table += " \\\\\n";
  }
  return table + "\\bottomrule\n\\end{tabular}\n";
}

}  // namespace disflow::apps
