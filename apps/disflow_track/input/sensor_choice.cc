// SPDX-License-Identifier: BSD-3-Clause
#include "input/sensor_choice.h"

#include "disflow/posix/camera/camera_address.h"
#include "disflow/posix/camera/camera_list.h"
#include "disflow/posix/camera/v4l2_sensor.h"
#include "program/exit_status.h"
#include "settings/camera_file.h"
#include "settings/dds_address.h"
#ifdef DISFLOW_HAS_LIBCAMERA
#include "disflow/posix/camera/libcamera_sensor.h"
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
  if (address.intrinsics[0] != '\0') description = ReadCameraFile(address.intrinsics);
#ifdef DISFLOW_HAS_LIBCAMERA
  if (address.kind == CameraAddress::Kind::kLibcamera) {
    return sensor.Emplace<posix::LibcameraSensor>(address, description).Open();
  }
#endif
  return sensor.Emplace<posix::V4l2Sensor>(address, description).Open();
}

}  // namespace

std::shared_ptr<posix::RosNode> OpenSensor(const Options& options, host::Sensor& sensor,
                                           Console& console) {
  const std::string& uri = options.sensor;
  if (IsDdsAddress(uri)) return OpenRosSensor(options, sensor, console);
  const bool is_camera = posix::IsCameraAddress(uri);
  const Fault fault = is_camera ? OpenCamera(uri, sensor) : host::OpenSensor(uri, sensor);
  if (fault.ok()) return nullptr;
  // A camera's intrinsics stand in the command line or a file of the user's.
  const bool is_usage = fault.status == Status::kInvalidUri ||
                        (is_camera && fault.status == Status::kInvalidIntrinsics);
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
