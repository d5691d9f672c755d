// SPDX-License-Identifier: BSD-3-Clause
#include "settings/options.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <utility>

#include "disflow/hal/mavlink/telemetry.h"
#include "disflow/host/open_sensor.h"
#include "disflow/posix/camera/camera_address.h"
#include "disflow/posix/mask_source.h"
#include "disflow/surface_extractor.h"
#include "empty_values.h"
#include "program/exit_status.h"
#include "program/log_target.h"
#include "settings/choice.h"
#include "settings/dds_address.h"
#include "settings/ros_arguments.h"
#include "settings/rosbag_help.h"
#include "settings/rotation_options.h"
#include "settings/setting_sources.h"

namespace disflow::apps {
namespace {

constexpr const char* kDescription =
    "Tracks and reconstructs unknown rigid objects in a stream of depth images.";

constexpr const char* kLinksAndStatus =
    "\n"
    "Links, each carries MAVLink 2 (docs/wire-format.md):\n"
    "  udp://HOST:PORT[?bind=PORT]\n"
    "  tcp://HOST:PORT[?listen=yes]\n"
    "  serial:///dev/NAME[?baud=RATE]\n"
    "    each also with key=FILE: sign what is sent and take only what is signed, with the key in\n"
    "    that file; choose=yes: who is at the other end may say what is tracked\n"
    "    (MAV_CMD_CAMERA_TRACK_POINT, …_RECTANGLE); stamps=monotonic|epoch|autopilot: the clock "
    "of\n"
    "    the stamps, if not the images'; send=landing_target|follow_target: instead of ODOMETRY,\n"
    "    for autopilots\n"
    "or ROS 2 (docs/ros2.md):\n"
    "  dds:domain=N[&name=NODE][&interface=NAME][&peer=HOST,…][&camera=FRAME][&world=FRAME]\n"
    "      [&mask=TOPIC][&reset=yes][&choose=yes][&parameters=yes][&lifecycle=yes]\n"
    "      [&namespace=/NAMESPACE][&ros=humble|iron]\n"
    "\n"
    "Every input frame gives one row of the CSV; its column status is 'ok' or says why the pose "
    "is\n"
    "only a prediction. CSV and mesh share one object frame. {n} in the names of --csv, --mesh,\n"
    "--mesh-picture, --flow and --record stands for a number, one more than the highest that is\n"
    "there: run-{n}.csv. SIGINT and SIGTERM end the run as if the input had ended, a second one\n"
    "ends the program at once. SIGHUP reads the settings file again (docs/deploy.md); without one "
    "it ends\n"
    "the run.\n"
    "\n"
    "Exit status: 0 done, 2 wrong usage or settings, 3 the sensor failed, a file of the sequence\n"
    "could not be read, no frame could be tracked or memory ran out, 4 an output or link failed.";

const std::map<std::string, ProfileName> kProfiles = {
    {"micro", ProfileName::kMicro}, {"edge", ProfileName::kEdge}, {"dense", ProfileName::kDense}};
const std::map<std::string, Rate> kRates = {
    {"max", Rate::kMax}, {"realtime", Rate::kRealtime}, {"live", Rate::kLive}};
const std::map<std::string, hal::mavlink::MavFrame> kWorlds = {
    {"ned", hal::mavlink::MavFrame::kLocalNed},
    {"enu", hal::mavlink::MavFrame::kLocalEnu},
    {"frd", hal::mavlink::MavFrame::kLocalFrd},
    {"flu", hal::mavlink::MavFrame::kLocalFlu}};

/// The parser turns numbers that are too large into the largest one.
constexpr std::int64_t kMostFrames = 1'000'000'000'000;

void AddInput(CLI::App& app, Options& options, SettingSources& settings) {
  app.add_option("--sensor", options.sensor, "Where depth images come from, see below")
      ->type_name("URI");
  app.add_flag("--list-sensors", options.list_sensors,
               "Show all cameras with their formats, sizes and rates, and end");
  app.add_option("--rate", options.rate,
                 "max: as fast as possible; realtime: at the pace of the capture stamps; live: so, "
                 "and what comes while the tracker is busy is lost [max; a camera is always live]")
      ->transform(Choice(kRates))
      ->type_name("max|realtime|live");
  app.add_option("--frames", options.frames, "Stop after this many frames [all]")
      ->check(CLI::Range(std::int64_t{1}, kMostFrames).description(""))
      ->type_name("N");
  app.add_option("--profile", options.profile, "Memory and image size, see docs/memory.md [edge]")
      ->transform(Choice(kProfiles))
      ->type_name("micro|edge|dense");
  app.add_option(
         "--config", settings.file,
         "Settings, TOML; --print-config writes one. Its section [run] may hold any of these "
         "options; the command line wins")
      ->type_name("FILE");
  app.add_option("--params-file", settings.parameter_files,
                 "The same as parameters of ROS 2, YAML, in place of --config (docs/ros2.md); of "
                 "several the last word counts")
      ->type_name("FILE")
      ->allow_extra_args(false);
  // Only for --help: TakeRosArguments() has taken it.
  app.add_flag_callback(
      "--ros-args", [] {},
      "What ROS 2 hands over, until --: -r depth|info|mask:=TOPIC, -r __node:=NAME, "
      "-r __ns:=/NAMESPACE, -p PARAMETER:=VALUE, and any option of these here");
  app.add_option("--set", settings.assignments,
                 "One setting, e.g. registration.iterations=10; wins over --config")
      ->type_name("NAME=VALUE")
      ->allow_extra_args(false);
}

void AddObject(CLI::App& app, Options& options, SettingSources& settings) {
  app.add_option("--roi", settings.roi_px,
                 "Where no mask is given, only this part of the image is looked at; short for "
                 "segmenter.roi_*")
      ->delimiter(',')
      ->expected(4)
      ->type_name("X,Y,W,H");
  app.add_option("--range", settings.range_m,
                 "Only these distances are looked at; short for segmenter.*_range_m")
      ->delimiter(',')
      ->expected(2)
      ->type_name("NEAR,FAR");
  app.add_option("--seed", settings.seed_px,
                 "Where no mask is given, a pixel on the object in the first frame; short for "
                 "segmenter.seed_*")
      ->delimiter(',')
      ->expected(2)
      ->type_name("U,V");
  app.add_option("--object", settings.objects,
                 "One of several objects, each told by the value of its pixels in the mask or by "
                 "its own seed or region, e.g. name=box,label=1 or name=can,seed=320:180; may be "
                 "repeated; in place of [[object]] in --config, see docs/several-objects.md")
      ->type_name("KEY=VALUE,...")
      ->allow_extra_args(false);
  app.add_option("--threads", options.threads,
                 "Threads that share out the objects [as many as objects and processors]")
      ->check(CLI::Range(1, static_cast<int>(kMaxObjects)).description(""))
      ->type_name("N");
  app.add_option("--mask-stream", options.mask_stream,
                 "Masks of another process: shared memory /NAME, file:PATH or v4l2:DEVICE, see "
                 "docs/masks.md")
      ->type_name("NAME");
  app.add_option("--mask-age", options.mask_max_age_s,
                 "A mask this much older than the frame is not used any more [0.1]")
      ->check(CLI::Range(0.0, 10.0).description(""))
      ->type_name("SECONDS");
}

void AddCameraPose(CLI::App& app, CameraPoseOptions& pose) {
  app.add_option("--camera-pose", pose.system_id,
                 "The camera is carried by this MAVLink system: its ODOMETRY, received on the "
                 "links, gives the camera's pose, and the object's pose is sent in the world")
      ->check(CLI::Range(1, 255).description(""))
      ->type_name("SYSTEM");
  app.add_option("--camera-in-body", pose.camera_in_body,
                 "Where the optical frame sits in the body that the ODOMETRY describes, metres and "
                 "a quaternion [at its origin, looking along its x axis: 0,0,0,0.5,0.5,0.5,0.5]")
      ->delimiter(',')
      ->expected(7)
      ->type_name("X,Y,Z,QW,QX,QY,QZ");
  app.add_option("--camera-world", pose.world,
                 "World frame of that ODOMETRY and of what is sent [frd]")
      ->transform(Choice(kWorlds))
      ->type_name("ned|enu|frd|flu");
  app.add_flag("--camera-own-clock", pose.own_clock,
               "That ODOMETRY is stamped on another clock than the depth images; the difference is "
               "learnt from the times of arrival");
}

void AddRealtime(CLI::App& app, RealtimeOptions& realtime) {
  app.add_option("--rt-priority", realtime.priority,
                 "Run before all ordinary programs: SCHED_FIFO, 1 to 98")
      ->check(CLI::Range(1, 98).description(""))
      ->type_name("N");
  app.add_option(
         "--cpu", realtime.cpus,
         "Processors of the tracking and of the capture thread, then of those that help with "
         "several objects")
      ->delimiter(',')
      ->expected(1, 1 + static_cast<int>(kMaxObjects))
      ->type_name("N[,N...]");
  app.add_flag("--lock-memory", realtime.lock_memory, "Keep all memory in RAM");
}

/// CLI::PositiveNumber would name its upper bound with all its 309 digits.
std::string CheckLength(const std::string& text) {
  double value_m = 0.0;
  const bool is_number = CLI::detail::lexical_cast(text, value_m);
  if (is_number && std::isfinite(value_m) && value_m > 0.0) return {};
  return text + " is no length; a number of metres above 0 is needed";
}

void AddOutput(CLI::App& app, Options& options, CommonObjectOptions& objects) {
  app.add_option("--link", options.links, "Send pose, twist and status there; may be repeated")
      ->type_name("URI")
      ->allow_extra_args(false);
  app.add_option("--id", objects.first_index,
                 "Object index on the links, added to the component id; of the first of several "
                 "[0]")
      ->check(CLI::Range(0, int{hal::mavlink::kMaxObjectIndex}).description(""))
      ->type_name("N");
  app.add_option("--csv", objects.files.csv,
                 "Write the trajectory; with several objects a file each: run.csv of the object "
                 "box is run-box.csv, and so with all that follows")
      ->type_name("FILE");
  app.add_option("--mesh", objects.files.mesh,
                 "Write the surface at the end: binary PLY, coloured by uncertainty (dark = "
                 "certain), std_m in metres; OBJ if the name ends in .obj")
      ->type_name("FILE");
  app.add_option("--mesh-resolution", options.mesh_resolution_m,
                 "Edge of the mesh's sampling cubes in metres; at most 16 fit into a cell "
                 "(field.cell_size_m) [a tenth of it]")
      ->check(CheckLength)
      ->type_name("METRES");
  app.add_option("--mesh-picture", objects.files.mesh_picture,
                 "Draw the surface at the end: PNG, from the first camera, right, behind and above")
      ->type_name("FILE");
  app.add_option("--flow", objects.files.flow,
                 "Write the distance flow: a PLY per frame with the observed points, their "
                 "distance to the model, its gradient and their velocity")
      ->type_name("DIR");
  app.add_option("--record", options.record,
                 "Write the frames as a sequence for replay:DIR; or, with their results, as "
                 "messages of ROS 2, if the name ends in .mcap (docs/ros2.md)")
      ->type_name("DIR|FILE.mcap");
  AddRotationOptions(app, options.rotation);
  app.add_option("--log", options.log,
                 "Where messages go: text, lines on standard error; journald, entries with fields "
                 "in the system's journal, or in that of another socket [auto: the journal if "
                 "standard error leads there]")
      ->type_name("auto|text|journald[:SOCKET]");
  app.add_flag("--headless", options.headless, "No live status line");
  app.add_flag_callback(
      "--no-timing", [&options] { options.timing = false; },
      "Write 0 for all times, so that two runs give the same bytes");
  app.add_flag("--print-config", options.print_config, "Print all settings as TOML and end");
  app.add_flag("--print-settings-table", options.print_settings_table,
               "Print docs/settings.md and end");
}

/// Takes the link that is no MAVLink out of the list of those that are.
void SplitLinks(Options& options) {
  const auto dds = std::stable_partition(options.links.begin(), options.links.end(),
                                         [](const auto& uri) { return !IsDdsAddress(uri); });
  if (options.links.end() - dds > 1) {
    throw Failure(kWrongUsage, "one --link dds: is enough: it shows all objects");
  }
  if (dds == options.links.end()) return;
  options.dds_link = *dds;
  const DdsAddress address = ParseDdsAddress(options.dds_link);
  if (!address.mask_topic.empty() && !options.mask_stream.empty()) {
    throw Failure(kWrongUsage, "masks come from --mask-stream or from --link dds:mask=, not both");
  }
  if (!address.world_frame.empty() && options.camera_pose.system_id != 0) {
    throw Failure(kWrongUsage,
                  "the camera's pose comes by --camera-pose or by --link dds:world=, not both");
  }
  options.links.erase(dds);
}

/// A variable may be set for all runs, also for those that do not look at it.
bool IsOfTheEnvironment(const CLI::App& app, const char* name) {
  const CLI::Option* const option = app.get_option(name);
  const char* const value = std::getenv(option->get_envname().c_str());
  return value != nullptr && option->results() == std::vector<std::string>{value};
}

/// What would do nothing is a mistake, whether it was typed or stands in a file.
void CheckNeeds(const CLI::App& app, const Options& options) {
  constexpr std::pair<const char*, const char*> kNeeds[] = {{"--camera-world", "--camera-pose"},
                                                            {"--camera-own-clock", "--camera-pose"},
                                                            {"--view-hold", "--view"},
                                                            {"--view-token", "--view"}};
  for (const auto& [option, needed] : kNeeds) {
    const bool is_given = app.get_option(option)->count() > 0 && !IsOfTheEnvironment(app, option);
    if (is_given && app.get_option(needed)->count() == 0)
      throw Failure(kWrongUsage, std::string(option) + " does nothing without " + needed);
  }
  const bool has_mesh =
      std::any_of(options.objects.begin(), options.objects.end(),
                  [](const ObjectOptions& object) { return !object.files.mesh.empty(); });
  if (options.mesh_resolution_m > 0.0 && !has_mesh)
    throw Failure(kWrongUsage, "--mesh-resolution does nothing without --mesh");
}

void CheckCameraPose(const Options& options) {
  const CameraPoseOptions& pose = options.camera_pose;
  if (pose.system_id == 0) return;
  if (options.links.empty()) {
    throw Failure(kWrongUsage, "--camera-pose needs a --link on which the ODOMETRY comes in");
  }
  if (pose.system_id == hal::mavlink::TelemetryOptions{}.system_id) {
    throw Failure(kWrongUsage, "--camera-pose " + std::to_string(pose.system_id) +
                                   " is this program's own system id");
  }
}

void CheckCameraInBody(const CameraPoseOptions& pose) {
  if (pose.camera_in_body.empty()) return;
  double norm = 0.0;
  bool finite = true;
  for (std::size_t i = 0; i < pose.camera_in_body.size(); ++i) {
    const double value = pose.camera_in_body[i];
    finite = finite && std::isfinite(value);
    if (i >= 3) norm += value * value;
  }
  if (!finite || std::abs(norm - 1.0) > 0.01) {
    throw Failure(kWrongUsage,
                  "--camera-in-body: the last four numbers are no unit quaternion (w x y z)");
  }
}

void CheckMaskStream(const Options& options) {
  // The range of the option itself lets NaN pass.
  if (std::isnan(options.mask_max_age_s)) {
    throw Failure(kWrongUsage, "--mask-age nan is not a number of seconds");
  }
  if (options.mask_stream.empty()) return;
  Require(posix::CheckMaskName(options.mask_stream), kWrongUsage);
}

void CheckResolution(const Options& options) {
  if (options.mesh_resolution_m == 0.0) return;
  for (const ObjectOptions& object : options.objects) {
    const double cell_m = static_cast<double>(object.config.field.cell_size_m);
    const double finest_m = cell_m / kMaxStepsPerCell;
    if (options.mesh_resolution_m >= 0.9999 * finest_m) continue;
    throw Failure(kWrongUsage, "--mesh-resolution is too fine: with field.cell_size_m = " +
                                   std::to_string(cell_m) + " it is at least " +
                                   std::to_string(finest_m));
  }
}

}  // namespace

Options ParseCommandLine(int argc, char** argv, bool& exit_now, const Config& defaults) {
  Options options;
  options.config = defaults;
  SettingSources settings;
  CLI::App app(kDescription, "disflow_track");
  app.footer(std::string("Sensors:\n") + posix::kCameraAddressHelp + kDdsSensorHelp + kRosbagHelp +
             host::SensorHelp() + kLinksAndStatus);
  app.add_flag("--version", options.print_version, "Show version and what is built in, and end");
  AddInput(app, options, settings);
  AddObject(app, options, settings);
  AddCameraPose(app, options.camera_pose);
  AddRealtime(app, options.realtime);
  AddOutput(app, options, settings.common);
  AddViewOptions(app, options.view);
  std::vector<std::string> arguments(argv + std::min(argc, 1), argv + argc);
  settings.ros = TakeRosArguments(arguments);
  std::reverse(arguments.begin(), arguments.end());  // as the parser wants them
  try {
    app.parse(std::move(arguments));
    RefuseEmptyValues(app);
  } catch (const CLI::Success& answer) {
    (void)app.exit(answer);
    exit_now = true;
    return options;
  } catch (const CLI::ParseError& error) {
    throw Failure(kWrongUsage, std::string(error.what()) + "; see disflow_track --help");
  }
  if (options.print_version) return options;
  ReadSettings(app, settings, options);
  CheckNeeds(app, options);
  CheckResolution(options);
  SplitLinks(options);
  CheckTopicsAreUsed(settings.ros, options);
  if (IsDdsAddress(options.sensor))
    (void)SensorNode(ParseDdsSensorAddress(options.sensor), options.dds_link);
  CheckCameraPose(options);
  CheckCameraInBody(options.camera_pose);
  CheckMaskStream(options);
  CheckRotation(options);
  (void)LogTarget(options.log);  // refuses words that there are not
  if (options.sensor.empty() && !options.list_sensors && !options.print_config &&
      !options.print_settings_table) {
    throw Failure(kWrongUsage, "--sensor is required; see disflow_track --help");
  }
  return options;
}

}  // namespace disflow::apps
