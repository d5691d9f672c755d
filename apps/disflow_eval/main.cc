// SPDX-License-Identifier: BSD-3-Clause
#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "comparison.h"
#include "empty_values.h"
#include "errors.h"
#include "evaluation.h"
#include "fast_ycb.h"
#include "frame_table.h"
#include "input_paths.h"
#include "plots.h"
#include "report.h"
#include "summary.h"
#include "text_file.h"
#include "trajectory_export.h"
#include "units.h"

namespace {

using disflow::apps::EvaluationInput;
using disflow::apps::InputError;
using disflow::apps::OutputError;
using disflow::apps::Report;
using disflow::apps::WriteFile;
namespace fs = std::filesystem;

enum ExitStatus : int { kDone = 0, kWrongUsage = 2, kInputFailed = 3, kOutputFailed = 4 };

struct Options {
  EvaluationInput input;
  fs::path json;
  fs::path frames;
  fs::path plots;
  fs::path summary;
  fs::path tum;
  fs::path tum_truth;
  fs::path bop;
  fs::path latex;
  std::vector<fs::path> compared;
  disflow::apps::FastYcbOptions fast_ycb;
};

constexpr const char* kDescription =
    "Compares a trajectory of disflow_track with the truth and prints the metrics.";

constexpr const char* kFooter =
    "A folder holds gt/poses.txt, gt/velocities.txt, data.txt and gt/model.obj (Fast-YCB layout),\n"
    "or is a BOP scene: scene_camera.json and scene_gt.json, --object its obj_id, the model of\n"
    "models_eval/ or models/ beside the scenes' folders.\n"
    "The estimate is aligned with the truth once, at its first frame. Frames without a row count\n"
    "as failed in the AUC figures; the other figures are over the frames that have one.\n"
    "ADD-S is the mean distance of the model's points from the nearest point of the surface of "
    "the\n"
    "estimated model, where the model is a mesh; of its points, where it is a cloud.\n"
    "\n"
    "Exit status: 0 done, 2 wrong usage, 3 an input failed, 4 an output failed.";

void Print(const std::string& table) {
  (void)std::fwrite(table.data(), 1, table.size(), stdout);
  if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0) {
    throw OutputError("standard output", "cannot be written");
  }
}

/// @return What would destroy an input or another output, see apps::FindClash(); empty if nothing.
std::string FindClash(const Options& options) {
  using Paths = std::vector<disflow::apps::NamedPath>;
  const auto add = [](const char* option, const fs::path& path, Paths& paths) {
    if (!path.empty()) paths.push_back(disflow::apps::MakeNamedPath(option, path.string()));
  };
  Paths outputs;
  add("--latex", options.latex, outputs);
  add("--tum", options.tum, outputs);
  add("--tum-truth", options.tum_truth, outputs);
  add("--bop", options.bop, outputs);
  add("--json", options.json, outputs);
  add("--frames", options.frames, outputs);
  add("--plots", options.plots, outputs);
  add("--summary", options.summary, outputs);
  Paths inputs = disflow::apps::InputPaths("SEQUENCE", options.input.sequence);
  add("--csv", options.input.csv, inputs);
  add("--model", options.input.model, inputs);
  add("--mesh", options.input.mesh, inputs);
  for (const fs::path& csv : options.compared) add("--compare", csv, inputs);
  return disflow::apps::FindClash(outputs, inputs);
}

/// Beside the others, each judged like the first.
std::vector<Report> EvaluateOthers(const Options& options) {
  std::vector<Report> others;
  for (const fs::path& csv : options.compared) {
    EvaluationInput input = options.input;
    input.csv = csv;
    input.mesh.clear();
    others.push_back(disflow::apps::Evaluate(input));
  }
  return others;
}

/// Writes what was asked for; one output that fails does not keep the others from being written.
int WriteAll(const Report& report, const std::vector<Report>& others, const Options& options) {
  int status = kDone;
  const auto attempt = [&](auto write) {
    try {
      write();
    } catch (const OutputError& error) {
      std::fprintf(stderr, "disflow_eval: %s\n", error.what());
      status = kOutputFailed;
    } catch (const InputError& error) {
      std::fprintf(stderr, "disflow_eval: %s\n", error.what());
      status = kInputFailed;
    }
  };
  if (!report.note.empty()) {
    std::fprintf(stderr, "disflow_eval: %s: %s\n", report.sequence.c_str(), report.note.c_str());
  }
  std::vector<disflow::apps::Plot> plots;
  attempt([&] { Print(disflow::apps::FormatTable(report)); });
  std::vector<const Report*> all{&report};
  for (const Report& other : others) all.push_back(&other);
  if (!others.empty()) attempt([&] { Print("\n" + disflow::apps::FormatComparison(all)); });
  if (!options.latex.empty()) {
    attempt([&] { WriteFile(options.latex, disflow::apps::FormatLatex(all)); });
  }
  if (!options.tum.empty()) {
    attempt([&] { WriteFile(options.tum, disflow::apps::FormatTum(report)); });
  }
  if (!options.tum_truth.empty()) {
    attempt([&] { WriteFile(options.tum_truth, disflow::apps::FormatTumTruth(report)); });
  }
  if (!options.bop.empty()) {
    attempt(
        [&] { WriteFile(options.bop, disflow::apps::FormatBop(report, options.input.object)); });
  }
  if (!options.json.empty()) {
    attempt([&] { WriteFile(options.json, disflow::apps::FormatJson(report)); });
  }
  if (!options.frames.empty()) {
    attempt([&] { WriteFile(options.frames, disflow::apps::FormatFrames(report)); });
  }
  if (!options.plots.empty()) {
    attempt([&] { plots = disflow::apps::WritePlots(report, options.plots); });
  }
  if (!options.summary.empty()) {
    attempt([&] {
      WriteFile(options.summary, disflow::apps::FormatSummary(
                                     report, plots, options.summary.parent_path(), options.plots));
    });
  }
  return status;
}

/// Judges the whole of Fast-YCB.
int RunFastYcb(disflow::apps::FastYcbOptions options) {
  options.track = fs::read_symlink("/proc/self/exe").parent_path() / "disflow_track";
  const auto results = EvaluateFastYcb(options, [](const std::string& line) {
    std::fprintf(stderr, "disflow_eval: %s\n", line.c_str());
  });
  const std::string tables = FormatFastYcb(results);
  WriteFile(options.out / "tables.md", tables);
  Print(tables);
  return kDone;
}

/// Two standard deviations of the truth, of a place or velocity and of an angle or its rate in
/// degrees.
void AddTruthDeviation(CLI::App& app, const char* name, const char* what, const char* units,
                       double& point, double& angle_rad) {
  const auto take = [&point, &angle_rad](const std::pair<double, double>& given) {
    point = given.first;
    angle_rad = given.second / disflow::apps::kDegrees;
  };
  // Written so that NaN fails.
  const CLI::Validator not_negative(
      [](const std::string& text) {
        double value = -1.0;
        const bool good = CLI::detail::lexical_cast(text, value) && value >= 0.0 && value < 1e3;
        return good ? "" : text + " is not between 0 and 1000";
      },
      "");
  app.add_option_function<std::pair<double, double>>(name, take, what)
      ->check(not_negative)
      ->type_name(units);
}

void AddSequence(CLI::App& app, Options& options) {
  app.add_option("SEQUENCE", options.input.sequence,
                 "Sequence with ground truth: a folder, or the sim: address that was tracked");
  app.add_option("--csv", options.input.csv,
                 "Trajectory to judge: as disflow_track --csv writes it, or in the format of the "
                 "TUM RGB-D or the BOP benchmark, of the object in the camera's frame")
      ->type_name("FILE");
  app.add_option("--object", options.input.object, "Which object, if the sequence has several")
      ->type_name("NAME");
  app.add_option("--model", options.input.model,
                 "Model of the object, .obj or .xyz, metres [the sequence's own]")
      ->type_name("FILE");
  app.add_option(
         "--mesh", options.input.mesh,
         "Surface to judge, PLY in the tracker's object frame, as disflow_track --mesh writes it")
      ->type_name("FILE");
  app.add_option("--compare", options.compared,
                 "Other trajectories of the sequence, to be shown beside the first")
      ->type_name("FILE...");
  app.add_option("--latex", options.latex, "Write the paper's table with all of them, for LaTeX")
      ->type_name("FILE");
  app.add_option("--tum", options.tum, "Write the poses as the TUM benchmark has them, for evo")
      ->type_name("FILE");
  app.add_option("--tum-truth", options.tum_truth, "Write the true poses so")->type_name("FILE");
  app.add_option("--bop", options.bop, "Write the poses as results of the BOP benchmark")
      ->type_name("FILE");
  app.add_option("--json", options.json, "Write all metrics as JSON")->type_name("FILE");
  app.add_option("--frames", options.frames, "Write the errors of every frame as CSV")
      ->type_name("FILE");
  app.add_option("--plots", options.plots, "Draw plots as PNG into this folder (needs gnuplot)")
      ->type_name("DIR");
  app.add_option("--summary", options.summary, "Write a one-page summary in Markdown")
      ->type_name("FILE");
  disflow::apps::TruthDeviation& truth = options.input.truth_std;
  AddTruthDeviation(app, "--truth-pose-std",
                    "How far off the true poses are themselves, standard deviation in each "
                    "direction: counted in the consistency of the pose [0 0]",
                    "M DEG", truth.position_m, truth.rotation_rad);
  AddTruthDeviation(app, "--truth-twist-std",
                    "The same of the true velocities: counted in that of the twist [0 0]",
                    "M/S DEG/S", truth.linear_mps, truth.angular_rps);
}

void AddFastYcb(CLI::App& app, disflow::apps::FastYcbOptions& options) {
  auto* const data = app.add_option("--fast-ycb", options.data,
                                    "In place of all above: track and judge the Fast-YCB data set "
                                    "in this folder; the paper's tables with our figures beside "
                                    "the published ones");
  data->type_name("DIR");
  app.add_option("--models", options.models,
                 "Folder of its objects' models, e.g. 003_cracker_box.obj, in the pose convention "
                 "of gt/poses.txt, metres [DIR/OBJECT/gt/model.obj]")
      ->type_name("DIR")
      ->needs(data);
  app.add_option("--out", options.out,
                 "Folder for trajectories, meshes and tables [fast-ycb-results]")
      ->type_name("DIR")
      ->needs(data);
  app.add_option("--config", options.config, "Settings for disflow_track, TOML")
      ->type_name("FILE")
      ->needs(data);
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  CLI::App app(kDescription, "disflow_eval");
  app.footer(kFooter);
  app.set_version_flag("--version", "disflow_eval " DISFLOW_VERSION " (" DISFLOW_BUILD ")");
  AddSequence(app, options);
  AddFastYcb(app, options.fast_ycb);
  try {
    app.parse(argc, argv);
    disflow::apps::RefuseEmptyValues(app);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? kDone : kWrongUsage;
  }
  const bool whole_set = !options.fast_ycb.data.empty();
  if (whole_set == !options.input.sequence.empty() || (!whole_set && options.input.csv.empty())) {
    std::fprintf(
        stderr,
        "disflow_eval: either SEQUENCE and --csv, or --fast-ycb; see disflow_eval --help\n");
    return kWrongUsage;
  }
  if (const std::string clash = FindClash(options); !clash.empty()) {
    std::fprintf(stderr, "disflow_eval: %s\n", clash.c_str());
    return kWrongUsage;
  }
  try {
    if (whole_set) return RunFastYcb(options.fast_ycb);
    const Report report = disflow::apps::Evaluate(options.input);
    return WriteAll(report, EvaluateOthers(options), options);
  } catch (const OutputError& error) {
    std::fprintf(stderr, "disflow_eval: %s\n", error.what());
    return kOutputFailed;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "disflow_eval: %s\n", error.what());
    return kInputFailed;
  }
}
