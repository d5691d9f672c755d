// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "disflow/host/simulated_shapes.h"
#include "disflow/host/simulation.h"

namespace disflow::test {

/// Images of the simulated camera, rendered beforehand, so that a replay does nothing but track.
class RecordedSimulation {
 public:
  explicit RecordedSimulation(const host::SimulationOptions& options) {
    host::Simulation simulation(options, host::MakeObjectMesh(options.object));
    for (int i = 0; i < options.frames; ++i) {
      DepthFrame frame;
      simulation.Render(i, frame);
      if (!simulation.IsDropped(i)) images_.push_back(Image::CopyOf(frame, simulation.TruthAt(i)));
    }
  }

  [[nodiscard]] int size() const { return static_cast<int>(images_.size()); }
  [[nodiscard]] const host::FrameTruth& truth(int index) const { return At(index).truth; }
  /// Its views stay valid as long as this object.
  [[nodiscard]] DepthFrame frame(int index) const {
    DepthFrame frame = At(index).frame;
    frame.depth.data = At(index).depth.data();
    if (frame.mask.given()) frame.mask.data = At(index).mask.data();
    return frame;
  }

 private:
  struct Image {
    DepthFrame frame;
    host::FrameTruth truth;
    std::vector<std::byte> depth;
    std::vector<std::uint8_t> mask;

    static Image CopyOf(const DepthFrame& frame, const host::FrameTruth& truth) {
      Image image{frame, truth, {}, {}};
      const int row_bytes = frame.depth.width_px * frame.depth.bytes_per_pixel();
      for (int v = 0; v < frame.depth.height_px; ++v) {
        image.depth.insert(image.depth.end(), frame.depth.row(v), frame.depth.row(v) + row_bytes);
        if (!frame.mask.given()) continue;
        image.mask.insert(image.mask.end(), frame.mask.row(v),
                          frame.mask.row(v) + frame.mask.width_px);
      }
      image.frame.depth.stride_bytes = row_bytes;
      image.frame.mask.stride_bytes = frame.mask.width_px;
      return image;
    }
  };

  [[nodiscard]] const Image& At(int index) const {
    return images_.at(static_cast<std::size_t>(index));
  }

  std::vector<Image> images_;
};

}  // namespace disflow::test
