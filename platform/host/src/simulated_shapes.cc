// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/host/simulated_shapes.h"

#include "disflow/host/mesh_shaping.h"
#include "disflow/host/object_meshes.h"

namespace disflow::host {
namespace {

constexpr double kMmToM = 1e-3;

double DrawnEdgeRadius(ObjectKind object) {
  if (object == ObjectKind::kRoundedBox) return kRoundedBoxEdge_m;
  return object == ObjectKind::kFlatBox ? kFlatBoxEdge_m : 0.0;
}

}  // namespace

TriangleMesh MakeObjectMesh(ObjectKind object) { return MakeObjectMesh(object, {}); }

TriangleMesh MakeObjectMesh(ObjectKind object, const SimulationOptions& options) {
  const double edge_m = options.edge_mm > 0.0 ? kMmToM * options.edge_mm : DrawnEdgeRadius(object);
  const auto bulged = [&](TriangleMesh mesh, double edge_radius_m) {
    if (options.bulge_mm > 0.0) BulgeFaces(mesh, edge_radius_m, kMmToM * options.bulge_mm);
    return mesh;
  };
  switch (object) {
    case ObjectKind::kBox:
      return bulged(MakeCrackerBox(), 0.0);
    case ObjectKind::kBottle:
      return MakeMustardBottle();
    case ObjectKind::kCan:
      return MakeCan();
    case ObjectKind::kDoughnut:
      return MakeDoughnut();
    case ObjectKind::kRoundedBox:
      return bulged(MakeRoundedBox(edge_m), edge_m);
    case ObjectKind::kFlatBox:
      return bulged(MakeFlatBox(edge_m), edge_m);
    case ObjectKind::kMug:
      return MakeMug();
    case ObjectKind::kBowl:
      return MakeBowl();
    case ObjectKind::kTube:
      return MakeTube();
    case ObjectKind::kSuperellipsoid:
      return MakeSuperellipsoid();
    case ObjectKind::kScrewdriver:
      return MakeScrewdriver();
    case ObjectKind::kBracket:
      return MakeBracket();
    case ObjectKind::kSprayBottle:
      return MakeSprayBottle();
    case ObjectKind::kObjFile:
      break;
  }
  return {};
}

bool HasRoundedEdges(ObjectKind object) { return DrawnEdgeRadius(object) > 0.0; }

bool HasFlatFaces(ObjectKind object) {
  return object == ObjectKind::kBox || HasRoundedEdges(object);
}

}  // namespace disflow::host
