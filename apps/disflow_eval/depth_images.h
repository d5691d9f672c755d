// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <vector>

#include "disflow/depth/depth_frame.h"

namespace disflow::apps {

/// The depth images of a sequence in the Fast-YCB layout, in any order: cam_K.json and
/// depth/<index>.float (u64 width, u64 height, then float32 metres, row-major, little endian).
class DepthImages {
 public:
  /// @throws InputError if cam_K.json is missing or malformed.
  explicit DepthImages(std::filesystem::path sequence_dir);

  /// Whether image `index` exists.
  [[nodiscard]] bool Has(int index) const;

  /// Reads an image. The frame's view stays valid until the next call.
  /// @throws InputError naming the file: missing, truncated, or of another size than cam_K.json
  /// says.
  [[nodiscard]] DepthFrame Load(int index);

 private:
  [[nodiscard]] std::filesystem::path FileOf(int index) const;
  /// Of each image.
  [[nodiscard]] std::size_t Pixels() const {
    return static_cast<std::size_t>(width_px_) * static_cast<std::size_t>(height_px_);
  }

  std::filesystem::path sequence_dir_;
  PinholeCamera camera_;
  int width_px_ = 0;
  int height_px_ = 0;
  std::vector<float> depth_m_;
};

}  // namespace disflow::apps
