// SPDX-License-Identifier: BSD-3-Clause
#include <libcamera/camera.h>
#include <libcamera/camera_manager.h>
#include <libcamera/logging.h>
#include <libcamera/property_ids.h>

#include "disflow/posix/camera/libcamera_sensor.h"
#include "raw_format.h"

namespace disflow::posix {
namespace {

std::string DescribeCamera(std::size_t number, libcamera::Camera& camera) {
  std::string text = "libcamera:" + std::to_string(number) + "  " + camera.id() + "\n";
  const auto model = camera.properties().get(libcamera::properties::Model);
  if (model) text += "  " + std::string(model->data(), model->size()) + "\n";
  auto configuration = camera.generateConfiguration({libcamera::StreamRole::Viewfinder});
  if (!configuration || configuration->empty()) return text + "  offers no stream\n";
  const libcamera::StreamFormats& formats = configuration->at(0).formats();
  for (const libcamera::PixelFormat& raw : formats.pixelformats()) {
    const DepthPixelFormat* const depth = DepthFormatOf(raw);
    text += depth != nullptr ? std::string("  format=") + depth->name
                             : "  " + raw.toString() + " (no depth format)";
    for (const libcamera::Size& size : formats.sizes(raw)) text += " " + size.toString();
    text += "\n";
  }
  return text;
}

}  // namespace

std::string DescribeLibcameraCameras() {
  libcamera::logSetTarget(libcamera::LoggingTargetNone);
  libcamera::CameraManager manager;
  if (manager.start() != 0) return "libcamera could not be started\n";
  std::string text;
  std::size_t number = 0;
  for (const auto& camera : manager.cameras()) text += DescribeCamera(number++, *camera);
  manager.stop();
  return text.empty() ? "no camera of libcamera\n" : text;
}

}  // namespace disflow::posix
