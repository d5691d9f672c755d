// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <concepts>

/// @file
/// Capacities, fixed at compile time. A profile lists them all; `Tracker<Profile>` owns exactly
/// that much memory by value. docs/memory.md has the byte table. Settings that may change at run
/// time are in config.h.

namespace disflow {

/// What a profile must have. Each member is a requirement of its own, so that the compiler names
/// the one that is missing.
// clang-format off
template <class Profile>
concept CapacityProfile =
    requires { { Profile::kName } -> std::convertible_to<const char*>; } &&
    requires { { Profile::kMaxImageWidth } -> std::convertible_to<int>; } &&
    requires { { Profile::kMaxImageHeight } -> std::convertible_to<int>; } &&
    requires { { Profile::kMaxRuns } -> std::convertible_to<int>; } &&
    requires { { Profile::kMaxBlocks } -> std::convertible_to<int>; } &&
    requires { { Profile::kMaxSurfaceSamples } -> std::convertible_to<int>; } &&
    requires { { Profile::kMaxEdgePoints } -> std::convertible_to<int>; } &&
    requires { { Profile::kMaxNodes } -> std::convertible_to<int>; } &&
    requires { { Profile::kMaxClusters } -> std::convertible_to<int>; } &&
    requires { { Profile::kMaxSamplesPerCluster } -> std::convertible_to<int>; } &&
    requires { { Profile::kMaxTrainingSamples } -> std::convertible_to<int>; } &&
    requires { { Profile::kMaxModelEdges } -> std::convertible_to<int>; } &&
    requires { { Profile::kMaxSeenViews } -> std::convertible_to<int>; } &&
    requires { { Profile::kSeenCells } -> std::convertible_to<int>; } &&
    requires { { Profile::kMaxRegistrationPoints } -> std::convertible_to<int>; } &&
    // Positive, and within the 16-bit numbers that elements of the stores are counted by.
    (Profile::kMaxImageWidth > 0 && Profile::kMaxImageWidth <= 32767) &&
    (Profile::kMaxImageHeight > 0 && Profile::kMaxImageHeight <= 32767) &&
    (Profile::kMaxRuns > 0 && Profile::kMaxRuns <= 65535) &&
    (Profile::kMaxBlocks > 0) &&
    (Profile::kMaxSurfaceSamples > 0 && Profile::kMaxSurfaceSamples <= 52428) &&
    (Profile::kMaxEdgePoints > 0) &&
    (Profile::kMaxNodes > 0 && Profile::kMaxNodes < 65535) &&
    (Profile::kMaxClusters > 0 && Profile::kMaxClusters < 65535) &&
    (Profile::kMaxSamplesPerCluster > 0) &&
    (Profile::kMaxTrainingSamples > 0) &&
    (Profile::kMaxModelEdges > 0) &&
    (Profile::kMaxSeenViews > 0) &&
    (Profile::kSeenCells > 0) &&
    // The search for a pose compares starts on two fifths of them.
    (Profile::kMaxRegistrationPoints >= 3);
// clang-format on

}  // namespace disflow

namespace disflow::profiles {

/// Cortex-A class boards, the default.
struct Edge {
  static constexpr const char* kName = "Edge";
  static constexpr int kMaxImageWidth = 1280;
  static constexpr int kMaxImageHeight = 720;
  static constexpr int kMaxRuns = 8192;    ///< Horizontal pixel runs on connected surfaces.
  static constexpr int kMaxBlocks = 6144;  ///< Pixel blocks that cover the object's bounding box.
  static constexpr int kMaxSurfaceSamples = 2048;   ///< M, surface samples per frame.
  static constexpr int kMaxEdgePoints = 192;        ///< Occluding-edge points per frame.
  static constexpr int kMaxNodes = 896;             ///< Octree nodes.
  static constexpr int kMaxClusters = 640;          ///< Local GPs.
  static constexpr int kMaxSamplesPerCluster = 24;  ///< Samples kept by one local GP.
  static constexpr int kMaxTrainingSamples = 16;    ///< N, samples that one local GP is trained on.
  static constexpr int kMaxModelEdges = 512;        ///< Occluding-edge samples in the model.
  static constexpr int kMaxSeenViews = 5;           ///< Views whose free space is remembered.
  static constexpr int kSeenCells = 40;             ///< Cells along either side of such a view.
  static constexpr int kMaxRegistrationPoints = 500;  ///< Samples used by one registration.
};

/// Cortex-M class controllers: images up to 240 x 180, one hand-sized object.
struct Micro {
  static constexpr const char* kName = "Micro";
  static constexpr int kMaxImageWidth = 240;
  static constexpr int kMaxImageHeight = 180;
  static constexpr int kMaxRuns = 1024;
  static constexpr int kMaxBlocks = 1536;
  static constexpr int kMaxSurfaceSamples = 512;
  static constexpr int kMaxEdgePoints = 128;
  static constexpr int kMaxNodes = 512;
  static constexpr int kMaxClusters = 320;
  static constexpr int kMaxSamplesPerCluster = 20;
  static constexpr int kMaxTrainingSamples = 12;
  static constexpr int kMaxModelEdges = 512;
  static constexpr int kMaxSeenViews = 3;
  static constexpr int kSeenCells = 24;
  static constexpr int kMaxRegistrationPoints = 250;
};

/// PC and Jetson class machines, rooms and people.
struct Dense {
  static constexpr const char* kName = "Dense";
  static constexpr int kMaxImageWidth = 1920;
  static constexpr int kMaxImageHeight = 1200;
  static constexpr int kMaxRuns = 24576;
  static constexpr int kMaxBlocks = 24576;
  static constexpr int kMaxSurfaceSamples = 6144;
  static constexpr int kMaxEdgePoints = 384;
  static constexpr int kMaxNodes = 16384;
  static constexpr int kMaxClusters = 8192;
  static constexpr int kMaxSamplesPerCluster = 24;
  static constexpr int kMaxTrainingSamples = 16;
  static constexpr int kMaxModelEdges = 2048;
  static constexpr int kMaxSeenViews = 6;
  static constexpr int kSeenCells = 48;
  static constexpr int kMaxRegistrationPoints = 1500;
};

}  // namespace disflow::profiles
