// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/host/simulated_object.h"

#include <algorithm>
#include <utility>

#include "disflow/host/mesh_shaping.h"
#include "disflow/host/obj_file.h"
#include "disflow/host/simulated_shapes.h"

namespace disflow::host {

namespace {

/// Refuses options that none of the objects could follow.
hal::Fault CheckFinish(const SimulationOptions& options) {
  const std::vector<SimulatedShape> shapes = ObjectShapes(options);
  const auto any = [&shapes](bool (*has)(ObjectKind)) {
    return std::any_of(shapes.begin(), shapes.end(),
                       [has](const SimulatedShape& shape) { return has(shape.object); });
  };
  if (options.edge_mm > 0.0 && !any(HasRoundedEdges)) {
    return hal::MakeFault(Status::kUnsupported,
                          "edge_mm=%g: only rounded-box and flat-box have edges to round",
                          options.edge_mm);
  }
  if (options.bulge_mm > 0.0 && !any(HasFlatFaces)) {
    return hal::MakeFault(Status::kUnsupported,
                          "bulge_mm=%g: only box, rounded-box and flat-box have faces to bulge",
                          options.bulge_mm);
  }
  return {};
}

hal::Fault LoadDrawn(const SimulatedShape& shape, const SimulationOptions& options,
                     TriangleMesh& mesh) {
  if (shape.object != ObjectKind::kObjFile) {
    mesh = MakeObjectMesh(shape.object, options);
    return {};
  }
  TriangleMesh read;
  const hal::Fault fault = ReadObj(shape.obj_file, read);
  if (!fault.ok()) return fault;
  MoveCentreToOrigin(read);
  constexpr double kMinRadius_m = 0.01;
  constexpr double kMaxRadius_m = 1.0;
  const double radius_m = BoundingRadius(read);
  if (radius_m < kMinRadius_m || radius_m > kMaxRadius_m) {
    return hal::MakeFault(Status::kUnsupported,
                          "%s: is %.4g m across; 0.02 to 2 m are needed (are its units metres?)",
                          shape.obj_file.c_str(), 2.0 * radius_m);
  }
  mesh = std::move(read);
  return {};
}

hal::Fault Load(const SimulatedShape& shape, const SimulationOptions& options, TriangleMesh& mesh) {
  const hal::Fault fault = LoadDrawn(shape, options, mesh);
  if (!fault.ok() || !(options.uneven_mm > 0.0)) return fault;
  Warp(mesh, 1e-3 * options.uneven_mm);
  MoveCentreToOrigin(mesh);
  return {};
}

}  // namespace

hal::Fault LoadSimulatedObject(const SimulationOptions& options, TriangleMesh& mesh) {
  std::vector<TriangleMesh> meshes;
  const hal::Fault fault = LoadSimulatedObjects(options, meshes);
  if (fault.ok()) mesh = std::move(meshes.front());
  return fault;
}

hal::Fault LoadSimulatedObjects(const SimulationOptions& options,
                                std::vector<TriangleMesh>& meshes) {
  const hal::Fault refused = CheckFinish(options);
  if (!refused.ok()) return refused;
  std::vector<TriangleMesh> read;
  for (const SimulatedShape& shape : ObjectShapes(options)) {
    const hal::Fault fault = Load(shape, options, read.emplace_back());
    if (!fault.ok()) return fault;
  }
  meshes = std::move(read);
  return {};
}

}  // namespace disflow::host
