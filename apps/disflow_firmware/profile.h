// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "disflow/config.h"
#include "disflow/limits.h"

namespace disflow::firmware {

/// For controllers with 512 KiB of RAM that have other things to do as well: images up to 160 x
/// 120.
struct Small {
  static constexpr const char* kName = "Small";
  static constexpr int kMaxImageWidth = 160;
  static constexpr int kMaxImageHeight = 120;
  static constexpr int kMaxRuns = 768;
  static constexpr int kMaxBlocks = 1024;
  static constexpr int kMaxSurfaceSamples = 367;
  static constexpr int kMaxEdgePoints = 96;
  static constexpr int kMaxNodes = 384;
  static constexpr int kMaxClusters = 224;
  static constexpr int kMaxSamplesPerCluster = 16;
  static constexpr int kMaxTrainingSamples = 12;
  static constexpr int kMaxModelEdges = 182;
  static constexpr int kMaxSeenViews = 3;
  static constexpr int kSeenCells = 20;
  static constexpr int kMaxRegistrationPoints = 200;
};

/// What the image has memory for; the CMake option DISFLOW_FIRMWARE_PROFILE.
#ifdef DISFLOW_FIRMWARE_SMALL
using Profile = Small;
#else
using Profile = profiles::Micro;
#endif

/// Settings of the tracker for images of this size.
[[nodiscard]] inline Config FirmwareConfig() noexcept {
  Config config;
  // Outlines this coarse agree with few of the model's edges but are needed nevertheless.
  config.registration.edge_agreement = 0.0F;
  return config;
}

}  // namespace disflow::firmware
