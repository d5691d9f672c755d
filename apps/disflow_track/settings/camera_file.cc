// SPDX-License-Identifier: BSD-3-Clause
#include "settings/camera_file.h"

#include <array>
#include <cmath>
#include <cstdio>

#include "disflow/posix/camera/camera_address.h"
#include "settings/ros_camera_file.h"
#include "settings/toml_file.h"

namespace disflow::apps {
namespace {

using posix::CameraAddress;

struct CameraNumber {
  const char* name;
  double min;
  double max;
  bool whole;
  bool required;
};

constexpr std::array kNumbers{
    CameraNumber{"width", 1.0, CameraAddress::kMaxSide_px, true, true},
    CameraNumber{"height", 1.0, CameraAddress::kMaxSide_px, true, true},
    CameraNumber{"fx", 1.0, kMaxIntrinsic_px, false, true},
    CameraNumber{"fy", 1.0, kMaxIntrinsic_px, false, true},
    CameraNumber{"cx", -kMaxIntrinsic_px, kMaxIntrinsic_px, false, true},
    CameraNumber{"cy", -kMaxIntrinsic_px, kMaxIntrinsic_px, false, true},
    CameraNumber{"depth_scale", 1e-7, 1.0, false, false},
};

constexpr const char* kWhatIsNeeded =
    "a camera file has width, height, fx, fy, cx, cy and perhaps depth_scale";

double ReadKey(const std::string& path, const toml::table& table, const CameraNumber& key) {
  const toml::node* const node = table.get(key.name);
  if (node == nullptr) {
    if (!key.required) return 0.0;
    Refuse(path + ": ", std::string(key.name) + " is missing; " + kWhatIsNeeded);
  }
  const double value = node->value<double>().value_or(std::nan(""));
  // Written so that NaN fails.
  const bool in_range = value >= key.min && value <= key.max;
  if (!in_range || (key.whole && !node->is_integer())) {
    std::array<char, 128> text{};
    (void)std::snprintf(text.data(), text.size(), "%s is not a %snumber from %g to %g", key.name,
                        key.whole ? "whole " : "", key.min, key.max);
    Refuse(Where(path, *node), text.data());
  }
  return value;
}

void RefuseUnknownKeys(const std::string& path, const toml::table& table) {
  for (const auto& [name, node] : table) {
    bool known = false;
    for (const CameraNumber& key : kNumbers) known = known || name.str() == key.name;
    if (known) continue;
    Refuse(Where(path, node), std::string(name.str()).append(" is not known; ") + kWhatIsNeeded);
  }
}

}  // namespace

posix::CameraDescription ReadCameraFile(const std::string& path, bool rectified) {
  if (IsRosCameraFile(path)) return ReadRosCameraFile(path, rectified);
  const toml::table table = ParseTomlFile(path);
  RefuseUnknownKeys(path, table);
  std::array<double, kNumbers.size()> values{};
  for (std::size_t i = 0; i < kNumbers.size(); ++i) values[i] = ReadKey(path, table, kNumbers[i]);
  posix::CameraDescription description;
  description.width_px = static_cast<int>(values[0]);
  description.height_px = static_cast<int>(values[1]);
  description.camera = {static_cast<float>(values[2]), static_cast<float>(values[3]),
                        static_cast<float>(values[4]), static_cast<float>(values[5])};
  description.unit_m = static_cast<float>(values[6]);
  return description;
}

}  // namespace disflow::apps
