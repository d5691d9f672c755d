// SPDX-License-Identifier: BSD-3-Clause
#include "fast_ycb.h"

#include <algorithm>
#include <limits>

#include "child_program.h"
#include "errors.h"
#include "evaluation.h"
#include "text_file.h"
#include "units.h"

namespace disflow::apps {
namespace {

namespace fs = std::filesystem;

/// The sequence's own model, or the one of the same name in the folder of models; empty = none.
fs::path FindModel(const FastYcbOptions& options, const std::string& object) {
  const std::array candidates = {
      options.data / object / "gt" / "model.obj", options.models / (object + ".obj"),
      options.models / (object + ".xyz"), options.models / object / "textured.obj",
      options.models / object / "points.xyz"};
  for (const fs::path& file : candidates) {
    if (fs::is_regular_file(file)) return file;
  }
  return {};
}

double MedianMs(const Report& report) {
  for (const StageTiming& stage : report.stages) {
    if (stage.name == "total") return stage.ms.median;
  }
  return std::numeric_limits<double>::quiet_NaN();
}

FastYcbResult Summarise(const Report& report, const std::string& object, const std::string& mask) {
  const PoseMetrics& m = report.poses;
  const double unknown = std::numeric_limits<double>::quiet_NaN();
  FastYcbResult result;
  result.object = object;
  result.mask = mask;
  result.add_auc_percent = kPercent * m.add_auc;
  result.translation_cm = kCentimetres * m.translation_m.rms;
  result.rotation_deg = kDegrees * m.rotation_rad.rms;
  result.linear_cmps = report.has_velocities ? kCentimetres * m.linear_mps.rms : unknown;
  result.angular_degps = report.has_velocities ? kDegrees * m.angular_rps.rms : unknown;
  result.median_ms = MedianMs(report);
  result.surface = report.surface;
  return result;
}

/// @throws InputError if it cannot be tracked or judged.
FastYcbResult Run(const FastYcbOptions& options, const std::string& object, const std::string& mask,
                  const fs::path& model) {
  const fs::path sequence = fs::absolute(options.data / object);
  const fs::path stem = fs::absolute(options.out) / (object + "-" + mask);
  const fs::path csv = stem.string() + ".csv";
  const fs::path mesh = stem.string() + ".ply";
  std::vector<std::string> words = {fs::absolute(options.track),
                                    "--sensor",
                                    "replay:" + sequence.string() + "?mask=" + mask,
                                    "--csv",
                                    csv,
                                    "--mesh",
                                    mesh,
                                    "--headless"};
  if (!options.config.empty()) {
    words.insert(words.end(), {"--config", fs::absolute(options.config)});
  }
  const int status = RunProgram(std::move(words), options.out);
  if (status == kProgramNotFound) throw InputError(options.track, "cannot be run");
  if (status != 0) throw InputError(sequence, Format("disflow_track ended with %d", status));
  const Report report =
      Evaluate({.sequence = sequence.string(), .csv = csv, .model = model, .mesh = mesh});
  WriteFile(stem.string() + ".json", FormatJson(report));
  return Summarise(report, object, mask);
}

using Say = std::function<void(const std::string&)>;

/// Both mask sets of one object, as far as they are there.
void RunObject(const FastYcbOptions& options, const std::string& object, const Say& say,
               std::vector<FastYcbResult>& results) {
  const fs::path folder = options.data / object;
  if (const fs::path poses = folder / "gt" / "poses.txt"; !fs::exists(poses)) {
    say(Format("%s: skipped, %s is not there", object.c_str(), poses.c_str()));
    return;
  }
  const fs::path model = FindModel(options, object);
  if (model.empty()) {
    say(Format("%s: skipped, no model: give a folder with %s.obj by --models", object.c_str(),
               object.c_str()));
    return;
  }
  for (const char* mask : kFastYcbMasks) {
    std::string fault = "not there";
    if (fs::is_directory(folder / "masks" / mask)) {
      try {
        results.push_back(Run(options, object, mask, model));
        continue;
      } catch (const InputError& error) {
        fault = error.what();
      }
    }
    say(Format("%s, masks %s: skipped, %s", object.c_str(), mask, fault.c_str()));
  }
}

}  // namespace

std::vector<FastYcbResult> EvaluateFastYcb(const FastYcbOptions& options, const Say& say) {
  if (!fs::is_directory(options.data)) throw InputError(options.data, "is no folder");
  std::error_code error;
  fs::create_directories(options.out, error);
  if (error) throw OutputError(options.out, "cannot be created: " + error.message());
  std::vector<FastYcbResult> results;
  for (const char* object : kFastYcbObjects) RunObject(options, object, say, results);
  if (results.empty()) throw InputError(options.data, "holds no sequence that could be judged");
  return results;
}

}  // namespace disflow::apps
