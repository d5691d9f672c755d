// SPDX-License-Identifier: BSD-3-Clause
// Must not compile, and the compiler must say why: the profile lacks kMaxNodes.
#include "disflow/tracker.h"

namespace {

struct Incomplete {
  static constexpr const char* kName = "Incomplete";
  static constexpr int kMaxImageWidth = 320;
  static constexpr int kMaxImageHeight = 240;
  static constexpr int kMaxRuns = 1024;
  static constexpr int kMaxBlocks = 1536;
  static constexpr int kMaxSurfaceSamples = 512;
  static constexpr int kMaxEdgePoints = 128;
#ifdef COMPLETE
  static constexpr int kMaxNodes = 512;
#endif
  static constexpr int kMaxClusters = 320;
  static constexpr int kMaxSamplesPerCluster = 20;
  static constexpr int kMaxTrainingSamples = 12;
  static constexpr int kMaxModelEdges = 512;
  static constexpr int kMaxSeenViews = 3;
  static constexpr int kSeenCells = 24;
  static constexpr int kMaxRegistrationPoints = 250;
};

}  // namespace

static_assert(sizeof(disflow::Tracker<Incomplete>) > 0);
