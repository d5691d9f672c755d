// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "camera_file.h"
#include "disflow/geometry/transform.h"
#include "disflow/host/replay_options.h"
#include "disflow/types.h"

namespace disflow::host {

enum class SequenceLayout : std::uint8_t {
  kImages,  ///< The Fast-YCB layout, or a folder of images.
  kTum,     ///< TUM RGB-D: depth.txt.
  kBop,     ///< BOP: scene_camera.json.
};

/// One image of a recorded sequence.
struct RecordedFrame {
  std::uint64_t number = 0;  ///< In the names of its files.
  /// May not exist, if the sequence lists it all the same. A path would take four times the memory.
  std::string depth;
  /// One per object, in the order of their labels; empty = this image has none.
  std::vector<std::filesystem::path> masks;
  StampNs stamp_ns = 0;
  std::optional<PinholeCamera> camera;  ///< Of this image, if each has its own.
  float unit_m = 0.001F;                ///< Of a 16-bit image, if the options do not say it.
  bool has_T_wc = false;
  Transform<World, Camera> T_wc;
};

/// What a folder holds, found out without reading the images.
struct SequenceIndex {
  SequenceLayout layout = SequenceLayout::kImages;
  CameraDescription camera;
  bool float_depth = false;           ///< Fast-YCB's .float files; else 16-bit PNG.
  int masked_objects = 0;             ///< 0: there are no masks.
  std::vector<RecordedFrame> frames;  ///< Never empty after success.
  /// Frames at the end that are not whole and left out, since the recording was cut short.
  std::size_t cut_frames = 0;
  std::string cut_note;  ///< Says so and why; empty if nothing is left out.
};

/// When the k-th image was taken, if each second saw as many.
[[nodiscard]] StampNs StampAtRate(std::uint64_t k, double rate_hz);

/// Stamps are never invented: a sequence without any needs a rate, one with stamps has no use for
/// it.
/// @param stamps The file that holds them; null if there is none.
[[nodiscard]] hal::Fault CheckRate(const ReplayOptions& options, const char* stamps);

/// Detects the layout and lists the images. Checks all of the small files.
/// @return kNotFound, kCorrupt, kUnsupported, kInvalidIntrinsics ..., naming file, reason and
/// remedy.
[[nodiscard]] hal::Fault IndexSequence(const ReplayOptions& options, SequenceIndex& index);

}  // namespace disflow::host
