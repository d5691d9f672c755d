// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "disflow/config.h"
#include "disflow/hal/mavlink/messages.h"
#include "program/realtime_options.h"
#include "settings/object_options.h"
#include "settings/settings_file.h"
#include "settings/view_options.h"

namespace disflow::apps {

enum class ProfileName : std::uint8_t { kMicro, kEdge, kDense };
/// How fast frames are taken; a live sensor sets its own pace.
/// kLive: as kRealtime, and frames that come while the tracker is busy are lost, as with a camera.
enum class Rate : std::uint8_t { kMax, kRealtime, kLive };

/// A camera that moves, and where its pose comes from.
struct CameraPoseOptions {
  int system_id = 0;  ///< MAVLink system whose ODOMETRY moves the camera; 0 = the camera stands.
  hal::mavlink::MavFrame world = hal::mavlink::MavFrame::kLocalFrd;
  bool own_clock = false;
  std::vector<double>
      camera_in_body;  ///< x y z qw qx qy qz; empty: looks ahead from the body's origin.
};

/// When trajectories and recording go on in new files.
struct RotationOptions {
  double size_mb = 0.0;  ///< When they are larger together; 0: never.
  double age_s = 0.0;    ///< When they hold more time; 0: never.
  int keep = 0;          ///< Numbers that are kept, the newest included; 0: all.

  [[nodiscard]] bool wanted() const noexcept { return size_mb > 0.0 || age_s > 0.0; }
};

/// The command line, checked.
struct Options {
  std::string sensor;
  std::vector<std::string> links;  ///< That carry MAVLink.
  std::string dds_link;            ///< Empty: none.
  double mesh_resolution_m = 0.0;  ///< 0: by the model's own detail.
  std::string record;
  RotationOptions rotation;
  std::vector<std::string> settings_files;
  SettingsFile file;                   ///< What it says.
  Config config;                       ///< Defaults, then the file, then --set.
  std::vector<ObjectOptions> objects;  ///< At least one.
  int threads = 0;  ///< Among which the objects are shared out; 0 = by objects and processors.
  ProfileName profile = ProfileName::kEdge;
  Rate rate = Rate::kMax;
  std::int64_t frames = 0;  ///< At most; 0 = all.
  std::string mask_stream;  ///< See posix::MakeMaskSource().
  double mask_max_age_s = 0.1;
  CameraPoseOptions camera_pose;
  RealtimeOptions realtime;
  ViewOptions view;
  bool headless = false;
  std::string log = "auto";  ///< See LogTarget.
  bool timing = true;        ///< false: time columns are written as 0.

  bool list_sensors = false;
  bool print_config = false;
  bool print_settings_table = false;
  bool print_version = false;
};

/// Reads the command line; answers --help itself.
/// @param exit_now Set if the program has nothing left to do but to end with status 0.
/// @param defaults What holds where neither the command line nor the file says otherwise.
/// @throws Failure kWrongUsage.
[[nodiscard]] Options ParseCommandLine(int argc, char** argv, bool& exit_now,
                                       const Config& defaults = {});

}  // namespace disflow::apps
