// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cstddef>
#include <cstring>
#include <memory>
#include <new>
#include <vector>

#include "disflow/surface_extractor.h"
#include "disflow/tracker.h"
#include "malloc_trap.h"
#include "recorded_simulation.h"

namespace disflow {
namespace {

using test::MallocTrap;
using test::RecordedSimulation;

/// Small enough for every profile.
host::SimulationOptions SmallPictures() {
  host::SimulationOptions options;
  options.width_px = 240;
  options.height_px = 135;
  options.frames = 30;
  return options;
}

/// A box, seen well.
host::SimulationOptions EasyScene() { return SmallPictures(); }

/// No mask, noise, an arm before the object, lost frames, a moving camera.
host::SimulationOptions HardScene() {
  host::SimulationOptions options = SmallPictures();
  options.object = host::ObjectKind::kBottle;
  options.motion = host::MotionKind::kFast;
  options.noise = host::NoiseKind::kWhite;
  options.occluder = host::OccluderKind::kArm;
  options.camera = host::CameraKind::kMoving;
  options.mask = host::MaskKind::kNone;
  options.format = DepthFormat::kUint16;
  options.drop = 0.1;
  return options;
}

/// Abrupt turns: tracking gets lost, searches and starts anew.
host::SimulationOptions WildScene() {
  host::SimulationOptions options = SmallPictures();
  options.motion = host::MotionKind::kFlying;
  options.noise = host::NoiseKind::kKinect;
  options.mask = host::MaskKind::kSloppy;
  return options;
}

/// Room for one tracker, with what `filler` leaves in it where nothing is initialised.
template <class Limits>
class TrackerMemory {
 public:
  explicit TrackerMemory(int filler) : memory_(std::make_unique<Storage>()) {
    std::memset(memory_->bytes, filler, sizeof memory_->bytes);
  }
  [[nodiscard]] Tracker<Limits>* Construct() { return new (memory_->bytes) Tracker<Limits>(); }

 private:
  struct Storage {
    alignas(Tracker<Limits>) std::byte bytes[sizeof(Tracker<Limits>)];
  };
  std::unique_ptr<Storage> memory_;
};

/// Every number that leaves the tracker, as bytes.
class ByteRecord final : public TriangleSink {
 public:
  void Append(const Estimate& estimate) {
    AppendValues(estimate.status, estimate.state, estimate.stamp_ns, estimate.T_co,
                 estimate.has_T_wo, estimate.T_wo, estimate.twist, estimate.pose_covariance,
                 estimate.twist_covariance, estimate.quality, estimate.reset_counter,
                 estimate.score, estimate.samples, estimate.inliers, estimate.edge_inliers,
                 estimate.hypotheses, estimate.iterations, estimate.rms_m,
                 estimate.inverse_depth_std_per_m, estimate.rejected);
  }
  [[nodiscard]] const std::vector<std::byte>& bytes() const { return bytes_; }

 private:
  void DoOnTriangle(const SurfaceVertex& a, const SurfaceVertex& b,
                    const SurfaceVertex& c) noexcept override {
    for (const SurfaceVertex& vertex : {a, b, c})
      AppendValues(vertex.position_m, vertex.normal, vertex.std_m);
  }

  template <class... Values>
  void AppendValues(const Values&... values) {
    (AppendValue(values), ...);
  }
  template <class Value>
  void AppendValue(const Value& value) {
    const auto* begin = reinterpret_cast<const std::byte*>(&value);
    bytes_.insert(bytes_.end(), begin, begin + sizeof value);
  }

  std::vector<std::byte> bytes_;
};

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

template <class Limits>
std::vector<std::byte> BytesOfReplay(const RecordedSimulation& recording, int filler) {
  TrackerMemory<Limits> memory(filler);
  Tracker<Limits>* tracker = memory.Construct();
  ByteRecord record;
  for (int i = 0; i < recording.size(); ++i) {
    Estimate estimate;
    (void)tracker->Process(recording.frame(i), estimate);  // the status is among the bytes
    record.Append(estimate);
  }
  const auto workspace = std::make_unique<SurfaceWorkspace<Limits>>();
  EXPECT_TRUE(ExtractSurface(tracker->field(), SurfaceOptions{}, *workspace, record).ok());
  return record.bytes();
}

TEST(MallocTrap, AllocationOfOneByte_IsSeen) {
  if (!MallocTrap::available()) GTEST_SKIP() << "sanitizers own malloc";
  MallocTrap::Arm();
  auto* volatile byte = new char;
  delete byte;
  EXPECT_GE(MallocTrap::Disarm(), 2);
}

template <class Limits>
class Replay : public testing::Test {
 protected:
  struct Outcome {
    int registered = 0;
    int triangles = 0;
    Status fused = Status::kNotInitialised;
  };

  /// Constructs, tracks, extracts the surface and starts anew, with the trap armed.
  static void ExpectNoAllocation(const host::SimulationOptions& options, Outcome& outcome) {
    if (!MallocTrap::available()) GTEST_SKIP() << "sanitizers own malloc";
    const RecordedSimulation recording(options);
    TrackerMemory<Limits> memory(0);
    const auto workspace = std::make_unique<SurfaceWorkspace<Limits>>();
    CountingSink sink;

    MallocTrap::Arm();
    Tracker<Limits>* tracker = memory.Construct();
    Estimate estimate;
    for (int i = 0; i < recording.size(); ++i)
      if (tracker->Process(recording.frame(i), estimate) == Status::kOk) ++outcome.registered;
    const bool extracted =
        ExtractSurface(tracker->field(), SurfaceOptions{}, *workspace, sink).ok();
    tracker->Reset();
    tracker = memory.Construct();
    outcome.fused = tracker->Fuse(recording.frame(0), PoseObjectFromCamera{}, estimate);
    const long calls = MallocTrap::Disarm();

    EXPECT_EQ(calls, 0);
    EXPECT_TRUE(extracted);
    outcome.triangles = sink.count();
  }
};
// Dense is Edge with larger numbers, and slow under emulation.
using Profiles = testing::Types<profiles::Micro, profiles::Edge>;
TYPED_TEST_SUITE(Replay, Profiles);

TYPED_TEST(Replay, OfAnEasyScene_AllocatesNothing) {
  typename TestFixture::Outcome outcome;
  TestFixture::ExpectNoAllocation(EasyScene(), outcome);
  if (this->IsSkipped()) return;
  EXPECT_EQ(outcome.registered, EasyScene().frames) << "a replay without tracking proves little";
  EXPECT_GT(outcome.triangles, 1000);
  EXPECT_EQ(outcome.fused, Status::kOk);
}

TYPED_TEST(Replay, OfAHardScene_AllocatesNothing) {
  typename TestFixture::Outcome outcome;
  TestFixture::ExpectNoAllocation(HardScene(), outcome);
}

TYPED_TEST(Replay, OfAWildScene_AllocatesNothing) {
  typename TestFixture::Outcome outcome;
  TestFixture::ExpectNoAllocation(WildScene(), outcome);
}

TYPED_TEST(Replay, RepeatedInOtherMemory_GivesIdenticalBytes) {
  for (const auto& options : {EasyScene(), HardScene()}) {
    const RecordedSimulation recording(options);
    const auto first = BytesOfReplay<TypeParam>(recording, 0x00);
    const auto second = BytesOfReplay<TypeParam>(recording, 0xA5);
    EXPECT_GT(first.size(), 100'000U);
    EXPECT_TRUE(first == second);
  }
}

TYPED_TEST(Replay, OfAnEasyScene_StaysWithinMillimetresOfTheTruth) {
  const RecordedSimulation recording(EasyScene());
  TrackerMemory<TypeParam> memory(0);
  Tracker<TypeParam>* tracker = memory.Construct();
  PoseCameraFromObject T_co_first;
  for (int i = 0; i < recording.size(); ++i) {
    Estimate estimate;
    ASSERT_EQ(tracker->Process(recording.frame(i), estimate), Status::kOk);
    if (i == 0) T_co_first = estimate.T_co;
    const auto T_co = estimate.T_co.template Cast<double>() *
                      T_co_first.Inverse().template Cast<double>() * recording.truth(0).object.pose;
    const auto error = recording.truth(i).object.pose.Inverse() * T_co;
    EXPECT_LT(error.translation().norm(), 0.010) << i;
    EXPECT_LT(LogSo3(error.rotation()).norm(), 0.05) << i;
  }
}

}  // namespace
}  // namespace disflow
