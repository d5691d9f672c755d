// SPDX-License-Identifier: BSD-3-Clause
#include "files/mesh_output.h"

#include <algorithm>
#include <filesystem>

#include "disflow/host/mesh_picture.h"
#include "disflow/host/png_image.h"
#include "program/exit_status.h"

namespace disflow::apps {
namespace {

constexpr int kViewWidth_px = 310;
constexpr int kViewHeight_px = 380;

struct Picture {
  int width_px = 0;
  std::vector<std::uint8_t> rgb;
};

/// Puts a view to the right of those that are there.
void Append(const std::vector<std::uint8_t>& view, Picture& picture) {
  const int width_px = picture.width_px + kViewWidth_px;
  std::vector<std::uint8_t> wider;
  wider.reserve(std::size_t{3} * static_cast<std::size_t>(width_px * kViewHeight_px));
  const auto append_row = [&wider](const std::vector<std::uint8_t>& rgb, int row, int row_px) {
    const auto begin = rgb.begin() + std::ptrdiff_t{3} * row * row_px;
    wider.insert(wider.end(), begin, begin + std::ptrdiff_t{3} * row_px);
  };
  for (int row = 0; row < kViewHeight_px; ++row) {
    append_row(picture.rgb, row, picture.width_px);
    append_row(view, row, kViewWidth_px);
  }
  picture = {width_px, std::move(wider)};
}

/// From the first camera, from the right, from behind and from above.
std::string DrawPicture(const SurfaceMesh& surface) {
  host::TriangleMesh mesh;
  for (const SurfaceVertex& vertex : surface.vertices())
    mesh.vertices.push_back(vertex.position_m.cast<double>());
  mesh.triangles = surface.triangles();
  const std::vector<Colour> colours = surface.Colours();
  constexpr double kQuarter_rad = 1.5707963267948966;
  Picture picture;
  for (const auto& [azimuth_rad, elevation_rad] :
       {std::pair{0.0, 0.0}, {kQuarter_rad, 0.3}, {2.0 * kQuarter_rad, 0.0}, {0.5, kQuarter_rad}}) {
    Append(host::RenderMesh(mesh, colours,
                            {azimuth_rad, elevation_rad, kViewWidth_px, kViewHeight_px}),
           picture);
  }
  return host::EncodeRgbPng(picture.rgb, picture.width_px, kViewHeight_px);
}

}  // namespace

MeshOutput::MeshOutput(const std::string& mesh_path, const std::string& picture_path)
    : mesh_path_(mesh_path), picture_path_(picture_path) {
  if (!mesh_path.empty()) mesh_file_.emplace(mesh_path);
  if (!picture_path.empty()) picture_file_.emplace(picture_path);
}

std::vector<std::string> MeshOutput::Write(const SurfaceMesh& mesh) {
  if (mesh.triangles().empty()) {
    throw Failure(kOutputFailed, (mesh_file_ ? mesh_path_ : picture_path_) +
                                     ": not written, no surface was reconstructed");
  }
  std::vector<std::string> written;
  if (mesh_file_) {
    const bool is_obj = std::filesystem::path(mesh_path_).extension() == ".obj";
    mesh_file_->Commit(is_obj ? mesh.FormatObj() : mesh.FormatPly());
    written.push_back(mesh_path_ + ": " + std::to_string(mesh.vertices().size()) + " vertices, " +
                      std::to_string(mesh.triangles().size()) + " triangles");
  }
  if (picture_file_) {
    picture_file_->Commit(DrawPicture(mesh));
    written.push_back(picture_path_ + ": picture of the surface");
  }
  return written;
}

}  // namespace disflow::apps
