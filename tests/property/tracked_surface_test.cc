// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <set>
#include <utility>
#include <vector>

#include "disflow/depth/depth_reader.h"
#include "disflow/host/simulated_shapes.h"
#include "disflow/host/simulation.h"
#include "disflow/surface_extractor.h"
#include "disflow/tracker.h"
#include "mesh_collector.h"

namespace disflow::testing {
namespace {

using host::Vec3d;

constexpr SurfaceOptions kOptions{.resolution_m = 0.002F, .support_radius_m = 0.0064F};

/// Counts how often every place of the true surface was in the depth images.
class SeenPlaces {
 public:
  void Add(const DepthFrame& frame, const MaskView& object,
           const Transform<Object, Camera, double>& T_oc) {
    const DepthReader depth(frame.depth, 0.1F, 10.0F);
    for (int v = 0; v < depth.height_px(); v += 2) {
      for (int u = 0; u < depth.width_px(); u += 2) {
        if (object.row(v)[u] == 0) continue;
        const float depth_m = depth.AtOrZero(u, v);
        if (depth_m == 0.0F) continue;
        const Vec3 x_c = depth_m * frame.camera.Ray(static_cast<float>(u), static_cast<float>(v));
        ++hits_[KeyOf(T_oc * x_c.cast<double>())];
      }
    }
  }

  [[nodiscard]] int HitsAt(const Vec3d& x_m) const {
    const auto found = hits_.find(KeyOf(x_m));
    return found == hits_.end() ? 0 : found->second;
  }

 private:
  static constexpr double kPlace_m = 0.004;
  using Key = std::array<int, 3>;
  static Key KeyOf(const Vec3d& x_m) {
    return {static_cast<int>(std::floor(x_m.x() / kPlace_m)),
            static_cast<int>(std::floor(x_m.y() / kPlace_m)),
            static_cast<int>(std::floor(x_m.z() / kPlace_m))};
  }
  std::map<Key, int> hits_;
};

/// A simulated object, tracked with noise; its mesh beside the true surface.
class TrackedSurface : public ::testing::Test {
 protected:
  void Track(host::ObjectKind object, host::MotionKind motion, int frames) {
    host::SimulationOptions options;
    options.object = object;
    options.motion = motion;
    options.noise = host::NoiseKind::kWhite;
    options.mask = host::MaskKind::kGt;
    options.frames = frames;
    host::Simulation simulation(options, host::MakeObjectMesh(object));
    const auto tracker = std::make_unique<Tracker<profiles::Edge>>();
    Transform<Object, Object, double> T_true_from_model;
    for (int i = 0; i < frames; ++i) {
      DepthFrame frame;
      Estimate estimate;
      simulation.Render(i, frame);
      ASSERT_EQ(tracker->Process(frame, estimate), Status::kOk) << i;
      const auto T_oc = simulation.TruthAt(i).object.pose.Inverse();
      if (i == 0) {
        T_true_from_model = Transform<Object, Object, double>(
            T_oc.rotation() * estimate.T_co.rotation().cast<double>(),
            T_oc * estimate.T_co.translation().cast<double>());
      }
      seen.Add(frame, simulation.gt_mask(), T_oc);
    }
    const auto workspace = std::make_unique<SurfaceWorkspace<profiles::Edge>>();
    ASSERT_EQ(ExtractSurface(tracker->field(), kOptions, *workspace, mesh).status, Status::kOk);
    for (const SurfaceVertex& vertex : mesh.vertices)
      vertices_m.push_back(T_true_from_model * vertex.position_m.cast<double>());
    truth_m = host::SampleSurface(simulation.mesh(), kTruePoints);
  }

  /// Distance to the nearest true point for which `counts`.
  template <class Predicate>
  [[nodiscard]] double NearestTrue(const Vec3d& x_m, Predicate&& counts) const {
    double nearest_m2 = 1.0;
    for (const Vec3d& point_m : truth_m) {
      const double squared = (point_m - x_m).squaredNorm();
      if (squared < nearest_m2 && counts(point_m)) nearest_m2 = squared;
    }
    return std::sqrt(nearest_m2);
  }

  /// Vertices at edges of one triangle only.
  [[nodiscard]] std::set<int> BorderVertices() const {
    std::set<std::pair<int, int>> edges;
    for (const auto& triangle : mesh.triangles) {
      for (std::size_t i = 0; i < 3; ++i) edges.insert({triangle[i], triangle[(i + 1) % 3]});
    }
    std::set<int> border;
    for (const auto& [from, to] : edges) {
      if (edges.count({to, from}) == 0) border.insert(from);
    }
    return border;
  }

  /// No vertex lies beyond what was observed, and no edge of the mesh within what was seen well.
  void ExpectOpenExactlyWhereUnseen() const {
    constexpr double kBeyond_m = 0.0095;  // support radius, spacing of the true points, drift
    constexpr double kWithin_m = 0.008;
    for (std::size_t i = 0; i < vertices_m.size(); i += 3) {
      const double nearest_m = NearestTrue(
          vertices_m[i], [this](const Vec3d& point_m) { return seen.HitsAt(point_m) > 0; });
      ASSERT_LT(nearest_m, kBeyond_m) << vertices_m[i].transpose();
    }
    int inside = 0;
    const std::set<int> border = BorderVertices();
    for (const int i : border) {
      constexpr int kWell = 12;
      const double nearest_m =
          NearestTrue(vertices_m[static_cast<std::size_t>(i)],
                      [this](const Vec3d& point_m) { return seen.HitsAt(point_m) < kWell; });
      if (nearest_m > kWithin_m) ++inside;
    }
    // Of the whole mesh, for a mesh that is less open has less border: rounding differs by machine,
    // and a place of a cluster's size may be missing where one was forgotten (docs/results.md).
    EXPECT_LE(1000 * inside, static_cast<int>(vertices_m.size()))
        << inside << " of a border of " << border.size();
  }

  static constexpr int kTruePoints = 12000;
  SeenPlaces seen;
  MeshCollector mesh;
  std::vector<Vec3d> vertices_m;  ///< The mesh's, true object frame.
  std::vector<Vec3d> truth_m;     ///< Spread over the true surface.
};

TEST_F(TrackedSurface, FrontViewOnly_IsAnOpenMeshThatEndsWhereTheViewEnds) {
  Track(host::ObjectKind::kBottle, host::MotionKind::kStatic, 12);
  EXPECT_GT(mesh.triangles.size(), 5000U);
  EXPECT_GT(mesh.CountEdges().open, 100);
  EXPECT_EQ(mesh.CountEdges().ambiguous, 0);
  ExpectOpenExactlyWhereUnseen();
  const auto seen_of_truth =
      std::count_if(truth_m.begin(), truth_m.end(),
                    [this](const Vec3d& point_m) { return seen.HitsAt(point_m) > 0; });
  EXPECT_LT(seen_of_truth, kTruePoints * 6 / 10) << "a front view is to be tested";
}

TEST_F(TrackedSurface, FullTurn_IsClosedWhereItWasSeen) {
  Track(host::ObjectKind::kBottle, host::MotionKind::kRotate360, 120);
  EXPECT_EQ(mesh.CountEdges().ambiguous, 0);
  ExpectOpenExactlyWhereUnseen();
}

}  // namespace
}  // namespace disflow::testing
