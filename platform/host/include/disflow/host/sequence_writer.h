// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <deque>
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
/// .png, data.txt; if given also gt/poses.txt, gt/velocities.txt, infrared/I.png and T_wc.txt.
///
/// T_wc.txt is this project's addition: one line `x y z nx ny nz theta` per frame, camera in world.
/// So is a folder gt/OBJECT for each of several objects, in place of gt alone.
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
  /// A mask of the frame that was added last, as it is.
  [[nodiscard]] hal::Fault AddMask(std::string_view set, const MaskView& mask);
  /// The mask of one of several objects: 255 where mask.label is.
  [[nodiscard]] hal::Fault AddMaskOf(std::string_view object, std::string_view set,
                                     const MaskView& mask);
  /// The infrared image of the frame that was added last, as large as the depth image.
  [[nodiscard]] hal::Fault AddInfrared(const MaskView& image);
  /// Pose and twist of the frame that was added last.
  [[nodiscard]] hal::Fault AddTruth(const RigidState<Camera, Object>& object) {
    return AddTruthOf("", object);
  }
  /// The same of one of several objects.
  [[nodiscard]] hal::Fault AddTruthOf(std::string_view name,
                                      const RigidState<Camera, Object>& object);

  /// Makes sure that all is on disk. No more can be added then.
  [[nodiscard]] hal::Fault Finish();

  [[nodiscard]] int frame_count() const { return frames_; }

 private:
  /// Of one object.
  struct TruthFiles {
    std::string name;
    std::ofstream poses;
    std::ofstream velocities;
  };

  [[nodiscard]] hal::Fault WriteMask(std::string_view object, std::string_view set,
                                     const MaskView& mask);
  [[nodiscard]] hal::Fault WriteImage(const std::filesystem::path& file, const MaskView& image);
  [[nodiscard]] TruthFiles& TruthOf(std::string_view name);
  [[nodiscard]] hal::Fault WriteCamera(const DepthFrame& frame);
  [[nodiscard]] hal::Fault WriteDepth(const DepthView& depth);
  [[nodiscard]] hal::Fault AppendLine(std::ofstream& stream, const std::string& name,
                                      const std::string& line);

  std::filesystem::path dir_;
  std::string object_;
  int frames_ = 0;
  int width_px_ = 0;
  int height_px_ = 0;
  std::vector<float> row_m_;
  std::ofstream data_;
  std::deque<TruthFiles> truths_;
  std::vector<std::uint8_t> mask_;
  std::ofstream world_poses_;
};

}  // namespace disflow::host
