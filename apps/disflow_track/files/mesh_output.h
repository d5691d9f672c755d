// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "files/output_file.h"
#include "surface_mesh.h"

namespace disflow::apps {

/// The reconstructed surface at the end of a run: a mesh file and a picture, whichever were asked
/// for.
class MeshOutput {
 public:
  /// Empty paths are not asked for.
  /// @param mesh_path Ends in .obj for Wavefront OBJ; else binary PLY is written.
  /// @throws Failure kOutputFailed.
  MeshOutput(const std::string& mesh_path, const std::string& picture_path);

  [[nodiscard]] bool wanted() const noexcept {
    return mesh_file_.has_value() || picture_file_.has_value();
  }

  /// @return One line per file written.
  /// @throws Failure kOutputFailed; files that existed are then unchanged.
  [[nodiscard]] std::vector<std::string> Write(const SurfaceMesh& mesh);

 private:
  std::string mesh_path_;
  std::string picture_path_;
  std::optional<AtomicFile> mesh_file_;
  std::optional<AtomicFile> picture_file_;
};

}  // namespace disflow::apps
