// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "depth_scene.h"
#include "disflow/depth/segmenter_anywhere_impl.h"
#include "disflow/depth/segmenter_choice_impl.h"
#include "disflow/depth/segmenter_impl.h"
#include "disflow/limits.h"

/// @file
/// A thing over a table, and what the segmenter makes of it before and after there is a model.

namespace disflow::testing {

inline constexpr PixelBox kObject{60, 30, 100, 70};
inline constexpr float kObject_m = 0.8F;
inline constexpr PixelBox kOther{20, 30, 40, 60};

/// The object's front in the camera frame.
inline Vec3 Corner(int u, int v) {
  return DepthScene::camera().BackProject(static_cast<float>(u), static_cast<float>(v), kObject_m);
}

/// Before there is a model.
class FirstFrame : public ::testing::Test {
 protected:
  Status Segment(const DepthScene& scene) {
    const auto explains = [this](const Vec3& x_c) {
      ++asked_;
      return explains_(x_c);
    };
    return segmenter_->Segment(scene.frame(), config_, prior_, explains, *object_, overrun_,
                               counters_);
  }
  /// Of the pixels of a box, those that are the object.
  [[nodiscard]] double Share(const PixelBox& box) const {
    int inside = 0;
    for (int v = box.v_min; v < box.v_max; ++v)
      inside += object_->row(v).CountRun(box.u_min, box.u_max);
    return static_cast<double>(inside) / (box.width() * box.height());
  }
  void ExpectExactly(const PixelBox& box) const {
    EXPECT_EQ(Share(box), 1.0);
    EXPECT_EQ(object_->count(), box.width() * box.height());
  }

  SegmenterConfig config_;
  ModelPrior prior_;
  Counters counters_;
  bool (*explains_)(const Vec3&) = [](const Vec3&) { return false; };
  int asked_ = 0;
  using SegmenterType = Segmenter<profiles::Micro>;
  std::unique_ptr<SegmenterType> segmenter_ = std::make_unique<SegmenterType>();
  std::unique_ptr<SegmenterType::Mask> object_ = std::make_unique<SegmenterType::Mask>();
  MaskOverrun<SegmenterType::Mask> overrun_;
};

inline DepthScene ObjectOverATable() {
  DepthScene scene(2.2F);
  scene.Table().Rectangle(kObject, kObject_m);
  return scene;
}

/// With a model: a plate as large as the object, in the predicted place.
class LaterFrame : public FirstFrame {
 protected:
  LaterFrame() {
    prior_.known = true;
    const Vec3 low = Corner(kObject.u_min, kObject.v_min);
    const Vec3 high = Corner(kObject.u_max, kObject.v_max);
    prior_.T_oc = PoseCameraFromObject(Mat3::Identity(), Vec3(0.5F * (low + high))).Inverse();
    prior_.box_max_m = 0.5F * (high - low) + Vec3(0.0F, 0.0F, 0.02F);
    prior_.box_min_m = -prior_.box_max_m;
    explains_ = [](const Vec3& x_c) {
      const Vec2 px = DepthScene::camera().Project(x_c);
      return Covers(kObject, static_cast<int>(px.x() + 0.5F), static_cast<int>(px.y() + 0.5F)) &&
             std::abs(x_c.z() - kObject_m) < 0.01F;
    };
  }
};

}  // namespace disflow::testing
