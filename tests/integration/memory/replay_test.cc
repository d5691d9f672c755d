// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cstring>
#include <memory>
#include <new>
#include <vector>

#include "box_scene.h"
#include "disflow/surface_extractor.h"
#include "disflow/tracker.h"
#include "malloc_trap.h"

namespace disflow {
namespace {

constexpr int kFrames = 60;
constexpr float kNoisePerM = 0.002F;

std::vector<test::BoxScene::Image> RenderAll() {
  std::vector<test::BoxScene::Image> images;
  for (int i = 0; i < kFrames; ++i) images.push_back(test::BoxScene::Render(i, kNoisePerM));
  return images;
}

/// Every number that leaves the tracker, as bytes.
void Append(const Estimate& estimate, std::vector<unsigned char>& bytes) {
  const auto append = [&bytes](const auto& value) {
    const auto* begin = reinterpret_cast<const unsigned char*>(&value);
    bytes.insert(bytes.end(), begin, begin + sizeof value);
  };
  append(estimate.status);
  append(estimate.state);
  append(estimate.stamp_ns);
  append(estimate.T_co);
  append(estimate.twist);
  append(estimate.pose_covariance);
  append(estimate.twist_covariance);
  append(estimate.quality);
  append(estimate.score);
  append(estimate.inliers);
  append(estimate.edge_inliers);
  append(estimate.rms_m);
  append(estimate.rejected);
}

class CountingSink final : public TriangleSink {
 public:
  [[nodiscard]] int count() const { return count_; }

 private:
  void DoOnTriangle(const SurfaceVertex&, const SurfaceVertex&,
                    const SurfaceVertex&) noexcept override {
    ++count_;
  }
  int count_ = 0;
};

TEST(MallocTrap, AllocationOfOneByte_IsSeen) {
  if (!test::MallocTrap::available()) GTEST_SKIP() << "sanitizers own malloc";
  test::MallocTrap::Arm();
  auto* volatile byte = new char;
  delete byte;
  EXPECT_GE(test::MallocTrap::Disarm(), 2);
}

template <class Limits>
class Replay : public testing::Test {};
using Profiles = testing::Types<profiles::Micro, profiles::Edge>;
TYPED_TEST_SUITE(Replay, Profiles);

TYPED_TEST(Replay, WholeReplayConstructionAndSurfaceIncluded_AllocatesNothing) {
  if (!test::MallocTrap::available()) GTEST_SKIP() << "sanitizers own malloc";
  auto images = RenderAll();
  // The Micro profile takes images up to 240 pixels wide: it sees the middle of the picture.
  constexpr int kOffset = (test::BoxScene::kWidth - 240) / 2;
  const bool crop = TypeParam::kMaxImageWidth < test::BoxScene::kWidth;
  static std::aligned_storage_t<sizeof(Tracker<TypeParam>), alignof(Tracker<TypeParam>)> memory;
  static SurfaceWorkspace<TypeParam> workspace;
  CountingSink sink;
  int registered = 0;

  test::MallocTrap::Arm();
  auto* tracker = new (&memory) Tracker<TypeParam>();
  for (const auto& image : images) {
    DepthFrame frame = image.Frame();
    if (crop) {
      frame.depth.data = image.depth_m.data() + kOffset;
      frame.mask.data += kOffset;
      frame.depth.width_px = frame.mask.width_px = 240;
      frame.camera.cx_px -= static_cast<float>(kOffset);
    }
    Estimate estimate;
    if (tracker->Process(frame, estimate) == Status::kOk) ++registered;
  }
  const auto counts = ExtractSurface(tracker->field(), SurfaceOptions{}, workspace, sink);
  const long calls = test::MallocTrap::Disarm();

  EXPECT_EQ(calls, 0);
  EXPECT_EQ(registered, kFrames) << "a replay that is not tracked proves little";
  EXPECT_TRUE(counts.ok());
  EXPECT_GT(sink.count(), 1000);
}

TEST(ReplayOnEdge, TwoRunsOfOneReplay_GiveIdenticalBytes) {
  const auto images = RenderAll();
  std::vector<unsigned char> runs[2];
  for (auto& bytes : runs) {
    const auto tracker = std::make_unique<Tracker<profiles::Edge>>();
    for (const auto& image : images) {
      Estimate estimate;
      (void)tracker->Process(image.Frame(), estimate);  // the status is among the bytes
      Append(estimate, bytes);
    }
  }
  ASSERT_EQ(runs[0].size(), runs[1].size());
  EXPECT_EQ(std::memcmp(runs[0].data(), runs[1].data(), runs[0].size()), 0);
}

TEST(ReplayOnEdge, TumblingBox_IsTrackedToMillimetres) {
  const auto images = RenderAll();
  const auto tracker = std::make_unique<Tracker<profiles::Edge>>();
  PoseCameraFromObject T_co_first;
  for (const auto& image : images) {
    Estimate estimate;
    ASSERT_EQ(tracker->Process(image.Frame(), estimate), Status::kOk);
    if (&image == images.data()) T_co_first = estimate.T_co;
    const auto aligned = estimate.T_co * T_co_first.Inverse() * images.front().T_co;
    EXPECT_LT((aligned.translation() - image.T_co.translation()).norm(), 0.006F);
    EXPECT_LT(LogSo3(Mat3(aligned.rotation() * image.T_co.rotation().transpose())).norm(), 0.03F);
  }
}

}  // namespace
}  // namespace disflow
