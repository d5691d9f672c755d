// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

#include "disflow/depth/depth_frame.h"
#include "disflow/hal/fault.h"
#include "disflow/host/rigid_state.h"

namespace disflow::host {

/// Writes a sequence in the Fast-YCB layout: cam_K.json, depth/I.float, masks/SET/OBJECT_I
/// .png, data.txt; if given also gt/poses.txt, gt/velocities.txt and T_wc.txt.
///
/// T_wc.txt is this project's addition: one line `x y z nx ny nz theta` per frame, camera in world.
class SequenceWriter {
 public:
  SequenceWriter() = default;

  /// Creates the folder, or uses an empty one.
  /// @param object Used in the names of the mask files.
  /// @param overwrite A sequence that is already there is removed first; other files stay.
  /// @return kPermissionDenied, kIoError or kBusy (something is there already), naming the folder.
  [[nodiscard]] hal::Fault Open(const std::filesystem::path& dir, std::string_view object,
                                bool overwrite);

  /// Writes depth, stamp and, if given, T_wc. The first frame fixes size and camera of all.
  [[nodiscard]] hal::Fault AddFrame(const DepthFrame& frame);
  /// A mask of the frame that was added last.
  [[nodiscard]] hal::Fault AddMask(std::string_view set, const MaskView& mask);
  /// Pose and twist of the frame that was added last.
  [[nodiscard]] hal::Fault AddTruth(const RigidState<Camera, Object>& object);

  /// Makes sure that all is on disk. No more can be added then.
  [[nodiscard]] hal::Fault Finish();

  [[nodiscard]] int frame_count() const { return frames_; }

 private:
  [[nodiscard]] hal::Fault WriteCamera(const DepthFrame& frame);
  [[nodiscard]] hal::Fault WriteDepth(const DepthView& depth);
  [[nodiscard]] hal::Fault AppendLine(std::ofstream& stream, const char* name,
                                      const std::string& line);

  std::filesystem::path dir_;
  std::string object_;
  int frames_ = 0;
  int width_px_ = 0;
  int height_px_ = 0;
  std::vector<float> row_m_;
  std::ofstream data_;
  std::ofstream poses_;
  std::ofstream velocities_;
  std::ofstream world_poses_;
};

}  // namespace disflow::host
