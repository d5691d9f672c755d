// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/host/obj_file.h"

#include <tiny_obj_loader.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <sstream>
#include <string>
#include <utility>

#include "disflow/host/obj_text.h"

namespace disflow::host {

namespace fs = std::filesystem;

hal::Fault ReadObj(const fs::path& file, TriangleMesh& mesh) {
  std::string text;
  const hal::Fault fault = ReadObjText(file, text);
  if (!fault.ok()) return fault;
  std::istringstream stream(std::move(text));
  tinyobj::attrib_t attributes;
  std::vector<tinyobj::shape_t> shapes;
  std::vector<tinyobj::material_t> materials;
  std::string warning;
  std::string error;
  if (!tinyobj::LoadObj(&attributes, &shapes, &materials, &warning, &error, &stream, nullptr)) {
    return hal::MakeFault(Status::kCorrupt, "%s: %s", file.c_str(), error.c_str());
  }
  TriangleMesh read;
  for (std::size_t i = 0; i + 2 < attributes.vertices.size(); i += 3) {
    read.vertices.emplace_back(attributes.vertices[i], attributes.vertices[i + 1],
                               attributes.vertices[i + 2]);
    if (!read.vertices.back().allFinite()) {
      return hal::MakeFault(Status::kCorrupt, "%s: vertex %zu is not finite", file.c_str(),
                            i / 3 + 1);
    }
  }
  for (const tinyobj::shape_t& shape : shapes) {
    const auto& indices = shape.mesh.indices;
    for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
      TriangleMesh::Triangle triangle{};
      for (std::size_t corner = 0; corner < 3; ++corner) {
        const int index = indices[i + corner].vertex_index;
        if (index < 0 || static_cast<std::size_t>(index) >= read.vertices.size()) {
          return hal::MakeFault(Status::kCorrupt, "%s: face %zu refers to vertex %d of %zu",
                                file.c_str(), i / 3 + 1, index + 1, read.vertices.size());
        }
        triangle[corner] = static_cast<std::uint32_t>(index);
      }
      read.triangles.push_back(triangle);
    }
  }
  if (read.triangles.empty()) {
    return hal::MakeFault(Status::kCorrupt, "%s: holds no triangles", file.c_str());
  }
  mesh = std::move(read);
  return {};
}

hal::Fault WriteObj(const fs::path& file, const TriangleMesh& mesh) {
  std::ofstream stream(file, std::ios::binary);
  std::array<char, 128> line{};
  for (const Vec3d& v : mesh.vertices) {
    (void)std::snprintf(line.data(), line.size(), "v %.9g %.9g %.9g\n", v.x(), v.y(), v.z());
    stream << line.data();
  }
  for (const TriangleMesh::Triangle& t : mesh.triangles) {
    stream << "f " << t[0] + 1 << ' ' << t[1] + 1 << ' ' << t[2] + 1 << '\n';
  }
  stream.close();
  if (stream) return {};
  return hal::MakeFault(Status::kIoError, "%s: cannot be written: %s", file.c_str(),
                        std::strerror(errno));
}

}  // namespace disflow::host
