// SPDX-License-Identifier: BSD-3-Clause
#include <string>
#include <vector>

#include "disflow/config.h"
#include "file_in_memory.h"
#include "program/exit_status.h"
#include "settings/camera_file.h"
#include "settings/ros_camera_file.h"
#include "settings/ros_parameter_file.h"
#include "settings/settings.h"

/// The settings file and the camera's: refused with file and words, or good enough to be used.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace disflow;
  static fuzz::FileInMemory file;
  file.Fill(data, size);
  try {
    Config config;
    (void)apps::LoadSettings(file.path(), config);
    apps::CheckSettings(config);
    fuzz::Require(Validate(config).status() == Status::kOk);
  } catch (const apps::Failure& failure) {
    fuzz::Require(failure.what()[0] != '\0');
  }
  try {
    Config config;
    (void)apps::LoadRosParameters(std::vector{file.path()}, "/disflow", config);
  } catch (const apps::Failure& failure) {
    fuzz::Require(std::string(failure.what()).find(file.path()) == 0);
  }
  try {
    const posix::CameraDescription camera = apps::ReadCameraFile(file.path());
    fuzz::Require(camera.width_px > 0 && camera.height_px > 0 && camera.camera.fx_px >= 1.0F);
  } catch (const apps::Failure& failure) {
    fuzz::Require(std::string(failure.what()).find(file.path()) == 0);
  }
  for (const bool rectified : {false, true}) {
    try {
      const posix::CameraDescription camera = apps::ReadRosCameraFile(file.path(), rectified);
      fuzz::Require(camera.camera.IsValid());
      fuzz::Require(camera.camera.CanImage(camera.width_px, camera.height_px));
    } catch (const apps::Failure& failure) {
      fuzz::Require(std::string(failure.what()).find(file.path()) == 0);
    }
  }
  try {
    Config config;
    apps::ApplySetting({reinterpret_cast<const char*>(data), size}, config);
  } catch (const apps::Failure&) {
    // Said in its words.
  }
  return 0;
}
