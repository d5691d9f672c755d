// SPDX-License-Identifier: BSD-3-Clause
#include "settings/ros_camera_file.h"

#include <yaml-cpp/yaml.h>

#include <cmath>
#include <string_view>
#include <vector>

#include "disflow/posix/camera/camera_address.h"
#include "settings/camera_file.h"
#include "settings/refusal.h"
#include "settings/settings_text.h"
#include "settings/yaml_place.h"

namespace disflow::apps {
namespace {

YAML::Node Find(const std::string& path, const YAML::Node& parent, const char* key) {
  const YAML::Node node = parent.IsMap() ? parent[key] : YAML::Node(YAML::NodeType::Undefined);
  if (!node.IsDefined()) {
    Refuse(path + ": ", std::string(key) +
                            " is missing; a camera file of ROS has image_width, image_height, "
                            "camera_matrix and projection_matrix with data");
  }
  return node;
}

/// @throws Failure unless it is a number of the given range.
double Number(const std::string& path, const YAML::Node& node, const char* key, double min,
              double max) {
  double value = std::nan("");
  const bool is_number = node.IsScalar() && YAML::convert<double>::decode(node, value);
  // Written so that NaN fails.
  if (is_number && value >= min && value <= max) return value;
  Refuse(YamlPlace(path, node.Mark()),
         std::string(key) + " is not a number from " + NumberText(min) + " to " + NumberText(max));
}

int Side(const std::string& path, const YAML::Node& file, const char* key) {
  const YAML::Node node = Find(path, file, key);
  const double value = Number(path, node, key, 1.0, posix::CameraAddress::kMaxSide_px);
  if (value != std::floor(value))
    Refuse(YamlPlace(path, node.Mark()), std::string(key) + " is not whole");
  return static_cast<int>(value);
}

/// The numbers of a matrix or a list, row by row.
std::vector<double> Numbers(const std::string& path, const YAML::Node& matrix, const char* key,
                            double most) {
  const YAML::Node data = matrix.IsMap() ? Find(path, matrix, "data") : matrix;
  if (!data.IsSequence())
    Refuse(YamlPlace(path, data.Mark()), std::string(key) + " holds no list of numbers");
  std::vector<double> values;
  for (const YAML::Node& entry : data) values.push_back(Number(path, entry, key, -most, most));
  return values;
}

void RefuseDistortion(const std::string& path, const YAML::Node& file) {
  constexpr double kAny = 1e9;
  const YAML::Node node = file["distortion_coefficients"];
  if (!node.IsDefined()) return;
  for (const double value : Numbers(path, node, "distortion_coefficients", kAny)) {
    if (value == 0.0) continue;
    Refuse(
        YamlPlace(path, node.Mark()),
        "the camera is distorted, and rectified images are needed: if the driver rectifies them, "
        "add rectified=yes to the address, and projection_matrix counts; if image_proc does, take "
        "them from ROS by --sensor dds:");
  }
}

/// The upper left of a matrix of three rows, K of ROS or its P.
PinholeCamera ReadPinhole(const std::string& path, const YAML::Node& matrix, const char* key,
                          std::size_t columns) {
  // Wide enough for P's fourth column in any unit; what is of pixels is bounded below.
  constexpr double kAny = 1e9;
  const std::vector<double> m = Numbers(path, matrix, key, kAny);
  const auto at = [&](std::size_t row, std::size_t column) { return m[row * columns + column]; };
  const auto is_focal = [](double f_px) { return f_px >= 1.0 && f_px <= kMaxIntrinsic_px; };
  const bool is_pinhole = m.size() == 3 * columns && at(0, 1) == 0.0 && at(1, 0) == 0.0 &&
                          at(2, 0) == 0.0 && at(2, 1) == 0.0 && at(2, 2) == 1.0 &&
                          is_focal(at(0, 0)) && is_focal(at(1, 1));
  if (!is_pinhole) {
    Refuse(YamlPlace(path, matrix.Mark()),
           std::string(key) +
               " is not fx 0 cx, 0 fy cy, 0 0 1 with focal lengths from 1 "
               "pixel to " +
               NumberText(kMaxIntrinsic_px));
  }
  return {static_cast<float>(at(0, 0)), static_cast<float>(at(1, 1)), static_cast<float>(at(0, 2)),
          static_cast<float>(at(1, 2))};
}

PinholeCamera ReadCamera(const std::string& path, const YAML::Node& file, bool rectified,
                         const posix::CameraDescription& size) {
  const char* const key = rectified ? "projection_matrix" : "camera_matrix";
  const YAML::Node matrix = Find(path, file, key);
  // The fourth column of P says where the right eye of a pair is, seen from the left one. Depth and
  // poses are in the frame of the eye whose file this is, which it does not move.
  const PinholeCamera camera = ReadPinhole(path, matrix, key, rectified ? 4 : 3);
  if (!camera.CanImage(size.width_px, size.height_px)) {
    Refuse(YamlPlace(path, matrix.Mark()),
           std::string(key) + " is of no camera with " + std::to_string(size.width_px) + "x" +
               std::to_string(size.height_px) + " pixels: its centre is too far off");
  }
  return camera;
}

}  // namespace

bool IsRosCameraFile(const std::string& path) {
  const std::string_view name = path;
  return name.ends_with(".yaml") || name.ends_with(".yml");
}

posix::CameraDescription ReadRosCameraFile(const std::string& path, bool rectified) {
  const std::string text = ReadSettingsText(path);
  try {
    const YAML::Node file = YAML::Load(text);
    posix::CameraDescription description;
    description.width_px = Side(path, file, "image_width");
    description.height_px = Side(path, file, "image_height");
    description.camera = ReadCamera(path, file, rectified, description);
    // What the driver has undone is not asked for.
    if (!rectified) RefuseDistortion(path, file);
    return description;
  } catch (const YAML::Exception& error) {
    Refuse(YamlPlace(path, error.mark), error.msg);
  }
}

}  // namespace disflow::apps
