// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "disflow/geometry/pinhole_camera.h"
#include "disflow/geometry/transform.h"
#include "disflow/hal/fault.h"

/// @file
/// A scene of the BOP benchmark: what its JSON files say of each image. BOP counts in millimetres;
/// here all is metres. Reading is bounded: a file of 64 MiB takes no more than twice as much.

namespace disflow::host {

/// The camera of one image, of scene_camera.json.
struct BopCamera {
  PinholeCamera camera;
  float unit_m = 0.0F;    ///< Of the depth image.
  bool has_T_wc = false;  ///< Whether the data set knows where the camera was.
  Transform<World, Camera> T_wc;
};

/// One object in one image, of scene_gt.json.
struct BopObject {
  int id = 0;  ///< obj_id, the number of its model.
  Transform<Camera, Object, double> T_co;
};

/// By image number.
using BopCameras = std::map<std::uint64_t, BopCamera>;
/// By image number; in the order of the file, which is that of the masks.
using BopObjects = std::map<std::uint64_t, std::vector<BopObject>>;

/// @return kNotFound, kCorrupt, kInvalidIntrinsics ..., naming the file and the image.
[[nodiscard]] hal::Fault ReadBopCameras(const std::filesystem::path& dir, BopCameras& cameras);
[[nodiscard]] hal::Fault ReadBopObjects(const std::filesystem::path& dir, BopObjects& objects);

/// Finds an object among those of an image.
/// @param wanted Its obj_id; gtN for the N-th in scene_gt.json, from 0 on; empty for the only one.
/// @param place In the list; -1 if this image does not show it.
/// @return kNotFound, and the choice, if `wanted` says too little.
[[nodiscard]] hal::Fault FindBopObject(const std::vector<BopObject>& objects,
                                       const std::string& wanted, int& place);

}  // namespace disflow::host
