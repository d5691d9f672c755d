// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "disflow/depth/depth_frame.h"
#include "disflow/hal/fault.h"
#include "disflow/host/simulation.h"

namespace disflow::host {

/// Writes a sequence in the Fast-YCB layout: cam_K.json, data.txt, depth/<i>.float,
/// masks/<set>/<object>_<i>.png, and with ground truth gt/poses.txt, gt/velocities.txt. T_wc.txt if
/// the frames carry the camera's pose.
class SequenceWriter {
 public:
  SequenceWriter() = default;
  SequenceWriter(const SequenceWriter&) = delete;
  SequenceWriter& operator=(const SequenceWriter&) = delete;

  /// @param directory Made if need be. Refused if it holds anything, unless `overwrite`.
  [[nodiscard]] hal::Fault Open(const std::string& directory, const std::string& object_name,
                                bool overwrite);
  /// Appends a frame. Its mask, if given, goes to masks/gt.
  [[nodiscard]] hal::Fault Write(const DepthFrame& frame);
  /// Adds a mask of another set to the frame written last.
  [[nodiscard]] hal::Fault WriteMask(const std::string& set, const MaskView& mask);
  /// Adds ground truth to the frame written last.
  [[nodiscard]] hal::Fault WriteTruth(const FrameTruth& truth);
  /// Closes all files. @return kIoError if anything could not be written.
  [[nodiscard]] hal::Fault Close();

  [[nodiscard]] int frames() const { return frames_; }

 private:
  struct CloseFile {
    void operator()(std::FILE* file) const { (void)std::fclose(file); }
  };
  using File = std::unique_ptr<std::FILE, CloseFile>;

  [[nodiscard]] hal::Fault WriteCamera(const DepthFrame& frame);
  [[nodiscard]] hal::Fault WriteDepth(const DepthView& depth);
  [[nodiscard]] hal::Fault Append(File& file, const char* name, const std::string& line);
  [[nodiscard]] hal::Fault Finish(File& file, const char* name);

  std::string directory_;
  std::string object_name_;
  File data_;
  File poses_;
  File velocities_;
  File camera_poses_;
  std::vector<float> depth_m_;
  std::vector<std::uint8_t> mask_;
  int frames_ = 0;
};

}  // namespace disflow::host
