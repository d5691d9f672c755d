// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <ostream>
#include <utility>
#include <vector>

#include "disflow/host/object_meshes.h"
#include "disflow/host/simulated_shapes.h"
#include "disflow/host/simulation.h"

namespace disflow::host {
namespace {

/// What may stand on a table.
struct Thing {
  const char* name;
  ObjectKind kind;
  TriangleMesh (*mesh)();
};

void PrintTo(const Thing& thing, std::ostream* stream) { *stream << thing.name; }

template <ObjectKind kKind>
TriangleMesh Drawn() {
  return MakeObjectMesh(kKind);
}

/// A tall box whose longest side lies along another axis, as in files of scanned things.
template <int kLongest>
TriangleMesh Turned() {
  TriangleMesh mesh = MakeCrackerBox();
  for (Vec3d& x_m : mesh.vertices)
    x_m = kLongest == 0 ? Vec3d(x_m.z(), x_m.x(), x_m.y()) : Vec3d(x_m.y(), x_m.z(), x_m.x());
  return mesh;
}

constexpr Thing kThings[] = {
    {"Box", ObjectKind::kBox, Drawn<ObjectKind::kBox>},
    {"Bottle", ObjectKind::kBottle, Drawn<ObjectKind::kBottle>},
    {"Can", ObjectKind::kCan, Drawn<ObjectKind::kCan>},
    {"Doughnut", ObjectKind::kDoughnut, Drawn<ObjectKind::kDoughnut>},
    {"RoundedBox", ObjectKind::kRoundedBox, Drawn<ObjectKind::kRoundedBox>},
    {"FlatBox", ObjectKind::kFlatBox, Drawn<ObjectKind::kFlatBox>},
    {"Mug", ObjectKind::kMug, Drawn<ObjectKind::kMug>},
    {"FileAlongX", ObjectKind::kObjFile, Turned<0>},
    {"FileAlongY", ObjectKind::kObjFile, Turned<1>},
    {"FileAlongZ", ObjectKind::kObjFile, Drawn<ObjectKind::kBox>},
};

class ThingOnTable : public ::testing::TestWithParam<Thing> {
 protected:
  [[nodiscard]] static SimulationOptions Options(std::uint64_t seed, CameraKind camera) {
    SimulationOptions options;
    options.object = GetParam().kind;
    options.camera = camera;
    options.seed = seed;
    options.frames = 30;  // until it is lifted off
    options.width_px = 320;
    options.height_px = 180;
    return options;
  }
  [[nodiscard]] static std::ptrdiff_t Covered(const MaskView& mask) {
    const std::uint8_t* pixels = mask.row(0);
    return std::count_if(pixels, pixels + mask.width_px * mask.height_px,
                         [](std::uint8_t pixel) { return pixel != 0; });
  }
};

/// A plane that does not go through the camera: normal_per_m . x = 1.
struct SeenPlane {
  Vec3d normal_per_m = Vec3d::Zero();
  int pixels = 0;

  /// Towards the camera.
  [[nodiscard]] Vec3d up() const { return -normal_per_m.normalized(); }
  [[nodiscard]] double HeightOf(const Vec3d& x_m) const {
    return (1.0 - normal_per_m.dot(x_m)) / normal_per_m.norm();
  }
};

/// Fitted to what is nearer than without the table and not the object.
SeenPlane SeenTable(const Simulation& with, const DepthFrame& with_table,
                    const DepthFrame& without) {
  Mat3d products = Mat3d::Zero();
  Vec3d sums = Vec3d::Zero();
  SeenPlane plane;
  for (int v = 0; v < without.depth.height_px; ++v) {
    const auto* table_m = reinterpret_cast<const float*>(with_table.depth.row(v));
    const auto* free_m = reinterpret_cast<const float*>(without.depth.row(v));
    for (int u = 0; u < without.depth.width_px; ++u) {
      if (with.gt_mask().row(v)[u] != 0 || !(table_m[u] < free_m[u] - 0.005F)) continue;
      const Vec3d ray =
          with.camera().Ray(static_cast<float>(u), static_cast<float>(v)).cast<double>();
      products += ray * ray.transpose();
      sums += ray / static_cast<double>(table_m[u]);
      ++plane.pixels;
    }
  }
  plane.normal_per_m = products.ldlt().solve(sums);
  return plane;
}

TEST_P(ThingOnTable, StandsOnItWholeBeneathTheCamera) {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    SimulationOptions options = Options(seed, seed % 2 ? CameraKind::kStatic : CameraKind::kMoving);
    Simulation without(options, GetParam().mesh());
    options.support = SupportKind::kTable;
    Simulation with(options, GetParam().mesh());
    for (const int index : {0, 14, 28}) {
      DepthFrame free;
      DepthFrame standing;
      without.Render(index, free);
      with.Render(index, standing);
      const SeenPlane table = SeenTable(with, standing, free);
      EXPECT_GT(table.pixels, 2000);
      EXPECT_LT(table.up().y(), -0.5) << "seed " << seed << ", image " << index;
      double lowest_m = std::numeric_limits<double>::max();
      for (const Vec3d& x_o : with.mesh().vertices)
        lowest_m = std::min(lowest_m, table.HeightOf(with.TruthAt(index).object.pose * x_o));
      EXPECT_NEAR(lowest_m, 0.0, 0.001) << "seed " << seed << ", image " << index;
      EXPECT_GT(Covered(with.gt_mask()), 500);
      EXPECT_GE(static_cast<double>(Covered(with.gt_mask())),
                0.99 * static_cast<double>(Covered(without.gt_mask())));
    }
  }
}

TEST_P(ThingOnTable, StandsAlongOneOfItsAxes) {
  SimulationOptions options = Options(3, CameraKind::kStatic);
  Simulation without(options, GetParam().mesh());
  options.support = SupportKind::kTable;
  Simulation with(options, GetParam().mesh());
  DepthFrame free;
  DepthFrame standing;
  without.Render(0, free);
  with.Render(0, standing);
  const Vec3d up_o =
      with.TruthAt(0).object.pose.rotation().transpose() * SeenTable(with, standing, free).up();
  EXPECT_GT(up_o.cwiseAbs().maxCoeff(), 0.9999);
}

INSTANTIATE_TEST_SUITE_P(Host, ThingOnTable, ::testing::ValuesIn(kThings),
                         [](const ::testing::TestParamInfo<Thing>& test) {
                           return test.param.name;
                         });

}  // namespace
}  // namespace disflow::host
