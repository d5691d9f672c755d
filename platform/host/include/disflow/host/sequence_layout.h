// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <filesystem>

/// @file
/// Names of the files and folders of a sequence in the Fast-YCB layout, and of others' layouts.

namespace disflow::host {

inline constexpr const char* kCameraFile = "cam_K.json";
inline constexpr const char* kIntrinsicsFile = "camera-intrinsics.txt";
inline constexpr const char* kDataFile = "data.txt";
inline constexpr const char* kDepthFolder = "depth";
inline constexpr const char* kMaskedDepthFolder = "masked_depth";
inline constexpr const char* kMaskFolder = "masks";
inline constexpr const char* kInfraredFolder = "infrared";
inline constexpr const char* kTruthFolder = "gt";
/// In kTruthFolder, or in a folder of the object's name in it.
inline constexpr const char* kPoseFile = "poses.txt";
inline constexpr const char* kVelocityFile = "velocities.txt";
inline constexpr const char* kWorldPoseFile = "T_wc.txt";
/// Its line of a frame for which the camera's pose was not known.
inline constexpr const char* kNoWorldPose = "none";
inline constexpr const char* kPoseFolder = "pose";
/// TUM RGB-D.
inline constexpr const char* kTumDepthFile = "depth.txt";
inline constexpr const char* kTumPoseFile = "groundtruth.txt";
/// BOP, a scene.
inline constexpr const char* kBopCameraFile = "scene_camera.json";
inline constexpr const char* kBopTruthFile = "scene_gt.json";
inline constexpr const char* kBopVisibleFolder = "mask_visib";
inline constexpr const char* kDepthExtension = ".float";
inline constexpr const char* kImageExtension = ".png";

/// Folders of models of a BOP data set, which lie beside those of its scenes; the first counts.
[[nodiscard]] inline std::array<std::filesystem::path, 2> BopModelFolders(
    const std::filesystem::path& scene) {
  const auto data_set = (std::filesystem::absolute(scene) / ".." / "..").lexically_normal();
  return {data_set / "models_eval", data_set / "models"};
}

}  // namespace disflow::host
