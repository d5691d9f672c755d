// SPDX-License-Identifier: BSD-3-Clause
#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <string>

#include "errors.h"
#include "evaluation.h"
#include "report.h"
#include "text_file.h"

namespace {

using disflow::apps::EvaluationInput;
using disflow::apps::Report;
namespace fs = std::filesystem;

enum ExitStatus : int { kDone = 0, kWrongUsage = 2, kInputFailed = 3, kOutputFailed = 4 };

struct Options {
  EvaluationInput input;
  fs::path json;
};

constexpr const char* kDescription =
    "Compares a trajectory of disflow_track with the truth and prints the metrics.";

constexpr const char* kFooter =
    "SEQ_DIR holds gt/poses.txt, gt/velocities.txt, data.txt and gt/model.obj (Fast-YCB layout).\n"
    "The estimate is aligned with the truth once, at its first frame. Frames without a row count\n"
    "as failed in the AUC figures; the other figures are over the frames that have one.\n"
    "\n"
    "Exit status: 0 done, 2 wrong usage, 3 an input failed, 4 an output failed.";

int Run(const Options& options) {
  const Report report = disflow::apps::Evaluate(options.input);
  const std::string table = disflow::apps::FormatTable(report);
  (void)std::fwrite(table.data(), 1, table.size(), stdout);
  if (!options.json.empty()) {
    disflow::apps::WriteFile(options.json, disflow::apps::FormatJson(report));
  }
  if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0) {
    throw disflow::apps::OutputError("standard output", "cannot be written");
  }
  return kDone;
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  CLI::App app(kDescription, "disflow_eval");
  app.footer(kFooter);
  app.set_version_flag("--version", "disflow_eval " DISFLOW_VERSION " (" DISFLOW_BUILD ")");
  app.add_option("SEQ_DIR", options.input.sequence_dir, "Sequence with ground truth")->required();
  app.add_option("--csv", options.input.csv, "Trajectory to judge, as disflow_track --csv writes it")
      ->required()
      ->type_name("FILE");
  app.add_option("--model", options.input.model,
                 "Model of the object, .obj or .xyz, metres [SEQ_DIR/gt/model.obj]")
      ->type_name("FILE");
  app.add_option("--json", options.json, "Write all metrics as JSON")->type_name("FILE");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? kDone : kWrongUsage;
  }
  try {
    return Run(options);
  } catch (const disflow::apps::OutputError& error) {
    std::fprintf(stderr, "disflow_eval: %s\n", error.what());
    return kOutputFailed;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "disflow_eval: %s\n", error.what());
    return kInputFailed;
  }
}
