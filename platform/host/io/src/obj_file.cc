// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/host/obj_file.h"

#include <tiny_obj_loader.h>

#include <cstdio>
#include <filesystem>
#include <fstream>

namespace disflow::host {

hal::Fault ReadObj(const std::string& file, TriangleMesh& mesh) {
  mesh = {};
  if (!std::filesystem::is_regular_file(file)) {
    return hal::MakeFault(Status::kNotFound, "%s: no such file", file.c_str());
  }
  tinyobj::ObjReader reader;
  if (!reader.ParseFromFile(file) || !reader.Valid()) {
    return hal::MakeFault(Status::kCorrupt, "%s: %s", file.c_str(), reader.Error().c_str());
  }
  const auto& values = reader.GetAttrib().vertices;
  for (std::size_t i = 0; i + 2 < values.size(); i += 3) {
    mesh.vertices.emplace_back(static_cast<double>(values[i]), static_cast<double>(values[i + 1]),
                               static_cast<double>(values[i + 2]));
  }
  for (const auto& shape : reader.GetShapes()) {
    const auto& corners = shape.mesh.indices;
    for (std::size_t i = 0; i + 2 < corners.size(); i += 3) {
      TriangleMesh::Triangle triangle{};
      for (std::size_t k = 0; k < 3; ++k) {
        const int index = corners[i + k].vertex_index;
        if (index < 0 || static_cast<std::size_t>(index) >= mesh.vertices.size()) {
          return hal::MakeFault(Status::kCorrupt, "%s: a face names a vertex that does not exist",
                                file.c_str());
        }
        triangle[k] = static_cast<std::uint32_t>(index);
      }
      mesh.triangles.push_back(triangle);
    }
  }
  for (const Vec3d& vertex : mesh.vertices) {
    if (!vertex.allFinite())
      return hal::MakeFault(Status::kCorrupt, "%s: a vertex is not finite", file.c_str());
  }
  if (mesh.triangles.empty())
    return hal::MakeFault(Status::kCorrupt, "%s: holds no faces", file.c_str());
  return {};
}

hal::Fault WriteObj(const std::string& file, const TriangleMesh& mesh) {
  std::ofstream stream(file);
  char line[96];
  for (const Vec3d& v : mesh.vertices) {
    (void)std::snprintf(line, sizeof line, "v %.7g %.7g %.7g\n", v.x(), v.y(), v.z());
    stream << line;
  }
  for (const auto& t : mesh.triangles)
    stream << "f " << t[0] + 1 << ' ' << t[1] + 1 << ' ' << t[2] + 1 << '\n';
  stream.close();
  if (!stream) return hal::MakeFault(Status::kIoError, "%s: cannot be written", file.c_str());
  return {};
}

}  // namespace disflow::host
