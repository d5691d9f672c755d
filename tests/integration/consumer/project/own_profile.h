// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "disflow/limits.h"

namespace consumer {

/// Capacities of this project's own: small images, one hand-sized object.
struct OwnProfile {
  static constexpr const char* kName = "Own";
  static constexpr int kMaxImageWidth = 160;
  static constexpr int kMaxImageHeight = 120;
  static constexpr int kMaxRuns = 768;
  static constexpr int kMaxBlocks = 1024;
  static constexpr int kMaxSurfaceSamples = 400;
  static constexpr int kMaxEdgePoints = 96;
  static constexpr int kMaxNodes = 384;
  static constexpr int kMaxClusters = 224;
  static constexpr int kMaxSamplesPerCluster = 16;
  static constexpr int kMaxTrainingSamples = 14;
  static constexpr int kMaxModelEdges = 384;
  static constexpr int kMaxSeenViews = 3;
  static constexpr int kSeenCells = 20;
  static constexpr int kMaxRegistrationPoints = 200;
};

}  // namespace consumer
