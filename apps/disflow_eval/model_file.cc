// SPDX-License-Identifier: BSD-3-Clause
#include "model_file.h"

#include <tiny_obj_loader.h>

#include <sstream>
#include <string>
#include <utility>

#include "disflow/host/obj_text.h"
#include "errors.h"
#include "text_file.h"

namespace disflow::apps {
namespace {

namespace fs = std::filesystem;

/// Coordinates of entry `index` in one of tinyobjloader's flat lists.
/// @throws InputError if the index points nowhere: the loader does not check it.
Vec3d Entry(const fs::path& file, const std::vector<tinyobj::real_t>& values, int index,
            const char* what) {
  const auto at = 3 * static_cast<std::size_t>(index);
  if (index < 0 || at + 2 >= values.size()) {
    throw InputError(file, "a face refers to " + std::string(what) + " " +
                               std::to_string(index + 1) + ", the file holds " +
                               std::to_string(values.size() / 3));
  }
  Vec3d entry(static_cast<double>(values[at]), static_cast<double>(values[at + 1]),
              static_cast<double>(values[at + 2]));
  if (!entry.allFinite()) {
    throw InputError(file, std::string(what) + " " + std::to_string(index + 1) + " is not finite");
  }
  return entry;
}

bool HasAllNormals(const std::vector<tinyobj::shape_t>& shapes) {
  for (const tinyobj::shape_t& shape : shapes) {
    for (const tinyobj::index_t& corner : shape.mesh.indices) {
      if (corner.normal_index < 0) return false;
    }
  }
  return true;
}

/// Every corner becomes a vertex of its own, since OBJ gives normals per corner.
Surface FromFaces(const fs::path& file, const tinyobj::attrib_t& attributes,
                  const std::vector<tinyobj::shape_t>& shapes) {
  Surface surface;
  const bool with_normals = HasAllNormals(shapes);
  for (const tinyobj::shape_t& shape : shapes) {
    const auto& corners = shape.mesh.indices;
    for (std::size_t i = 0; i + 2 < corners.size(); i += 3) {
      const auto first = static_cast<std::uint32_t>(surface.vertices.size());
      surface.triangles.push_back({first, first + 1, first + 2});
      for (std::size_t j = i; j < i + 3; ++j) {
        surface.vertices.push_back(
            Entry(file, attributes.vertices, corners[j].vertex_index, "vertex"));
        if (!with_normals) continue;
        const Vec3d normal = Entry(file, attributes.normals, corners[j].normal_index, "normal");
        surface.normals.push_back(normal.normalized());
      }
    }
  }
  return surface;
}

Surface LoadObj(const fs::path& file) {
  std::string text;
  const hal::Fault fault = host::ReadObjText(file, text);
  if (!fault.ok()) throw InputError(fault.message);
  std::istringstream stream(std::move(text));
  tinyobj::attrib_t attributes;
  std::vector<tinyobj::shape_t> shapes;
  std::vector<tinyobj::material_t> materials;
  std::string warning;
  std::string error;
  if (!tinyobj::LoadObj(&attributes, &shapes, &materials, &warning, &error, &stream)) {
    throw InputError(file, "is no readable OBJ: " + error);
  }
  Surface surface = FromFaces(file, attributes, shapes);
  if (surface.is_mesh()) return surface;
  for (std::size_t i = 0; i < attributes.vertices.size() / 3; ++i) {
    surface.vertices.push_back(Entry(file, attributes.vertices, static_cast<int>(i), "vertex"));
  }
  return surface;
}

Surface LoadXyz(const fs::path& file) {
  const std::string text = ReadFile(file);
  Surface surface;
  std::size_t width = 0;
  LineReader lines(text);
  for (Line line; lines.Next(line);) {
    if (line.text.front() == '#') continue;
    if (width == 0) width = SplitAtSpaces(line.text).size() == 6 ? 6 : 3;
    const std::vector<double> n = ParseNumbers(file, line, width);
    surface.vertices.emplace_back(n[0], n[1], n[2]);
    if (width == 6) surface.normals.push_back(Vec3d(n[3], n[4], n[5]).normalized());
  }
  return surface;
}

}  // namespace

Surface LoadModel(const fs::path& file) {
  const std::string extension = file.extension().string();
  if (extension != ".obj" && extension != ".xyz") {
    throw InputError(file, "has the extension '" + extension + "'; .obj or .xyz is needed");
  }
  Surface surface = extension == ".obj" ? LoadObj(file) : LoadXyz(file);
  if (surface.vertices.empty()) throw InputError(file, "holds no points");
  return surface;
}

}  // namespace disflow::apps
