// SPDX-License-Identifier: BSD-3-Clause
#include "options.h"

#include <CLI/CLI.hpp>
#include <cstdio>
#include <map>

#include "disflow/hal/mavlink/telemetry.h"
#include "disflow/surface_extractor.h"
#include "exit_status.h"
#include "sensor_choice.h"
#include "settings.h"

namespace disflow::apps {
namespace {

constexpr const char* kDescription =
    "Tracks and reconstructs one unknown rigid object in a stream of depth images.";

constexpr const char* kLinksAndStatus =
    "\n"
    "Links, each carries MAVLink 2 (docs/wire-format.md):\n"
    "  udp://HOST:PORT[?bind=PORT]\n"
    "  serial:///dev/NAME[?baud=RATE]\n"
    "\n"
    "Every input frame gives one row of the CSV; its column status is 'ok' or says why the pose "
    "is\n"
    "only a prediction. CSV and mesh share one object frame. SIGINT and SIGTERM end the run as if\n"
    "the input had ended, a second one ends the program at once.\n"
    "\n"
    "Exit status: 0 done, 2 wrong usage or settings, 3 the sensor failed, a file of the sequence\n"
    "could not be read or no frame could be tracked, 4 an output or link failed.";

const std::map<std::string, ProfileName> kProfiles = {
    {"micro", ProfileName::kMicro}, {"edge", ProfileName::kEdge}, {"dense", ProfileName::kDense}};
const std::map<std::string, Rate> kRates = {{"max", Rate::kMax}, {"realtime", Rate::kRealtime}};

struct SettingSources {
  std::string file;
  std::vector<std::string> assignments;
};

void AddInput(CLI::App& app, Options& options, SettingSources& settings) {
  app.add_option("--sensor", options.sensor, "Where depth images come from, see below")
      ->type_name("URI");
  app.add_flag("--list-sensors", options.list_sensors,
               "Show all cameras with their formats, sizes and rates, and end");
  app.add_option("--rate", options.rate,
                 "max: as fast as possible; realtime: at the pace of the capture stamps [max; a "
                 "live sensor is always realtime]")
      ->transform(CLI::CheckedTransformer(kRates).description(""))
      ->type_name("max|realtime");
  app.add_option("--frames", options.frames, "Stop after this many frames [all]")
      ->check(CLI::Validator(CLI::PositiveNumber).description(""))
      ->type_name("N");
  app.add_option("--profile", options.profile, "Memory and image size, see docs/memory.md [edge]")
      ->transform(CLI::CheckedTransformer(kProfiles).description(""))
      ->type_name("micro|edge|dense");
  app.add_option("--config", settings.file, "Settings, TOML; --print-config writes one")
      ->type_name("FILE");
  app.add_option("--set", settings.assignments,
                 "One setting, e.g. registration.iterations=10; wins over --config")
      ->type_name("NAME=VALUE")
      ->allow_extra_args(false);
}

void AddOutput(CLI::App& app, Options& options) {
  app.add_option("--link", options.links, "Send pose, twist and status there; may be repeated")
      ->type_name("URI")
      ->allow_extra_args(false);
  app.add_option("--id", options.object_index,
                 "Object index on the links, added to the component id [0]")
      ->check(CLI::Range(0, int{hal::mavlink::kMaxObjectIndex}).description(""))
      ->type_name("N");
  app.add_option("--csv", options.csv, "Write the trajectory")->type_name("FILE");
  app.add_option("--mesh", options.mesh,
                 "Write the surface at the end: binary PLY, coloured by uncertainty (dark = "
                 "certain), std_m in metres; OBJ if the name ends in .obj")
      ->type_name("FILE");
  app.add_option("--mesh-resolution", options.mesh_resolution_m,
                 "Edge of the mesh's sampling cubes in metres; at most 16 fit into a cell "
                 "(field.cell_size_m) [a tenth of it]")
      ->check(CLI::Validator(CLI::PositiveNumber).description(""))
      ->type_name("METRES");
  app.add_option("--mesh-picture", options.mesh_picture,
                 "Draw the surface at the end: PNG, from the first camera, right, behind and above")
      ->type_name("FILE");
  app.add_option("--flow", options.flow,
                 "Write the distance flow: a PLY per frame with the observed points, their "
                 "distance to the model, its gradient and their velocity")
      ->type_name("DIR");
  app.add_option("--record", options.record, "Write the frames as a sequence for replay:DIR")
      ->type_name("DIR");
  app.add_flag("--headless", options.headless, "No live status line");
  app.add_flag_callback(
      "--no-timing", [&options] { options.timing = false; },
      "Write 0 for all times, so that two runs give the same bytes");
  app.add_flag("--print-config", options.print_config, "Print all settings as TOML and end");
  app.add_flag("--print-settings-table", options.print_settings_table,
               "Print docs/settings.md and end");
}

void ReadSettings(const SettingSources& settings, Config& config) {
  if (!settings.file.empty()) LoadSettings(settings.file, config);
  for (const std::string& assignment : settings.assignments) ApplySetting(assignment, config);
  CheckSettings(config);
}

void CheckResolution(const Options& options) {
  const double cell_m = static_cast<double>(options.config.field.cell_size_m);
  const double finest_m = cell_m / kMaxStepsPerCell;
  if (options.mesh_resolution_m == 0.0 || options.mesh_resolution_m >= 0.9999 * finest_m) return;
  throw Failure(kWrongUsage, "--mesh-resolution is too fine: with field.cell_size_m = " +
                                 std::to_string(cell_m) + " it is at least " +
                                 std::to_string(finest_m));
}

}  // namespace

Options ParseCommandLine(int argc, char** argv, bool& exit_now) {
  Options options;
  SettingSources settings;
  CLI::App app(kDescription, "disflow_track");
  app.footer("Sensors:\n" + SensorHelp() + kLinksAndStatus);
  app.set_version_flag("--version", "disflow_track " DISFLOW_VERSION " (" DISFLOW_BUILD ")");
  AddInput(app, options, settings);
  AddOutput(app, options);
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& answer) {
    (void)app.exit(answer);
    exit_now = true;
    return options;
  } catch (const CLI::ParseError& error) {
    throw Failure(kWrongUsage, std::string(error.what()) + "; see disflow_track --help");
  }
  ReadSettings(settings, options.config);
  CheckResolution(options);
  if (options.sensor.empty() && !options.list_sensors && !options.print_config &&
      !options.print_settings_table) {
    throw Failure(kWrongUsage, "--sensor is required; see disflow_track --help");
  }
  return options;
}

}  // namespace disflow::apps
