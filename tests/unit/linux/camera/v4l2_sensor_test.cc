// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/posix/camera/v4l2_sensor.h"

#include <gtest/gtest.h>

#include <string>

#include "fake_camera.h"

namespace disflow::posix {
namespace {

constexpr std::int64_t kMs = 1'000'000;

class V4l2SensorTest : public testing::Test {
 protected:
  /// @param options Of the address, e.g. "format=Z16".
  V4l2Sensor& Make(const std::string& options = "depth_scale=0.001") {
    CameraAddress address;
    const hal::Fault fault = ParseCameraAddress("v4l2:/dev/video0?K=4,4,2,1.5&" + options, address);
    EXPECT_TRUE(fault.ok()) << fault.message;
    return sensor_.emplace(address, CameraDescription{}, camera_, "/nowhere", "/dev");
  }
  void ExpectRefused(const std::string& options, Status status, const std::string& words) {
    const hal::Fault fault = Make(options).Open();
    EXPECT_EQ(fault.status, status) << fault.message;
    EXPECT_NE(std::string(fault.message).find(words), std::string::npos) << fault.message;
    EXPECT_EQ(camera_.open_files, 0);
    EXPECT_EQ(camera_.mapped, 0);
    EXPECT_EQ(camera_.open_dmabufs, 0);
  }
  std::uint16_t FirstPixel() const { return *static_cast<const std::uint16_t*>(frame_.depth.data); }
  Status Next() { return sensor_->Next(100 * kMs, frame_).status; }

  FakeCamera camera_;
  std::optional<V4l2Sensor> sensor_;
  DepthFrame frame_;
};

TEST_F(V4l2SensorTest, Frame_IsLentWithAllThatIsKnownOfIt) {
  V4l2Sensor& sensor = Make("depth_scale=0.00025&format=Z16&width=4&height=3&fps=30");
  camera_.formats[0].bytes_per_line = 16;
  ASSERT_TRUE(sensor.Open().ok());
  camera_.now_ns = 123'456'789'000;
  camera_.Shoot(700);
  ASSERT_EQ(Next(), Status::kOk);
  EXPECT_EQ(frame_.depth.width_px, 4);
  EXPECT_EQ(frame_.depth.height_px, 3);
  EXPECT_EQ(frame_.depth.stride_bytes, 16);
  EXPECT_FLOAT_EQ(frame_.depth.unit_m, 0.00025F);
  EXPECT_FLOAT_EQ(frame_.camera.fx_px, 4.0F);
  EXPECT_EQ(frame_.stamp_ns, 123'456'789'000);
  EXPECT_EQ(FirstPixel(), 700);
  EXPECT_TRUE(sensor.info().live);
  EXPECT_FLOAT_EQ(sensor.info().rate_hz, 30.0F);
  EXPECT_EQ(sensor.info().stamp_point, hal::StampPoint::kStartOfExposure);
  EXPECT_GE(sensor.Dmabuf(frame_), 100);
}

TEST_F(V4l2SensorTest, SlowReader_GetsTheNewestFrameAndTheOthersAreCounted) {
  V4l2Sensor& sensor = Make();
  ASSERT_TRUE(sensor.Open().ok());
  for (std::uint16_t pixel = 1; pixel <= 3; ++pixel) camera_.Shoot(pixel);
  ASSERT_EQ(Next(), Status::kOk);
  EXPECT_EQ(FirstPixel(), 3);
  EXPECT_EQ(sensor.counters().skipped, 2U);
  EXPECT_EQ(sensor.counters().dropped, 2U);
  EXPECT_EQ(sensor.counters().gaps, 0U);
}

TEST_F(V4l2SensorTest, LentFrames_StayUntouchedForTwoCalls) {
  V4l2Sensor& sensor = Make();
  ASSERT_TRUE(sensor.Open().ok());
  ASSERT_EQ(sensor.info().held_frames, 2);
  camera_.Shoot(1);
  ASSERT_EQ(Next(), Status::kOk);
  const auto* first = static_cast<const std::uint16_t*>(frame_.depth.data);
  for (std::uint16_t pixel = 2; pixel < 12; ++pixel) camera_.Shoot(pixel);
  ASSERT_EQ(Next(), Status::kOk);
  EXPECT_EQ(*first, 1);
  EXPECT_EQ(camera_.queued(), 4U) << "the driver must have buffers to go on with";
}

TEST_F(V4l2SensorTest, FramesTheDriverLost_AreCountedAsGaps) {
  V4l2Sensor& sensor = Make();
  ASSERT_TRUE(sensor.Open().ok());
  camera_.Shoot(1);
  ASSERT_EQ(Next(), Status::kOk);
  camera_.next_sequence += 5;
  camera_.Shoot(2);
  ASSERT_EQ(Next(), Status::kOk);
  EXPECT_EQ(sensor.counters().gaps, 5U);
  EXPECT_EQ(sensor.counters().dropped, 5U);
  EXPECT_EQ(sensor.counters().frames, 2U);
}

TEST_F(V4l2SensorTest, FrameThatComesAfterANewerOne_IsLeftOutAndCountedOnce) {
  V4l2Sensor& sensor = Make();
  ASSERT_TRUE(sensor.Open().ok());
  for (const std::uint32_t sequence : {10U, 12U}) {
    camera_.next_sequence = sequence;
    camera_.Shoot(static_cast<std::uint16_t>(sequence));
    ASSERT_EQ(Next(), Status::kOk);
  }
  camera_.next_sequence = 11;
  camera_.Shoot(11);
  EXPECT_EQ(Next(), Status::kTimeout);
  EXPECT_EQ(sensor.counters().gaps, 0U);
  EXPECT_EQ(sensor.counters().skipped, 1U);
  EXPECT_EQ(sensor.counters().dropped, 1U);
  EXPECT_EQ(camera_.queued(), 5U);
}

TEST_F(V4l2SensorTest, DamagedAndShortFrames_AreReportedCountedAndGivenBack) {
  V4l2Sensor& sensor = Make();
  ASSERT_TRUE(sensor.Open().ok());
  camera_.Shoot(1, V4L2_BUF_FLAG_ERROR);
  EXPECT_EQ(Next(), Status::kCorrupt);
  camera_.Shoot(2, 0, 1);
  EXPECT_EQ(Next(), Status::kTruncated);
  camera_.Shoot(3);
  EXPECT_EQ(Next(), Status::kOk);
  const hal::SensorCounters counters = sensor.counters();
  EXPECT_EQ(counters.flagged, 1U);
  EXPECT_EQ(counters.short_frames, 1U);
  EXPECT_EQ(counters.corrupt, 2U);
  EXPECT_EQ(counters.dropped, 0U);
  EXPECT_EQ(camera_.queued(), 5U);
}

TEST_F(V4l2SensorTest, GoodFrameBehindADamagedOne_IsTaken) {
  V4l2Sensor& sensor = Make();
  ASSERT_TRUE(sensor.Open().ok());
  camera_.Shoot(1);
  camera_.Shoot(2, V4L2_BUF_FLAG_ERROR);
  ASSERT_EQ(Next(), Status::kOk);
  EXPECT_EQ(FirstPixel(), 1);
  EXPECT_EQ(sensor.counters().flagged, 1U);
}

TEST_F(V4l2SensorTest, BigEndianFrame_IsConvertedIntoMemoryOfTheSensor) {
  camera_.formats = {{V4L2_PIX_FMT_Y16_BE, 4, 3, 8}};
  V4l2Sensor& sensor = Make();
  ASSERT_TRUE(sensor.Open().ok());
  camera_.Shoot(0x1234);
  ASSERT_EQ(Next(), Status::kOk);
  EXPECT_EQ(FirstPixel(), 0x3412);
  EXPECT_EQ(frame_.depth.stride_bytes, 8);
  EXPECT_EQ(sensor.Dmabuf(frame_), -1);
}

TEST_F(V4l2SensorTest, DepthPlaneBehindAnInfraredOne_IsTheOneThatIsLent) {
  camera_.formats = {{V4L2_PIX_FMT_INZI, 4, 3, 16}};
  V4l2Sensor& sensor = Make();
  ASSERT_TRUE(sensor.Open().ok());
  camera_.Shoot(5);
  ASSERT_EQ(Next(), Status::kOk);
  EXPECT_EQ(frame_.depth.stride_bytes, 8);
  EXPECT_EQ(FirstPixel(), 5);
}

TEST_F(V4l2SensorTest, WhatTheDriverDoesNotDo_IsRefusedWithWhatItDoes) {
  ExpectRefused("depth_scale=0.001&format=Y16", Status::kUnsupported, "it has: Z16");
  ExpectRefused("depth_scale=0.001&width=640&height=480", Status::kUnsupported, "sizes: 4x3");
  ExpectRefused("depth_scale=0.001&fps=60", Status::kUnsupported, "rates: 30");
  ExpectRefused("format=Z16", Status::kUnsupported, "depth_scale=");
  camera_.formats = {{V4L2_PIX_FMT_YUYV, 4, 3, 8}};
  ExpectRefused("depth_scale=0.001", Status::kUnsupported, "YUYV");
}

TEST_F(V4l2SensorTest, DriverThatAnswersNonsense_IsRefused) {
  camera_.formats[0].bytes_per_line = 7;
  ExpectRefused("depth_scale=0.001", Status::kUnsupported, "bytes per line");
  camera_.formats[0] = {V4L2_PIX_FMT_Z16, 0, 3, 8};
  ExpectRefused("depth_scale=0.001", Status::kUnsupported, "cannot be used");
  camera_.formats[0] = {V4L2_PIX_FMT_Z16, 4, 3, 8};
  camera_.buffer_limit = 3;
  ExpectRefused("depth_scale=0.001", Status::kUnsupported, "3 buffers");
  camera_.capabilities = V4L2_CAP_VIDEO_CAPTURE_MPLANE;
  ExpectRefused("depth_scale=0.001", Status::kUnsupported, "multi-planar");
}

TEST_F(V4l2SensorTest, EveryFailureToOpen_SaysWhatToDo) {
  struct Case {
    unsigned long request;
    int error;
    Status status;
    const char* words;
  };
  const Case cases[] = {
      {FakeCamera::kOpen, EACCES, Status::kPermissionDenied, "group"},
      {FakeCamera::kOpen, EBUSY, Status::kBusy, "another program"},
      {VIDIOC_S_FMT, EBUSY, Status::kBusy, "another program"},
      {VIDIOC_REQBUFS, EBUSY, Status::kBusy, "another program"},
      {VIDIOC_STREAMON, ENOSPC, Status::kBusy, "bandwidth"},
      {VIDIOC_STREAMON, EIO, Status::kIoError, "start the stream"},
      {VIDIOC_QUERYCAP, ENODEV, Status::kDeviceLost, "plug it in"},
  };
  for (const Case& one : cases) {
    camera_.failures = {{one.request, one.error}};
    ExpectRefused("depth_scale=0.001", one.status, one.words);
  }
  camera_.failures.clear();
  camera_.is_there = false;
  ExpectRefused("depth_scale=0.001", Status::kNotFound, "--list-sensors");
}

TEST_F(V4l2SensorTest, StampsOfAnotherClock_EndTheRun) {
  V4l2Sensor& sensor = Make();
  ASSERT_TRUE(sensor.Open().ok());
  camera_.stamp_flags = V4L2_BUF_FLAG_TIMESTAMP_UNKNOWN;
  camera_.Shoot(1);
  EXPECT_EQ(Next(), Status::kUnsupported);
}

TEST_F(V4l2SensorTest, TransferError_RestartsTheStream) {
  V4l2Sensor& sensor = Make();
  ASSERT_TRUE(sensor.Open().ok());
  camera_.failures = {{VIDIOC_DQBUF, EIO}};
  EXPECT_EQ(Next(), Status::kTimeout);
  camera_.failures.clear();
  EXPECT_EQ(camera_.starts, 2);
  EXPECT_EQ(sensor.counters().restarts, 1U);
  camera_.Shoot(9);
  EXPECT_EQ(Next(), Status::kOk);
  EXPECT_EQ(FirstPixel(), 9);
}

TEST_F(V4l2SensorTest, SilentCamera_IsRestartedThenOpenedAnew) {
  V4l2Sensor& sensor = Make();
  ASSERT_TRUE(sensor.Open().ok());
  int calls = 0;
  while (Next() == Status::kTimeout && calls < 1000) ++calls;
  EXPECT_LT(calls, 1000);
  EXPECT_EQ(sensor.counters().restarts, 3U);
  EXPECT_EQ(camera_.open_files, 0);
  EXPECT_EQ(Next(), Status::kDeviceLost);
  ASSERT_TRUE(sensor.Open().ok());
  camera_.Shoot(4);
  EXPECT_EQ(Next(), Status::kOk);
  EXPECT_EQ(sensor.counters().reconnects, 1U);
}

TEST_F(V4l2SensorTest, UnpluggedCamera_ComesBackAndIsCounted) {
  V4l2Sensor& sensor = Make();
  ASSERT_TRUE(sensor.Open().ok());
  camera_.Shoot(1);
  ASSERT_EQ(Next(), Status::kOk);
  camera_.Unplug();
  EXPECT_EQ(Next(), Status::kDeviceLost);
  EXPECT_EQ(camera_.open_files, 0);
  EXPECT_EQ(camera_.mapped, 0);
  EXPECT_EQ(camera_.open_dmabufs, 0);
  EXPECT_FALSE(sensor.Open().ok());
  camera_.PlugIn();
  ASSERT_TRUE(sensor.Open().ok());
  EXPECT_EQ(sensor.counters().reconnects, 1U);
  camera_.Shoot(2);
  EXPECT_EQ(Next(), Status::kOk);
  EXPECT_EQ(FirstPixel(), 2);
  EXPECT_EQ(sensor.counters().gaps, 0U);
}

TEST_F(V4l2SensorTest, ClosedSensor_GivesEverythingBackAndSaysThatItIsClosed) {
  V4l2Sensor& sensor = Make();
  EXPECT_EQ(Next(), Status::kNotOpen);
  ASSERT_TRUE(sensor.Open().ok());
  ASSERT_TRUE(sensor.Open().ok()) << "a second call must change nothing";
  sensor.Close();
  sensor.Close();
  EXPECT_EQ(camera_.open_files, 0);
  EXPECT_EQ(camera_.mapped, 0);
  EXPECT_EQ(camera_.open_dmabufs, 0);
  EXPECT_EQ(Next(), Status::kNotOpen);
}

}  // namespace
}  // namespace disflow::posix
