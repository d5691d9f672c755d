// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Prints what every part of a tracker costs in bytes, per profile: the table of docs/memory.md.

#include <cstdio>

#include "disflow/surface_extractor.h"
#include "disflow/tracker.h"

namespace {

void PrintRow(const char* part, std::size_t micro, std::size_t edge, std::size_t dense) {
  std::printf("| %-44s | %9zu | %9zu | %9zu |\n", part, micro, edge, dense);
}

template <template <class> class Part>
void PrintPart(const char* part) {
  using namespace disflow;
  PrintRow(part, Part<profiles::Micro>::kBytes, Part<profiles::Edge>::kBytes,
           Part<profiles::Dense>::kBytes);
}

template <class L>
struct ObjectMask {
  static constexpr std::size_t kBytes = sizeof(typename disflow::Segmenter<L>::Mask);
};
template <class L>
struct Segmenter {
  static constexpr std::size_t kBytes = sizeof(disflow::Segmenter<L>);
};
template <class L>
struct Sampler {
  static constexpr std::size_t kBytes = sizeof(disflow::SurfaceSampler<L>);
};
template <class L>
struct Scratch {
  static constexpr std::size_t kBytes =
      sizeof(disflow::StageScratch<disflow::Segmenter<L>, disflow::SurfaceSampler<L>,
                                   disflow::Registration<L>>);
};
template <class L>
struct Samples {
  static constexpr std::size_t kBytes = sizeof(typename disflow::SurfaceSampler<L>::Samples);
};
template <class L>
struct Edges {
  static constexpr std::size_t kBytes = sizeof(typename disflow::Registration<L>::Edges) +
                                        sizeof(disflow::EdgeMap<L::kMaxModelEdges>);
};
template <class L>
struct FreeSpace {
  static constexpr std::size_t kBytes = sizeof(disflow::SeenSpace<L::kMaxSeenViews, L::kSeenCells>);
};
template <class L>
struct Octree {
  static constexpr std::size_t kBytes = sizeof(typename disflow::ClusterStore<L>::Tree);
};
template <class L>
struct Clusters {
  static constexpr std::size_t kBytes = sizeof(typename disflow::ClusterStore<L>::ClusterType) *
                                        static_cast<std::size_t>(L::kMaxClusters);
};
template <class L>
struct Cluster {
  static constexpr std::size_t kBytes = sizeof(typename disflow::ClusterStore<L>::ClusterType);
};
template <class L>
struct Gp {
  static constexpr std::size_t kBytes = sizeof(disflow::GpWorkspace<L::kMaxTrainingSamples>);
};
template <class L>
struct Registration {
  static constexpr std::size_t kBytes = sizeof(disflow::Registration<L>);
};
template <class L>
struct Whole {
  static constexpr std::size_t kBytes = sizeof(disflow::Tracker<L>);
};
template <class L>
struct Surface {
  static constexpr std::size_t kBytes = sizeof(disflow::SurfaceWorkspace<L>);
};

}  // namespace

int main() {
  std::printf("| %-44s | %9s | %9s | %9s |\n", "bytes", "Micro", "Edge", "Dense");
  std::printf("|---|---:|---:|---:|\n");
  PrintPart<ObjectMask>("object mask");
  PrintPart<Scratch>("scratch: segmentation, blocks, registration");
  PrintPart<Samples>("surface samples of the frame");
  PrintPart<FreeSpace>("views of the free space around the object");
  PrintPart<Edges>("occluding edges: frame and model");
  PrintPart<Octree>("octree");
  PrintPart<Clusters>("clusters with their local GPs");
  PrintPart<Gp>("GP training workspace");
  PrintPart<Whole>("**Tracker, all of the above and the rest**");
  PrintPart<Segmenter>("segmentation (is in the scratch)");
  PrintPart<Sampler>("pixel blocks (are in the scratch)");
  PrintPart<Registration>("registration (is in the scratch)");
  PrintPart<Cluster>("one cluster (is in the above)");
  PrintPart<Surface>("workspace for surface extraction (optional)");
  return 0;
}
