// SPDX-License-Identifier: BSD-3-Clause
#include "input/sensor_choice.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <system_error>

#include "disflow/posix/camera/camera_address.h"
#include "disflow/posix/camera/camera_list.h"
#include "disflow/posix/camera/v4l2_sensor.h"
#include "program/exit_status.h"
#include "settings/camera_file.h"
#include "settings/dds_address.h"
#ifdef DISFLOW_HAS_LIBCAMERA
#include "disflow/posix/camera/libcamera_sensor.h"
#endif
#ifdef DISFLOW_HAS_ROSBAG
#include "disflow/posix/rosbag/bag_sensor.h"
#endif

namespace disflow::apps {
namespace {

using hal::Fault;
using posix::CameraAddress;

Fault OpenCamera(const std::string& uri, host::Sensor& sensor) {
  CameraAddress address;
  if (const Fault fault = posix::ParseCameraAddress(uri, address); !fault.ok()) return fault;
#ifndef DISFLOW_HAS_LIBCAMERA
  if (address.kind == CameraAddress::Kind::kLibcamera) {
    return hal::MakeFault(Status::kUnsupported,
                          "%s: this disflow_track was built without libcamera "
                          "(DISFLOW_WITH_LIBCAMERA=OFF); build it with, or use v4l2:",
                          uri.c_str());
  }
#endif
  posix::CameraDescription description;
  if (address.intrinsics[0] != '\0') {
    description = ReadCameraFile(address.intrinsics, address.rectified);
  }
#ifdef DISFLOW_HAS_LIBCAMERA
  if (address.kind == CameraAddress::Kind::kLibcamera) {
    return sensor.Emplace<posix::LibcameraSensor>(address, description).Open();
  }
#endif
  return sensor.Emplace<posix::V4l2Sensor>(address, description).Open();
}

Fault OpenRecording(const std::string& address, host::Sensor& sensor) {
#ifdef DISFLOW_HAS_ROSBAG
  host::Uri uri;
  if (const Fault fault = host::ParseUri(address, uri); !fault.ok()) return fault;
  posix::BagOptions options;
  if (const Fault fault = posix::ParseBagUri(uri, options); !fault.ok()) return fault;
  auto& recording = sensor.Emplace<posix::BagSensor>(options);
  const Fault fault = recording.Open();
  sensor.set_note(recording.note());
  return fault;
#else
  (void)sensor;
  return hal::MakeFault(Status::kInvalidUri,
                        "%s: this disflow_track was built without recordings of ROS "
                        "(DISFLOW_WITH_ROSBAG=OFF)",
                        address.c_str());
#endif
}

/// A file that ROS recorded, by its name alone. A colon may be in it if it is there.
bool IsRecordingFile(const std::string& uri) {
  const std::string path = uri.substr(0, uri.find('?'));
  constexpr std::array kExtensions = {".mcap", ".db3", ".bag", ".bag.active"};
  const bool is_meant = std::any_of(kExtensions.begin(), kExtensions.end(),
                                    [&path](const char* end) { return path.ends_with(end); });
  std::error_code error;
  return is_meant && (path.find(':') == std::string::npos || std::filesystem::exists(path, error));
}

/// Of any kind that is no ROS 2 topic.
Fault OpenByScheme(const std::string& uri, host::Sensor& sensor) {
  if (posix::IsCameraAddress(uri)) return OpenCamera(uri, sensor);
  if (uri.starts_with("rosbag:")) return OpenRecording(uri, sensor);
  if (IsRecordingFile(uri)) return OpenRecording("rosbag:" + uri, sensor);
  return host::OpenSensor(uri, sensor);
}

}  // namespace

std::shared_ptr<posix::RosNode> OpenSensor(const Options& options, host::Sensor& sensor,
                                           Console& console) {
  const std::string& uri = options.sensor;
  if (IsDdsAddress(uri)) return OpenRosSensor(options, sensor, console);
  const Fault fault = OpenByScheme(uri, sensor);
  if (fault.ok()) return nullptr;
  // A camera's intrinsics stand in the command line or a file of the user's.
  const bool is_usage = fault.status == Status::kInvalidUri ||
                        (posix::IsCameraAddress(uri) && fault.status == Status::kInvalidIntrinsics);
  throw Failure(is_usage ? kWrongUsage : kInputFailed, fault.message);
}

std::string ListSensors() {
  std::string text = posix::DescribeV4l2Cameras();
#ifdef DISFLOW_HAS_LIBCAMERA
  text += posix::DescribeLibcameraCameras();
#endif
  return text;
}

}  // namespace disflow::apps
