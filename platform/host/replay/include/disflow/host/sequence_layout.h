// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "disflow/geometry/pinhole_camera.h"
#include "disflow/geometry/transform.h"
#include "disflow/hal/fault.h"

namespace disflow::host {

/// What to replay of a folder.
struct ReplayOptions {
  std::string directory;
  std::string mask = "auto";      ///< A set in masks/, "none", or "auto": gt if there, else none.
  double scale_m = 0.001;         ///< Metres per unit of PNG depth.
  bool use_camera_poses = false;  ///< T_wc from pose/*.txt or T_wc.txt.
  int first = 0;                  ///< Frames skipped at the start.
  int count = 0;                  ///< Frames replayed at most; 0 = all.
};

/// One frame of a sequence on disk.
struct SequenceFrame {
  std::string depth_file;
  std::string mask_file;  ///< Empty: none.
  StampNs stamp_ns = 0;
  bool has_T_wc = false;
  Transform<World, Camera> T_wc;
};

/// A sequence as found on disk: the Fast-YCB layout (depth/<i>.float) or a folder of 16-bit PNG
/// images (depth/*.png, masked_depth/*.png or *.png). docs/sequences.md describes both.
struct SequenceLayout {
  std::string directory;
  bool float_depth = false;
  int width_px = 0;  ///< 0: not said by the sequence; the first image tells.
  int height_px = 0;
  PinholeCamera camera;
  std::vector<SequenceFrame> frames;
};

/// Looks at a folder's names, camera, stamps and poses; images are not opened.
/// @return kNotFound, kUnsupported or kCorrupt, naming the file and what it should hold.
[[nodiscard]] hal::Fault FindSequence(const ReplayOptions& options, SequenceLayout& layout);

}  // namespace disflow::host
