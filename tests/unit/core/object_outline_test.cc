// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/depth/object_outline.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <random>
#include <vector>

#include "disflow/depth/pixel_mask.h"

namespace disflow {
namespace {

constexpr int kWidth_px = 200;
constexpr int kHeight_px = 160;
constexpr float kCenterU = 100.0F;
constexpr float kCenterV = 80.0F;
using Mask = PixelMask<kWidth_px, kHeight_px>;
using Outline = ObjectOutline<160>;

/// A disk whose radius is off by a value for each of the directions.
class Disk {
 public:
  Disk(float radius_px, float noise_px, unsigned seed = 1) : radius_px_(radius_px) {
    std::mt19937 random(seed);
    std::normal_distribution<float> gaussian;
    for (float& offset : offset_px_) offset = noise_px * gaussian(random);
  }
  [[nodiscard]] bool Test(int u, int v) const {
    const float du = static_cast<float>(u) - kCenterU;
    const float dv = static_cast<float>(v) - kCenterV;
    const float turns = std::atan2(dv, du) / 6.2831853F + 0.5F;
    const auto sector = static_cast<std::size_t>(turns * static_cast<float>(offset_px_.size()));
    return std::hypot(du, dv) < radius_px_ + offset_px_[sector % offset_px_.size()];
  }

 private:
  float radius_px_;
  std::array<float, 40> offset_px_;  // about as wide as what lines are fitted to
};

class ObjectOutlineTest : public testing::Test {
 protected:
  const Outline& Find(const Disk& depth) {
    mask_->Start(kWidth_px, kHeight_px);
    for (int v = 0; v < kHeight_px; ++v) {
      for (int u = 0; u < kWidth_px; ++u) {
        if (depth.Test(u, v)) mask_->row(v).SetRun(u, u + 1);
      }
    }
    mask_->Finish();
    outline_.Find(*mask_, given_);
    return outline_;
  }
  void Give(const Disk& disk, std::uint8_t value = 255) {
    for (int v = 0; v < kHeight_px; ++v) {
      for (int u = 0; u < kWidth_px; ++u)
        bytes_[static_cast<std::size_t>(v * kWidth_px + u)] = disk.Test(u, v) ? value : 0;
    }
    given_ = {bytes_.data(), kWidth_px, kHeight_px, kWidth_px};
  }
  /// Mean distance of the points from a circle.
  [[nodiscard]] float OffCircle(float radius_px) const {
    float sum_px = 0.0F;
    for (const OutlinePoint& point : outline_.points()) {
      const Vec2 place = point.At(-point.distance_px) - Vec2(kCenterU, kCenterV);
      sum_px += std::abs(place.norm() - radius_px);
    }
    return sum_px / static_cast<float>(outline_.points().size());
  }

  std::unique_ptr<Mask> mask_ = std::make_unique<Mask>();
  std::vector<std::uint8_t> bytes_ = std::vector<std::uint8_t>(kWidth_px * kHeight_px);
  MaskView given_;
  Outline outline_;
};

TEST_F(ObjectOutlineTest, SmoothDisk_HasPointsAllAroundAndNextToNoNoise) {
  Find(Disk(50.0F, 0.0F));
  EXPECT_GT(outline_.points().size(), 100);
  EXPECT_LT(OffCircle(50.0F), 0.4F);
  EXPECT_LT(outline_.std_px(), 0.35F) << "what the pixels themselves do";
  EXPECT_EQ(outline_.source(), OutlineSource::kDepth);
  Vec2 sum = Vec2::Zero();
  for (const OutlinePoint& point : outline_.points()) {
    EXPECT_GT(point.inward.dot(Vec2(kCenterU, kCenterV) - point.pixel), 45.0F);
    sum += point.inward;
  }
  EXPECT_LT(sum.norm(), 0.2F * static_cast<float>(outline_.points().size()));
}

TEST_F(ObjectOutlineTest, RaggedOutline_IsNoisierThanASmoothOne) {
  const float little_px = Find(Disk(55.0F, 0.7F)).std_px();
  const float much_px = Find(Disk(55.0F, 1.4F)).std_px();
  EXPECT_GT(little_px, 0.35F);
  EXPECT_LT(little_px, 1.1F);
  EXPECT_GE(much_px, little_px);
}

TEST_F(ObjectOutlineTest, ExactMaskOverRaggedDepth_IsTaken) {
  Give(Disk(50.0F, 0.0F));
  Find(Disk(50.0F, 1.5F));
  EXPECT_EQ(outline_.source(), OutlineSource::kMask);
  EXPECT_LT(OffCircle(50.0F), 0.4F);
  EXPECT_LT(outline_.std_px(), 0.35F);
  EXPECT_GT(outline_.depth_std_px(), 0.45F);
}

TEST_F(ObjectOutlineTest, MaskOfAnotherObject_IsNotTaken) {
  Give(Disk(50.0F, 0.0F), 3);
  given_.label = 3;
  Find(Disk(50.0F, 1.0F));
  EXPECT_EQ(outline_.source(), OutlineSource::kMask);
  given_.label = 4;
  Find(Disk(50.0F, 1.0F));
  EXPECT_EQ(outline_.source(), OutlineSource::kDepth);
}

TEST_F(ObjectOutlineTest, MaskTooLargeOrTooSmall_IsNotTaken) {
  for (const float grown_px : {-12.0F, -5.0F, -3.0F, 3.0F, 5.0F, 12.0F}) {
    Give(Disk(50.0F + grown_px, 0.0F));
    Find(Disk(50.0F, 0.7F));
    EXPECT_EQ(outline_.source(), OutlineSource::kDepth) << grown_px;
    EXPECT_LT(OffCircle(50.0F), 1.0F);
  }
}

TEST_F(ObjectOutlineTest, NoObject_HasNoPoints) {
  Give(Disk(50.0F, 0.0F));
  Find(Disk(0.0F, 0.0F));
  EXPECT_TRUE(outline_.points().empty());
  EXPECT_EQ(outline_.source(), OutlineSource::kDepth);
}

}  // namespace
}  // namespace disflow
