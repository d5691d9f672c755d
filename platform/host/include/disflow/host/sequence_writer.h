// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <deque>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "disflow/depth/depth_frame.h"
#include "disflow/hal/fault.h"
#include "disflow/host/line_file.h"
#include "disflow/host/rigid_state.h"

namespace disflow::host {

/// Writes a sequence in the Fast-YCB layout: cam_K.json, depth/I.float, masks/SET/OBJECT_I
/// .png, data.txt; if given also gt/poses.txt, gt/velocities.txt, infrared/I.png and T_wc.txt.
///
/// T_wc.txt is this project's addition: one line `x y z nx ny nz theta` per frame, camera in world,
/// or `none`. It begins with the first frame that has one, with lines for those before.
/// So is a folder gt/OBJECT for each of several objects, in place of gt alone.
///
/// Whatever ends the program, or fills the disk, costs the frame that is being written and no
/// other: a frame's line in data.txt follows when all else of it has been handed to the kernel.
class SequenceWriter {
 public:
  SequenceWriter() = default;
  SequenceWriter(const SequenceWriter&) = delete;
  SequenceWriter& operator=(const SequenceWriter&) = delete;

  /// Creates the folder, or uses an empty one.
  /// @param object Used in the names of the mask files.
  /// @param overwrite A sequence that is already there is removed first, see RemoveSequence().
  /// @return kPermissionDenied, kIoError or kBusy (something is there already; with `overwrite`:
  /// something that is no sequence), naming the folder.
  [[nodiscard]] hal::Fault Open(const std::filesystem::path& dir, std::string_view object,
                                bool overwrite);

  /// Completes the frame before, writes depth and, if given, T_wc. The first frame fixes size and
  /// camera of all. Of what cannot be written nothing is kept, and no more can be added: this and
  /// the functions below then say again what went wrong.
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

  /// Makes the frame that was added last a part of the sequence; nothing can be added to it then.
  /// For frames that come seldom or never again: AddFrame() and Finish() do it as well.
  [[nodiscard]] hal::Fault CompleteFrame();

  /// Completes the last frame and closes all files. No more can be added then.
  [[nodiscard]] hal::Fault Finish();

  /// Frames added, without one that could not be written whole.
  [[nodiscard]] int frame_count() const { return frames_; }
  /// What the images take on the disk; the few lines of text beside them are not counted.
  [[nodiscard]] std::int64_t image_bytes() const { return image_bytes_; }

 private:
  /// Of one object.
  struct TruthFiles {
    std::string name;
    LineFile poses;
    LineFile velocities;
  };

  [[nodiscard]] hal::Fault CheckPending() const;
  /// @return The same, after which nothing more is written.
  [[nodiscard]] hal::Fault GiveUp(const hal::Fault& fault);
  [[nodiscard]] hal::Fault WriteFrame(const DepthFrame& frame);
  [[nodiscard]] hal::Fault WriteWorldPose(const DepthFrame& frame);
  [[nodiscard]] hal::Fault WriteMask(std::string_view object, std::string_view set,
                                     const MaskView& mask);
  [[nodiscard]] hal::Fault WriteImage(const std::filesystem::path& file, const MaskView& image);
  [[nodiscard]] TruthFiles& TruthOf(std::string_view name);
  [[nodiscard]] hal::Fault WriteCamera(const DepthFrame& frame);
  [[nodiscard]] hal::Fault WriteDepth(const DepthView& depth);
  [[nodiscard]] hal::Fault AppendLine(LineFile& file, const std::filesystem::path& name,
                                      std::string_view line);

  std::filesystem::path dir_;
  std::string object_;
  int frames_ = 0;
  std::int64_t image_bytes_ = 0;
  bool pending_ = false;    ///< The last of them is not complete.
  std::string stamp_line_;  ///< Its line of data.txt.
  hal::Fault failure_;
  int width_px_ = 0;
  int height_px_ = 0;
  std::vector<char> depth_bytes_;  ///< Of a whole file.
  LineFile data_;
  std::deque<TruthFiles> truths_;
  std::vector<std::uint8_t> mask_;
  LineFile world_poses_;
};

/// Whether the folder is a sequence as SequenceWriter writes it; also one that has no frame yet.
[[nodiscard]] bool HoldsSequence(const std::filesystem::path& dir);

/// Removes everything that a sequence consists of, and nothing else that may be in its folder.
/// @return kIoError, or kBusy if the folder is no sequence: its gt/ or depth/ is then somebody's.
[[nodiscard]] hal::Fault RemoveSequence(const std::filesystem::path& dir);

}  // namespace disflow::host
