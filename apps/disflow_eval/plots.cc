// SPDX-License-Identifier: BSD-3-Clause
#include "plots.h"

#include <algorithm>
#include <limits>

#include "child_program.h"
#include "errors.h"
#include "text_file.h"
#include "units.h"

namespace disflow::apps {
namespace {

namespace fs = std::filesystem;

// Names without a path: gnuplot runs inside the folder, so that no text of the user's gets into a
// script.
constexpr const char* kScript = "plots.gp";
constexpr const char* kFrameData = "frames.dat";
constexpr const char* kAddData = "add.dat";
constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

/// One line per frame; a blank line where frames are missing, so that the curve has a gap there.
std::string FrameData(const Report& report) {
  const std::optional<std::size_t> total = report.estimates.FindStage("total");
  std::string text =
      "# time_s e_t_mm e_a_deg v_cmps v_true_cmps w_degps w_true_degps total_ms pose_nees "
      "twist_nees\n";
  const double start_s = report.poses.frames.front().timestamp_s;
  for (std::size_t i = 0; i < report.poses.frames.size(); ++i) {
    const FrameError& error = report.poses.frames[i];
    const AlignedFrame& frame = report.run.frames[i];
    if (i > 0 && error.frame != report.poses.frames[i - 1].frame + 1) text += "\n";
    text += Format(
        "%.6f %.6f %.6f %.4f %.4f %.4f %.4f %.5f %.5g %.5g\n", error.timestamp_s - start_s,
        kMillimetres * error.translation_m, kDegrees * error.rotation_rad,
        kCentimetres * frame.twist_estimated.linear_mps.norm(),
        kCentimetres * frame.twist.linear_mps.norm(),
        kDegrees * frame.twist_estimated.angular_rps.norm(),
        kDegrees * frame.twist.angular_rps.norm(), total ? frame.row->stage_ms[*total] : kUnknown,
        report.pose_consistency ? report.pose_consistency->by_frame[i] : kUnknown,
        report.twist_consistency ? report.twist_consistency->by_frame[i] : kUnknown);
  }
  return text;
}

/// Steps of acc(d): the share of all frames with an error of at most d.
std::string AddData(const Report& report) {
  std::vector<double> add;
  std::vector<double> add_s;
  for (const FrameError& error : report.poses.frames) {
    add.push_back(error.add_m);
    add_s.push_back(error.add_s_m);
  }
  std::string text = "# add_mm add_s_mm accuracy_percent\n0 0 0\n";
  std::sort(add.begin(), add.end());
  std::sort(add_s.begin(), add_s.end());
  const auto frames = static_cast<double>(report.run.frame_count);
  double accuracy = 0.0;
  for (std::size_t i = 0; i < add.size(); ++i) {
    accuracy = kPercent * static_cast<double>(i + 1) / frames;
    text += Format("%.6f %.6f %.4f\n", kMillimetres * add[i], kMillimetres * add_s[i], accuracy);
  }
  const double end_mm = kMillimetres * kAddLimit_m;
  return text + Format("%.6f %.6f %.4f\n", std::max(end_mm, kMillimetres * add.back()),
                       std::max(end_mm, kMillimetres * add_s.back()), accuracy);
}

/// Collects gnuplot commands, picture by picture.
class Script {
 public:
  /// @param rows, columns Panels of the picture.
  void Begin(const Plot& plot, int rows, int columns) {
    text_ += Format("set output '%s'\nset multiplot layout %d,%d title \"%s\"\n", plot.file.c_str(),
                    rows, columns, plot.title.c_str());
    plots_.push_back(plot);
  }
  void Panel(const std::string& commands) {
    text_ += "set autoscale\nset autoscale xfix\n" + commands + "\n";
  }
  void End() { text_ += "unset multiplot\nunset output\n"; }

  [[nodiscard]] const std::string& text() const { return text_; }
  [[nodiscard]] const std::vector<Plot>& plots() const { return plots_; }

 private:
  std::string text_ =
      "if (strstrt(GPVAL_TERMINALS, 'pngcairo') > 0) {\n"
      "  set terminal pngcairo size 1200,720 font ',13' linewidth 1.4\n"
      "} else {\n"
      "  set terminal png size 1200,720\n"
      "}\n"
      "set grid lc rgb '#b0b0b0' lw 0.7\n"
      "set border 3 lc rgb '#606060'\n"
      "set tics nomirror\n"
      "set key above right horizontal noautotitle\n"
      "set lmargin 10\n"
      "set style data lines\n"
      "truth = '#9a9a9a'; estimate = '#1f6fb4'; other = '#d1601f'\n";
  std::vector<Plot> plots_;
};

void AddErrorPlot(const Report& report, Script& script) {
  const PoseMetrics& m = report.poses;
  script.Begin({"errors.png", "Pose error over time"}, 2, 1);
  script.Panel(
      Format("set xlabel 'time [s]'; set ylabel 'e_t [mm]'; set yrange [0:*]\n"
             "plot 'frames.dat' using 1:2 lc rgb estimate title 'translation, RMSE %.2f mm'",
             kMillimetres * m.translation_m.rms));
  script.Panel(
      Format("set ylabel 'e_a [deg]'; set yrange [0:*]\n"
             "plot 'frames.dat' using 1:3 lc rgb estimate title 'rotation, RMSE %.2f deg'",
             kDegrees * m.rotation_rad.rms));
  script.End();
}

void AddSpeedPlot(const Report& report, Script& script) {
  const PoseMetrics& m = report.poses;
  script.Begin({"speed.png", "Speed against the truth"}, 2, 1);
  script.Panel(
      Format("set xlabel 'time [s]'; set ylabel 'linear [cm/s]'; set yrange [0:*]\n"
             "plot 'frames.dat' using 1:5 lw 3 lc rgb truth title 'truth', "
             "'' using 1:4 lc rgb estimate title 'estimate, RMSE %.2f cm/s'",
             kCentimetres * m.linear_mps.rms));
  script.Panel(
      Format("set ylabel 'angular [deg/s]'; set yrange [0:*]\n"
             "plot 'frames.dat' using 1:7 lw 3 lc rgb truth title 'truth', "
             "'' using 1:6 lc rgb estimate title 'estimate, RMSE %.2f deg/s'",
             kDegrees * m.angular_rps.rms));
  script.End();
}

void AddAccuracyPlot(const Report& report, Script& script) {
  const PoseMetrics& m = report.poses;
  script.Begin(
      {"add.png", Format("Share of frames below a threshold: ADD-AUC %.2f %%, ADD-S-AUC %.2f %%",
                         kPercent * m.add_auc, kPercent * m.add_s_auc)},
      1, 2);
  // The curve of a good run is all but vertical at 0.10 m, hence a second panel near zero.
  const double near_mm = std::max(1.0, 1.2 * kMillimetres * m.add_m.p99);
  for (const double end_mm : {kMillimetres * kAddLimit_m, near_mm}) {
    script.Panel(
        Format("set xlabel 'threshold [mm]'; set ylabel 'frames [%%]'\n"
               "set xrange [0:%.4f]; set yrange [0:102]\n"
               "plot 'add.dat' using 1:3 with steps lc rgb estimate title 'ADD', "
               "'' using 2:3 with steps lc rgb other dt 2 title 'ADD-S'",
               end_mm));
  }
  script.End();
}

void AddConsistencyPlot(const Report& report, Script& script) {
  const auto panel = [&script](const char* name, int column, const Consistency& consistency) {
    script.Panel(Format(
        "set xlabel 'time [s]'; set ylabel 'NEES of the %s'\nset logscale y\n"
        "plot %.4f lc rgb other dt 2 title '95 %% of a truthful covariance lie between', "
        "%.4f lc rgb other dt 2, 'frames.dat' using 1:%d lc rgb estimate title '%.1f %% do'\n"
        "unset logscale",
        name, kChiSquare6At2_5, kChiSquare6At97_5, column, kPercent * consistency.share_inside));
  };
  if (!report.pose_consistency) return;
  script.Begin({"nees.png", "Squared error over covariance"}, 2, 1);
  panel("pose", 9, *report.pose_consistency);
  if (report.twist_consistency) panel("twist", 10, *report.twist_consistency);
  script.End();
}

void AddTimePlot(const Report& report, Script& script) {
  const auto total = std::find_if(report.stages.begin(), report.stages.end(),
                                  [](const StageTiming& stage) { return stage.name == "total"; });
  if (total == report.stages.end()) return;
  script.Begin({"time.png", "Processing time per frame"}, 1, 1);
  script.Panel(
      Format("set xlabel 'time [s]'; set ylabel 'total [ms]'; set yrange [0:*]\n"

             "plot 'frames.dat' using 1:8 lc rgb estimate title 'frame', "
             "%.5f lc rgb 'black' title 'median %.2f ms', "
             "%.5f lc rgb other title '99th percentile %.2f ms'",
             total->ms.median, total->ms.median, total->ms.p99, total->ms.p99));
  script.End();
}

}  // namespace

std::vector<Plot> WritePlots(const Report& report, const fs::path& dir) {
  std::error_code error;
  fs::create_directories(dir, error);
  if (error) throw OutputError(dir, "cannot be created: " + error.message());

  Script script;
  AddErrorPlot(report, script);
  if (report.has_velocities) AddSpeedPlot(report, script);
  AddAccuracyPlot(report, script);
  AddConsistencyPlot(report, script);
  AddTimePlot(report, script);

  WriteFile(dir / kFrameData, FrameData(report));
  WriteFile(dir / kAddData, AddData(report));
  WriteFile(dir / kScript, script.text());
  // -d: without the user's start-up files.
  const int status = RunProgram({"gnuplot", "-d", kScript}, dir);
  if (status == kProgramNotFound) {
    throw OutputError(dir,
                      "no plots: gnuplot is not installed (Debian: gnuplot-nox); "
                      "plots.gp and its data are there to draw them later");
  }
  if (status != 0) throw OutputError(dir, "gnuplot failed, see its message above");
  return script.plots();
}

}  // namespace disflow::apps
