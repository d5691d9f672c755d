// SPDX-License-Identifier: BSD-3-Clause
#include "objects/object_channel.h"

#include <gtest/gtest.h>

#include <thread>

#include "disflow/host/simulated_sensor.h"
#include "disflow/host/simulated_shapes.h"
#include "surface_mesh.h"

namespace disflow::apps {
namespace {

using Limits = profiles::Micro;

/// A tracker on a simulated box, and the channel that shows it.
class ObjectChannelTest : public testing::Test {
 protected:
  ObjectChannelTest() : sensor_(Scene(), host::MakeObjectMesh(host::ObjectKind::kBox)) {
    EXPECT_TRUE(sensor_.Open().ok());
  }

  static host::SimulationOptions Scene() {
    host::SimulationOptions options;
    options.width_px = 160;
    options.height_px = 120;
    return options;
  }

  void Track(int frames) {
    for (int i = 0; i < frames; ++i) {
      ASSERT_TRUE(sensor_.Next(0, frame_).ok());
      if (channel_.TakeReset()) tracker_->Reset();
      EXPECT_EQ(tracker_->Process(frame_, result_.estimate), Status::kOk);
      channel_.Offer(*tracker_, result_, &frame_);
      ++result_.frame;
    }
  }

  host::SimulatedSensor sensor_;
  std::unique_ptr<Tracker<Limits>> tracker_ = std::make_unique<Tracker<Limits>>();
  NewsSignal signal_;
  ObjectChannel channel_{"box", 3, ObjectChannel::NewSnapshot<Limits>};
  DepthFrame frame_;
  FrameResult result_;
};

TEST_F(ObjectChannelTest, EveryReader_GetsEveryResultInOrder) {
  ChannelReader& one = channel_.AddReader(signal_);
  ChannelReader& other = channel_.AddReader(signal_);
  Track(4);
  for (ChannelReader* reader : {&one, &other}) {
    FrameResult result;
    for (int i = 0; i < 4; ++i) {
      ASSERT_TRUE(reader->Pop(result));
      EXPECT_EQ(result.frame, i);
    }
    EXPECT_FALSE(reader->Pop(result));
    EXPECT_EQ(reader->lost(), 0U);
  }
}

TEST_F(ObjectChannelTest, SlowReader_LosesTheOldestAndKnowsHowMany) {
  ChannelReader& reader = channel_.AddReader(signal_);
  Track(1);
  for (int i = 1; i < 100; ++i, ++result_.frame) channel_.Offer(*tracker_, result_, &frame_);
  FrameResult result;
  int taken = 0;
  while (reader.Pop(result)) ++taken;
  EXPECT_EQ(result.frame, 99);
  EXPECT_EQ(reader.lost(), 100U - static_cast<unsigned>(taken));
}

TEST_F(ObjectChannelTest, Snapshot_IsTakenOnlyWhenAskedForAndStaysAsItIs) {
  ChannelReader& reader = channel_.AddReader(signal_);
  Track(2);
  EXPECT_EQ(reader.snapshot(), nullptr);
  reader.RequestSnapshot();
  EXPECT_EQ(reader.snapshot(), nullptr) << "before the next frame";
  Track(1);
  ASSERT_NE(reader.snapshot(), nullptr);
  Track(3);
  EXPECT_EQ(reader.snapshot()->result().frame, 2);
  reader.RequestSnapshot();
  EXPECT_EQ(reader.snapshot(), nullptr);
  Track(1);
  EXPECT_EQ(reader.snapshot()->result().frame, 6);
}

TEST_F(ObjectChannelTest, Snapshot_AnswersAsTheTrackersOwnModel) {
  ChannelReader& reader = channel_.AddReader(signal_);
  reader.RequestSnapshot();
  Track(1);
  ModelSnapshot& snapshot = *reader.snapshot();
  DistanceQuerier<Limits>::Workspace workspace;
  DistanceQuerier<Limits> own(tracker_->field(), workspace,
                              1.6F * tracker_->config().field.merge_radius_m);
  const Vec3 x_m(0.01F, 0.02F, -0.05F);
  const auto expected = own.Query(x_m);
  const auto answer = snapshot.Query(x_m);
  ASSERT_EQ(answer.status, Status::kOk);
  EXPECT_EQ(answer.value.distance_m, expected.value.distance_m);
  EXPECT_EQ(answer.value.gradient, expected.value.gradient);
  EXPECT_EQ(answer.value.in_bounds, expected.value.in_bounds);
  EXPECT_EQ(snapshot.flow().samples().size(),
            static_cast<std::size_t>(tracker_->last_samples().size()));
  SurfaceMesh mesh;
  EXPECT_EQ(snapshot.ExtractSurface(0.005F, mesh).status, Status::kOk);
  EXPECT_GT(mesh.triangles().size(), 50U);
}

TEST_F(ObjectChannelTest, Picture_ShowsTheDepthAndTheObjectsPixels) {
  ChannelReader& reader = channel_.AddReader(signal_);
  reader.RequestSnapshot();
  Track(1);
  const DepthPicture& picture = reader.snapshot()->picture();
  ASSERT_EQ(picture.width_px(), 160);
  ASSERT_EQ(picture.height_px(), 120);
  int object = 0;
  int disagree = 0;
  for (int v = 0; v < 120; ++v) {
    for (int u = 0; u < 160; ++u) {
      const auto i = static_cast<std::size_t>(v * 160 + u);
      object += picture.object()[i];
      disagree += picture.object()[i] != 0 && frame_.mask.row(v)[u] == 0 ? 1 : 0;
      const float depth_m = DepthReader(frame_.depth, 0.0F, 65.0F).At(u, v);
      ASSERT_NEAR(picture.depth_mm()[i], depth_m * 1000.0F, 0.6F);
    }
  }
  EXPECT_GT(object, 200);
  EXPECT_EQ(disagree, 0);
}

TEST_F(ObjectChannelTest, ReaderInAThreadOfItsOwn_IsWokenAndNeverSeesAHalfCopy) {
  ChannelReader& reader = channel_.AddReader(signal_);
  constexpr std::int64_t kLong_ns = 60'000'000'000;
  std::int64_t last = -1;
  int snapshots = 0;
  // Asked for before there are frames: all of them may be over when the listener gets its first
  // turn.
  reader.RequestSnapshot();
  std::thread listener([&] {
    FrameResult result;
    while (last < 29 && signal_.WaitFor(kLong_ns)) {
      while (reader.Pop(result)) last = result.frame;
      ModelSnapshot* const snapshot = reader.snapshot();
      if (snapshot == nullptr) continue;
      ++snapshots;
      EXPECT_FALSE(snapshot->flow().samples().empty());
      EXPECT_EQ(snapshot->Query(Vec3::Zero()).status, Status::kOk);
      reader.RequestSnapshot();
    }
  });
  Track(30);
  listener.join();
  EXPECT_EQ(last, 29);
  EXPECT_GT(snapshots, 0);
}

TEST_F(ObjectChannelTest, ResetAndPause_ReachTheTracker) {
  Track(3);
  channel_.RequestReset();
  Track(1);
  EXPECT_EQ(result_.estimate.reset_counter, 1);
  Track(1);
  EXPECT_EQ(result_.estimate.reset_counter, 1) << "once";
  EXPECT_FALSE(channel_.paused());
  channel_.SetPaused(true);
  EXPECT_TRUE(channel_.paused());
}

}  // namespace
}  // namespace disflow::apps
