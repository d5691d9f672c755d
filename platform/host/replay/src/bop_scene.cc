// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/host/bop_scene.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cinttypes>
#include <cmath>
#include <functional>
#include <optional>
#include <span>
#include <system_error>

#include "bop_json.h"
#include "disflow/host/rigid_state.h"
#include "disflow/host/sequence_layout.h"

namespace disflow::host {
namespace {

namespace fs = std::filesystem;

constexpr double kMetresPerMillimetre = 1e-3;

hal::Fault ImageFault(const fs::path& file, std::uint64_t image, const char* problem) {
  return hal::MakeFault(Status::kCorrupt, "%s: image %" PRIu64 ": %s", file.c_str(), image,
                        problem);
}

/// @return Nothing if it is no rotation.
template <class To, class From>
std::optional<Transform<To, From, double>> ReadTransform(const BopEntry& entry, const char* R,
                                                         const char* t) {
  const std::span<const double> r = entry.Numbers(R, 9);
  const std::span<const double> p = entry.Numbers(t, 3);
  if (r.empty() || p.empty()) return std::nullopt;
  Mat3d rotation;
  rotation << r[0], r[1], r[2], r[3], r[4], r[5], r[6], r[7], r[8];
  if (!IsRotation(rotation)) return std::nullopt;
  const Vec3d translation_m = kMetresPerMillimetre * Vec3d(p[0], p[1], p[2]);
  return Transform<To, From, double>(rotation, translation_m).Normalized();
}

hal::Fault AddCamera(const fs::path& file, const BopEntry& entry, BopCameras& cameras) {
  const std::span<const double> k = entry.Numbers("cam_K", 9);
  const std::span<const double> scale = entry.Numbers("depth_scale", 1);
  if (k.empty() || scale.empty()) {
    return ImageFault(file, entry.image, "cam_K (nine numbers) and depth_scale are needed");
  }
  BopCamera camera;
  camera.camera = {static_cast<float>(k[0]), static_cast<float>(k[4]), static_cast<float>(k[2]),
                   static_cast<float>(k[5])};
  camera.unit_m = static_cast<float>(kMetresPerMillimetre * scale[0]);
  if (!camera.camera.IsValid() || k[1] != 0.0) {
    hal::Fault fault = ImageFault(file, entry.image, "cam_K is no camera without skew");
    fault.status = Status::kInvalidIntrinsics;
    return fault;
  }
  if (!(camera.unit_m > 0.0F && camera.unit_m <= 1.0F)) {
    return ImageFault(file, entry.image, "depth_scale is no positive number of millimetres");
  }
  const auto T_cw = ReadTransform<Camera, World>(entry, "cam_R_w2c", "cam_t_w2c");
  camera.has_T_wc = T_cw.has_value();
  if (T_cw) camera.T_wc = T_cw->Inverse().Cast<float>();
  if (cameras.emplace(entry.image, camera).second) return {};
  return ImageFault(file, entry.image, "is there twice");
}

hal::Fault AddObject(const fs::path& file, const BopEntry& entry, BopObjects& objects) {
  const std::span<const double> id = entry.Numbers("obj_id", 1);
  const auto T_co = ReadTransform<Camera, Object>(entry, "cam_R_m2c", "cam_t_m2c");
  constexpr double kMaxId = 1e6;
  if (id.empty() || !(id[0] >= 0.0 && id[0] <= kMaxId) || !T_co) {
    return ImageFault(file, entry.image, "obj_id, a rotation cam_R_m2c and cam_t_m2c are needed");
  }
  objects[entry.image].push_back({static_cast<int>(id[0]), *T_co});
  return {};
}

int CountOf(const std::vector<BopObject>& objects, int id) {
  return static_cast<int>(std::count_if(objects.begin(), objects.end(),
                                        [id](const BopObject& object) { return object.id == id; }));
}

/// A choice that names one object only: obj_id, or gtN where that is there several times.
hal::Fault Choose(const std::vector<BopObject>& objects) {
  std::string list;
  for (std::size_t i = 0; i < objects.size(); ++i) {
    const bool is_one = CountOf(objects, objects[i].id) == 1;
    list.append(is_one ? " " : " gt")
        .append(std::to_string(is_one ? objects[i].id : static_cast<int>(i)));
  }
  return hal::MakeFault(Status::kNotFound, "choose an object (obj_id, or gtN by its place) of:%s",
                        list.c_str());
}

std::optional<int> ParseNumber(std::string_view text) {
  int number = 0;
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, number);
  if (error != std::errc{} || stop != end || number < 0) return std::nullopt;
  return number;
}

}  // namespace

hal::Fault ReadBopCameras(const fs::path& dir, BopCameras& cameras) {
  const fs::path file = dir / kBopCameraFile;
  return ReadBopJson(file, [&](const BopEntry& entry) { return AddCamera(file, entry, cameras); });
}

hal::Fault ReadBopObjects(const fs::path& dir, BopObjects& objects) {
  const fs::path file = dir / kBopTruthFile;
  return ReadBopJson(file, [&](const BopEntry& entry) { return AddObject(file, entry, objects); });
}

hal::Fault FindBopObject(const std::vector<BopObject>& objects, const std::string& wanted,
                         int& place) {
  place = -1;
  const auto size = static_cast<int>(objects.size());
  if (wanted.empty()) {
    if (size > 1) return Choose(objects);
    place = size - 1;
    return {};
  }
  const bool by_place = wanted.starts_with("gt");
  const std::optional<int> number = ParseNumber(std::string_view(wanted).substr(by_place ? 2 : 0));
  if (!number) return Choose(objects);
  if (by_place) {
    place = *number < size ? *number : -1;
    return {};
  }
  const auto is_wanted = [&number](const BopObject& object) { return object.id == *number; };
  const auto found = std::find_if(objects.begin(), objects.end(), is_wanted);
  if (found == objects.end()) return {};
  if (CountOf(objects, *number) > 1) return Choose(objects);
  place = static_cast<int>(found - objects.begin());
  return {};
}

}  // namespace disflow::host
