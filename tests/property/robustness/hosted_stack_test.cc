// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <pthread.h>

#include <algorithm>
#include <memory>
#include <vector>

#include "disflow/host/simulated_shapes.h"
#include "disflow/host/simulation.h"
#include "disflow/tracker_impl.h"

namespace disflow::testing {
namespace {

/// Memory that a thread runs on, and how much of it was ever written to.
class PaintedStack {
 public:
  PaintedStack() : bytes_(kBytes + kAlignment, kPaint) {}

  /// Runs a function on it and waits for its end.
  void Run(void* (*function)(void*), void* argument) {
    pthread_attr_t attributes;
    pthread_t thread{};
    ASSERT_EQ(pthread_attr_init(&attributes), 0);
    ASSERT_EQ(pthread_attr_setstack(&attributes, bottom(), kBytes), 0);
    ASSERT_EQ(pthread_create(&thread, &attributes, function, argument), 0);
    ASSERT_EQ(pthread_join(thread, nullptr), 0);
    ASSERT_EQ(pthread_attr_destroy(&attributes), 0);
  }
  /// With what the system puts at its top.
  [[nodiscard]] std::size_t HighWater() {
    const unsigned char* const end = bottom() + kBytes;
    const auto is_written = [](unsigned char byte) { return byte != kPaint; };
    return static_cast<std::size_t>(end - std::find_if(bottom(), bottom() + kBytes, is_written));
  }

 private:
  static constexpr std::size_t kBytes = std::size_t{1} << 20;
  static constexpr std::size_t kAlignment = std::size_t{1} << 16;  // the largest of pages
  static constexpr unsigned char kPaint = 0xA5;

  unsigned char* bottom() {
    void* start = bytes_.data();
    std::size_t room = bytes_.size();
    return static_cast<unsigned char*>(std::align(kAlignment, kBytes, start, room));
  }
  std::vector<unsigned char> bytes_;
};

template <typename Profile>
class HostedStack : public ::testing::Test {};

using Profiles = ::testing::Types<profiles::Edge, profiles::Dense>;
TYPED_TEST_SUITE(HostedStack, Profiles);

TYPED_TEST(HostedStack, OfFramesThatAreTrackedLostAndFoundAgain_IsLessThan32KiB) {
  constexpr std::size_t kMost = 32U << 10U;
  constexpr int kFrames = 60;
  using TrackerOfProfile = Tracker<TypeParam>;
  host::SimulationOptions options;
  options.motion = host::MotionKind::kModerate;
  options.noise = host::NoiseKind::kD415;
  options.frames = kFrames;
  host::Simulation simulation(options, host::MakeObjectMesh(options.object));
  struct Task {
    std::unique_ptr<TrackerOfProfile> tracker = std::make_unique<TrackerOfProfile>(Config{});
    DepthFrame frame;
    Estimate estimate;
  } task;
  const auto process = [](void* argument) -> void* {
    auto& given = *static_cast<Task*>(argument);
    (void)given.tracker->Process(given.frame, given.estimate);
    return nullptr;
  };
  PaintedStack stack;
  const std::vector<float> nothing_m(static_cast<std::size_t>(options.width_px) *
                                     static_cast<std::size_t>(options.height_px));
  bool was_lost = false;
  for (int i = 0; i < kFrames; ++i) {
    simulation.Render(i, task.frame);
    if (i >= 20 && i < 40) task.frame.depth.data = nothing_m.data();
    ASSERT_NO_FATAL_FAILURE(stack.Run(process, &task));
    was_lost = was_lost || task.estimate.state == TrackingState::kLost;
  }
  EXPECT_TRUE(was_lost);
  EXPECT_EQ(task.estimate.status, Status::kOk);
  EXPECT_GT(stack.HighWater(), 4096U);  // or nothing ran on it
  EXPECT_LT(stack.HighWater(), kMost);
  this->RecordProperty("stack_bytes", static_cast<int>(stack.HighWater()));
}

}  // namespace
}  // namespace disflow::testing
