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

namespace disflow::apps {
namespace {

std::string At(const std::string& path, const YAML::Mark& mark) {
  return mark.is_null() ? path + ": " : path + ":" + std::to_string(mark.line + 1) + ": ";
}

YAML::Node Find(const std::string& path, const YAML::Node& parent, const char* key) {
  const YAML::Node node = parent.IsMap() ? parent[key] : YAML::Node(YAML::NodeType::Undefined);
  if (!node.IsDefined()) {
    Refuse(path + ": ", std::string(key) +
                            " is missing; a camera file of ROS has image_width, image_height and "
                            "camera_matrix with data");
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
  Refuse(At(path, node.Mark()),
         std::string(key) + " is not a number from " + NumberText(min) + " to " + NumberText(max));
}

int Side(const std::string& path, const YAML::Node& file, const char* key) {
  const YAML::Node node = Find(path, file, key);
  const double value = Number(path, node, key, 1.0, posix::CameraAddress::kMaxSide_px);
  if (value != std::floor(value)) Refuse(At(path, node.Mark()), std::string(key) + " is not whole");
  return static_cast<int>(value);
}

/// The numbers of a matrix or a list, row by row.
std::vector<double> Numbers(const std::string& path, const YAML::Node& matrix, const char* key,
                            double most) {
  const YAML::Node data = matrix.IsMap() ? Find(path, matrix, "data") : matrix;
  if (!data.IsSequence())
    Refuse(At(path, data.Mark()), std::string(key) + " holds no list of numbers");
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
    Refuse(At(path, node.Mark()),
           "the camera is distorted, and rectified images are needed; use those that the driver or "
           "image_proc rectifies, with the intrinsics that projection_matrix says, in a TOML file");
  }
}

}  // namespace

bool IsRosCameraFile(const std::string& path) {
  const std::string_view name = path;
  return name.ends_with(".yaml") || name.ends_with(".yml");
}

posix::CameraDescription ReadRosCameraFile(const std::string& path) {
  const std::string text = ReadSettingsText(path);
  try {
    const YAML::Node file = YAML::Load(text);
    posix::CameraDescription description;
    description.width_px = Side(path, file, "image_width");
    description.height_px = Side(path, file, "image_height");
    const YAML::Node matrix = Find(path, file, "camera_matrix");
    const std::vector<double> k = Numbers(path, matrix, "camera_matrix", kMaxIntrinsic_px);
    const bool is_pinhole = k.size() == 9 && k[1] == 0.0 && k[3] == 0.0 && k[6] == 0.0 &&
                            k[7] == 0.0 && k[8] == 1.0 && k[0] >= 1.0 && k[4] >= 1.0;
    if (!is_pinhole) {
      Refuse(At(path, matrix.Mark()),
             "camera_matrix is not fx 0 cx, 0 fy cy, 0 0 1 with focal lengths from 1 pixel on");
    }
    RefuseDistortion(path, file);
    description.camera = {static_cast<float>(k[0]), static_cast<float>(k[4]),
                          static_cast<float>(k[2]), static_cast<float>(k[5])};
    return description;
  } catch (const YAML::Exception& error) {
    Refuse(At(path, error.mark), error.msg);
  }
}

}  // namespace disflow::apps
