// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/depth/edge_sampler.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <memory>
#include <random>
#include <vector>

#include "disflow/depth/eroded_mask.h"
#include "disflow/depth/pixel_mask.h"
#include "disflow/depth/whole_windows_impl.h"
#include "disflow/limits.h"

namespace disflow::testing {
namespace {

constexpr int kWidth_px = 240;
constexpr int kHeight_px = 180;
const PinholeCamera kCamera{220.0F, 220.0F, 119.5F, 89.5F};
constexpr float kWall_m = 1.5F;
constexpr float kLeastStd_px = 0.3F;
constexpr float kMostNoise_m = 0.05F;  // Nearer to the plate than anything else in the scenes.

[[nodiscard]] float PixelWidth(const EdgePoint& edge) {
  return edge.position_m.z() / kCamera.fx_px;
}

/// A flat rectangle somewhere in front of the camera: its outline is known exactly.
struct Plate {
  Vec3 center_m;
  Mat3 rotation;  ///< Columns: along its sides, and its normal.
  Vec2 half_m;

  /// @return Depth of the plate's plane along a ray with z = 1.
  [[nodiscard]] float PlaneAlong(const Vec3& ray) const {
    const Vec3 normal = rotation.col(2);
    return normal.dot(center_m) / normal.dot(ray);
  }
  /// @return The same; 0 if the ray passes the plate by.
  [[nodiscard]] float DepthAlong(const Vec3& ray) const {
    const float depth_m = PlaneAlong(ray);
    const Vec2 place_m = PlaceOf(Vec3(depth_m * ray));
    return (place_m.cwiseAbs().array() <= half_m.array()).all() ? depth_m : 0.0F;
  }
  [[nodiscard]] Vec2 PlaceOf(const Vec3& x_c) const {
    return (rotation.transpose() * (x_c - center_m)).head<2>();
  }
  /// How far a point of the plane is from the outline; inside negative.
  [[nodiscard]] float BeyondOutline(const Vec3& x_c) const {
    const Vec2 beyond = PlaceOf(x_c).cwiseAbs() - half_m;
    return beyond.maxCoeff() > 0.0F ? beyond.cwiseMax(0.0F).norm() : beyond.maxCoeff();
  }
};

Plate TurnedPlate(const Vec3& turn_rad) {
  return {Vec3(0.01F, -0.005F, 0.6F), ExpSo3(turn_rad), Vec2(0.11F, 0.08F)};
}

/// A plate that stands before a wall, as a depth image, and the edges found in it.
class Scene {
 public:
  using Sampler = SurfaceSampler<profiles::Micro>;
  using Edges = EdgeSampler<profiles::Micro>::Edges;

  explicit Scene(const Plate& plate, float wall_m = kWall_m)
      : plate_(plate), depth_m_(static_cast<std::size_t>(kWidth_px * kHeight_px), wall_m) {
    mask_->Start(kWidth_px, kHeight_px);
    for (int v = 0; v < kHeight_px; ++v) {
      for (int u = 0; u < kWidth_px; ++u) {
        const float depth_m = plate_.DepthAlong(Ray(u, v));
        if (depth_m > 0.0F) At(u, v) = depth_m;
      }
    }
  }
  /// Something else in the columns [u_begin, u_end).
  void Put(int u_begin, int u_end, float depth_m) {
    for (int v = 0; v < kHeight_px; ++v) {
      for (int u = u_begin; u < u_end; ++u) At(u, v) = depth_m;
    }
  }
  /// A user's mask that shows the plate exactly.
  void GiveMask() {
    exact_.assign(depth_m_.size(), 0);
    for (int v = 0; v < kHeight_px; ++v) {
      for (int u = 0; u < kWidth_px; ++u)
        exact_[static_cast<std::size_t>(v * kWidth_px + u)] = plate_.DepthAlong(Ray(u, v)) > 0.0F;
    }
    given_ = {exact_.data(), kWidth_px, kHeight_px, kWidth_px};
  }
  /// The mask does not show the columns [u_begin, u_end).
  void CutMask(int u_begin, int u_end) {
    for (int v = 0; v < kHeight_px; ++v) {
      for (int u = u_begin; u < u_end; ++u) exact_[static_cast<std::size_t>(v * kWidth_px + u)] = 0;
    }
  }
  /// What a sensor that matches windows of pixels does: the plate's depth goes on beyond its right
  /// side, in some rows more than in others.
  void Fatten(int most_px) {
    for (int v = 0; v < kHeight_px; ++v) {
      int end = kWidth_px;
      while (end > 0 && plate_.DepthAlong(Ray(end - 1, v)) <= 0.0F) --end;
      const int fat_px = (v / 9 * 7) % (most_px + 1);
      for (int u = end; u < std::min(end + fat_px, kWidth_px) && end > 0; ++u) {
        At(u, v) = plate_.PlaneAlong(Ray(u, v));
        mask_->row(v).SetRun(u, u + 1);
      }
    }
  }
  /// Noise of the inverse depth, alike in squares of 3 x 3 pixels, as window matching leaves it.
  void AddNoise(float std_per_m, unsigned seed) {
    std::mt19937 random(seed);
    std::normal_distribution<float> gaussian(0.0F, std_per_m);
    for (int v = 0; v < kHeight_px; v += 3) {
      for (int u = 0; u < kWidth_px; u += 3) {
        const float error_per_m = gaussian(random);
        for (int y = v; y < std::min(v + 3, kHeight_px); ++y) {
          for (int x = u; x < std::min(u + 3, kWidth_px); ++x)
            At(x, y) = 1.0F / (1.0F / At(x, y) + error_per_m);
        }
      }
    }
  }
  const Edges& Find() {
    for (int v = 0; v < kHeight_px; ++v) {
      for (int u = 0; u < kWidth_px; ++u) {
        const float depth_m = plate_.DepthAlong(Ray(u, v));
        const bool shows_it = depth_m > 0.0F && std::abs(At(u, v) - depth_m) < kMostNoise_m;
        if (shows_it) mask_->row(v).SetRun(u, u + 1);
      }
    }
    mask_->Finish();
    const DepthView view{depth_m_.data(),       kWidth_px, kHeight_px, 4 * kWidth_px,
                         DepthFormat::kFloat32, 1.0F};
    const DepthReader depth(view, 0.1F, 10.0F);
    const ErodedMask interior(*mask_, config_.border_px);
    Counters counters;
    sampler_->Sample(depth, kCamera, interior, config_, *samples_, counters);
    outline_ = EdgeSampler<profiles::Micro>::Sample(depth, kCamera, *mask_, given_, *sampler_,
                                                    config_, kLeastStd_px, scale_, edges_);
    return edges_;
  }
  [[nodiscard]] OutlineSource source() const { return outline_.source; }
  [[nodiscard]] OutlineScale& scale() { return scale_; }
  /// All edges are where the outline is.
  /// @param cuts_px Columns in which something else cuts the outline off.
  void ExpectOnOutline(std::initializer_list<float> cuts_px = {}) const {
    int at_corners = 0;
    for (const EdgePoint& edge : edges_) {
      EXPECT_NEAR(plate_.rotation.col(2).dot(edge.position_m - plate_.center_m), 0.0F, 2e-4F);
      EXPECT_NEAR(edge.direction.norm(), 1.0F, 1e-4F);
      const float std_px = std::sqrt(edge.variance_m2) / PixelWidth(edge);
      EXPECT_GT(std_px, 0.999F * kLeastStd_px);
      EXPECT_LT(std_px, 1.3F * kLeastStd_px);
      EXPECT_NEAR(std_px, outline_.std_px, 1e-3F);
      EXPECT_LT(std::abs(edge.outward.dot(edge.ray)), 1e-4F);
      EXPECT_GT(edge.outward.dot(edge.position_m - plate_.center_m), 0.0F);
      EXPECT_GT(std::abs(edge.normal.dot(plate_.rotation.col(2))), 0.9999F);
      EXPECT_LT(edge.normal.dot(edge.ray), 0.0F) << "towards the camera";
      EXPECT_LT((edge.ray - edge.position_m.normalized()).norm(), 1e-5F);
      const float off_px = std::abs(plate_.BeyondOutline(edge.position_m)) / PixelWidth(edge);
      const Vec2 left_m = plate_.half_m - plate_.PlaceOf(edge.position_m).cwiseAbs();
      if (IsAtCorner(edge, left_m, cuts_px)) {
        // A corner within the disc to which the straight line is fitted.
        EXPECT_LT(off_px, 2.0F);
        ++at_corners;
        continue;
      }
      // Pixels tell the place of an outline along their rows to half a pixel.
      EXPECT_LT(off_px, 0.6F);
      // Along the nearer pair of sides.
      const Vec3 side = plate_.rotation.col(std::abs(left_m.x()) < std::abs(left_m.y()) ? 1 : 0);
      EXPECT_GT(std::abs(edge.direction.dot(side)), 0.97F);
    }
    EXPECT_LT(at_corners, edges_.size() / 3);
  }
  [[nodiscard]] static Vec3 Ray(int u, int v) {
    return kCamera.Ray(static_cast<float>(u), static_cast<float>(v));
  }

 private:
  [[nodiscard]] float& At(int u, int v) {
    return depth_m_[static_cast<std::size_t>(v * kWidth_px + u)];
  }

  [[nodiscard]] static bool IsAtCorner(const EdgePoint& edge, const Vec2& left_m,
                                       std::initializer_list<float> cuts_px) {
    constexpr float kDisc_px = 7.0F;
    const float u_px = kCamera.Project(edge.position_m).x();
    for (const float cut_px : cuts_px) {
      if (std::abs(u_px - cut_px) < kDisc_px) return true;
    }
    return left_m.maxCoeff() < kDisc_px * PixelWidth(edge);
  }

  Plate plate_;
  std::vector<float> depth_m_;
  std::vector<std::uint8_t> exact_;
  MaskView given_;
  SamplerConfig config_;
  std::unique_ptr<PixelMask<kWidth_px, kHeight_px>> mask_ =
      std::make_unique<PixelMask<kWidth_px, kHeight_px>>();
  std::unique_ptr<Sampler> sampler_ = std::make_unique<Sampler>();
  std::unique_ptr<Sampler::Samples> samples_ = std::make_unique<Sampler::Samples>();
  Edges edges_;
  OutlineScale scale_;
  SampledOutline outline_;
};

/// Which of the four sides have edges on them.
int SidesFound(const Plate& plate, const Scene::Edges& edges) {
  int sides = 0;
  for (int axis = 0; axis < 2; ++axis) {
    for (const float sign : {-1.0F, 1.0F}) {
      int on_side = 0;
      for (const EdgePoint& edge : edges) {
        const float at_m = sign * plate.PlaceOf(edge.position_m)(axis);
        on_side += std::abs(at_m - plate.half_m(axis)) < 0.005F ? 1 : 0;
      }
      sides += on_side >= 5 ? 1 : 0;
    }
  }
  return sides;
}

TEST(EdgeSampler, PlateBeforeAWall_PointsLieOnItsOutline) {
  for (const Vec3& turn_rad :
       {Vec3(0.0F, 0.0F, 0.0F), Vec3(0.0F, 0.0F, 0.35F), Vec3(0.4F, 0.0F, 0.1F),
        Vec3(0.0F, -0.5F, 0.7F), Vec3(0.3F, 0.3F, -0.2F)}) {
    SCOPED_TRACE(turn_rad.transpose());
    const Plate plate = TurnedPlate(turn_rad);
    Scene scene(plate);
    const auto& edges = scene.Find();
    EXPECT_GT(edges.size(), 60);
    EXPECT_EQ(SidesFound(plate, edges), 4);
    scene.ExpectOnOutline();
  }
}

TEST(EdgeSampler, PointsOfAllSides_AreOffByLessThanAQuarterPixelOnAverage) {
  const Plate plate = TurnedPlate(Vec3(0.2F, -0.3F, 0.3F));
  Scene scene(plate);
  const auto& edges = scene.Find();
  float sum_px = 0.0F;
  float absolute_sum_px = 0.0F;
  for (const EdgePoint& edge : edges) {
    const float off_px = plate.BeyondOutline(edge.position_m) / PixelWidth(edge);
    sum_px += off_px;
    absolute_sum_px += std::abs(off_px);
  }
  const auto count = static_cast<float>(edges.size());
  ASSERT_GT(edges.size(), 60);
  EXPECT_LT(absolute_sum_px / count, 0.25F);
  EXPECT_LT(std::abs(sum_px / count), 0.15F) << "neither inwards nor outwards";
}

int SteadyOnes(const Scene::Edges& edges) {
  return static_cast<int>(
      std::count_if(edges.begin(), edges.end(), [](const EdgePoint& e) { return e.steady; }));
}

TEST(EdgeSampler, PlateWithoutNoise_HasSteadyPointsOnly) {
  Scene scene(TurnedPlate(Vec3(0.2F, -0.3F, 0.3F)));
  const auto& edges = scene.Find();
  ASSERT_GT(edges.size(), 60);
  EXPECT_EQ(SteadyOnes(edges), edges.size());
}

TEST(EdgeSampler, NoisyPlate_KeepsPointsThatAreNotSteady) {
  int all = 0;
  int steady = 0;
  for (unsigned seed = 1; seed <= 8; ++seed) {
    const Plate plate = TurnedPlate(Vec3(0.2F, -0.3F, 0.3F));
    Scene scene(plate);
    scene.AddNoise(0.012F, seed);
    scene.GiveMask();
    const auto& edges = scene.Find();
    all += edges.size();
    steady += SteadyOnes(edges);
    for (const EdgePoint& edge : edges) {
      // The place across the ray is the outline's, whatever the surface beside it does.
      const Vec3 ray = edge.position_m / edge.position_m.z();
      const float off_m = plate.BeyondOutline(Vec3(plate.PlaneAlong(ray) * ray));
      EXPECT_LT(std::abs(off_m), 3.0F * PixelWidth(edge));
    }
  }
  EXPECT_GT(steady, 20);
  EXPECT_GT(3 * (all - steady), all) << "many windows are off by more than one standard deviation";
}

TEST(EdgeSampler, BehindAnOccluder_NoEdgeIsSeen) {
  const Plate plate = TurnedPlate(Vec3::Zero());
  Scene scene(plate);
  constexpr int kPost_px = 130;  // through the plate, nearer than it
  scene.Put(kPost_px, kPost_px + 20, 0.4F);
  const auto& edges = scene.Find();
  EXPECT_GT(edges.size(), 40);
  scene.ExpectOnOutline({kPost_px, kPost_px + 19});
  for (const EdgePoint& edge : edges) {
    const float u_px = kCamera.Project(edge.position_m).x();
    // At the top and the foot of the plate its outline goes on behind the post.
    EXPECT_TRUE(u_px < static_cast<float>(kPost_px) || u_px > static_cast<float>(kPost_px + 19));
    const float to_side_m =
        std::abs(std::abs(plate.PlaceOf(edge.position_m).y()) - plate.half_m.y());
    const bool beside_post = std::abs(u_px - kPost_px) < 3.0F || std::abs(u_px - kPost_px - 19) < 3;
    if (beside_post) {
      EXPECT_LT(to_side_m, 2.0F * PixelWidth(edge)) << "the post's edge, not the plate's";
    }
  }
}

TEST(EdgeSampler, ExactMaskOverFattenedDepth_SaysWhereThePlateEnds) {
  const Plate plate = TurnedPlate(Vec3(0.2F, -0.2F, 0.0F));
  float std_px[2] = {};
  for (const bool masked : {false, true}) {
    Scene scene(plate);
    scene.Fatten(4);
    if (masked) scene.GiveMask();
    const auto& edges = scene.Find();
    ASSERT_GT(edges.size(), 40);
    std_px[masked ? 1 : 0] = std::sqrt(edges[0].variance_m2) / PixelWidth(edges[0]);
    if (!masked) continue;
    scene.ExpectOnOutline();
    EXPECT_EQ(SidesFound(plate, edges), 4);
  }
  EXPECT_GE(std_px[0], std_px[1]) << "the depth's outline is ragged";
}

TEST(EdgeSampler, OutlinesThatAreKnownToBeOffByMore_AreNoisierWhereTheyAreThatSources) {
  const Plate plate = TurnedPlate(Vec3(0.2F, -0.2F, 0.0F));
  for (const bool masked : {false, true}) {
    Scene scene(plate);
    scene.Fatten(4);
    if (masked) scene.GiveMask();
    const auto std_px = [&scene] {
      const EdgePoint& edge = scene.Find()[0];
      return std::sqrt(edge.variance_m2) / PixelWidth(edge);
    };
    const float before_px = std_px();
    EXPECT_EQ(scene.source(), masked ? OutlineSource::kMask : OutlineSource::kDepth);
    scene.scale().Learn(masked ? OutlineSource::kDepth : OutlineSource::kMask, 2.0F);
    EXPECT_EQ(std_px(), before_px) << "told of the other source";
    scene.scale().Learn(scene.source(), 2.0F);
    EXPECT_NEAR(std_px(), scene.scale().Of(scene.source()) * before_px, 1e-3F);
    EXPECT_GT(std_px(), 1.05F * before_px);
  }
}

TEST(EdgeSampler, ThinPostBesideAnExactMask_IsNoBackground) {
  const Plate plate = TurnedPlate(Vec3::Zero());
  Scene scene(plate);
  constexpr int kPost_px = 130;
  scene.GiveMask();
  scene.CutMask(kPost_px, kPost_px + 5);
  scene.Put(kPost_px, kPost_px + 5, 0.4F);
  for (const EdgePoint& edge : scene.Find()) {
    const float to_side_m =
        std::abs(std::abs(plate.PlaceOf(edge.position_m).y()) - plate.half_m.y());
    const float u_px = kCamera.Project(edge.position_m).x();
    if (std::abs(u_px - kPost_px - 2.0F) < 5.0F) {
      EXPECT_LT(to_side_m, 2.0F * PixelWidth(edge));
    }
  }
}

TEST(EdgeSampler, PlateCutByTheImage_HasNoEdgeThere) {
  Plate plate = TurnedPlate(Vec3::Zero());
  plate.center_m.x() = 0.3F;
  Scene scene(plate);
  const auto& edges = scene.Find();
  EXPECT_GT(edges.size(), 20);
  EXPECT_EQ(SidesFound(plate, edges), 3);
  scene.ExpectOnOutline({kWidth_px - 1.0F});
  for (const EdgePoint& edge : edges)
    EXPECT_LT(kCamera.Project(edge.position_m).x(), static_cast<float>(kWidth_px) - 1.0F);
}

TEST(EdgeSampler, PlateThatLiesOnItsBackground_HasNoOccludingEdge) {
  const Plate plate = TurnedPlate(Vec3::Zero());
  const SamplerConfig config;
  Scene scene(plate, plate.center_m.z() + 0.5F * config.edge_background_gap_m);
  EXPECT_EQ(scene.Find().size(), 0);
}

TEST(EdgeSampler, NothingSeenBehind_IsNoEdge) {
  Scene scene(TurnedPlate(Vec3::Zero()), 0.0F);
  EXPECT_EQ(scene.Find().size(), 0);
}

TEST(EdgeSampler, NoObject_HasNoEdges) {
  Plate beside = TurnedPlate(Vec3::Zero());
  beside.center_m.x() = 5.0F;
  Scene scene(beside);
  EXPECT_EQ(scene.Find().size(), 0);
}

}  // namespace
}  // namespace disflow::testing
