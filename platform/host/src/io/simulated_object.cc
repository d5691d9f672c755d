// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/host/simulated_object.h"

#include <utility>

#include "disflow/host/obj_file.h"
#include "disflow/host/simulation.h"

namespace disflow::host {

namespace {

hal::Fault Load(const SimulatedShape& shape, TriangleMesh& mesh) {
  if (shape.object != ObjectKind::kObjFile) {
    mesh = MakeObjectMesh(shape.object);
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

}  // namespace

hal::Fault LoadSimulatedObject(const SimulationOptions& options, TriangleMesh& mesh) {
  return Load({options.object, options.obj_file}, mesh);
}

hal::Fault LoadSimulatedObjects(const SimulationOptions& options,
                                std::vector<TriangleMesh>& meshes) {
  std::vector<TriangleMesh> read;
  for (const SimulatedShape& shape : ObjectShapes(options)) {
    const hal::Fault fault = Load(shape, read.emplace_back());
    if (!fault.ok()) return fault;
  }
  meshes = std::move(read);
  return {};
}

}  // namespace disflow::host
