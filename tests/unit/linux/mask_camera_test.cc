// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/posix/mask_camera.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <functional>
#include <vector>

#include "camera/fake_camera.h"
#include "eventually.h"

namespace disflow::posix {
namespace {

constexpr int kWidth = 4;
constexpr int kHeight = 3;
constexpr std::int64_t kMaxAge_ns = 100'000'000;

/// The fake camera for two threads: the one that takes masks, and the test.
class SharedCamera final : public VideoKernel {
 public:
  /// Does something with the camera while nobody else does.
  void With(const std::function<void(FakeCamera&)>& work) {
    const std::lock_guard lock(mutex_);
    work(camera_);
  }

 private:
  VideoKernel& kernel() { return camera_; }
  int Open(const char* path) noexcept override {
    const std::lock_guard lock(mutex_);
    return kernel().Open(path);
  }
  void Close(int fd) noexcept override {
    const std::lock_guard lock(mutex_);
    kernel().Close(fd);
  }
  int Ioctl(int fd, unsigned long request, void* argument) noexcept override {
    const std::lock_guard lock(mutex_);
    return kernel().Ioctl(fd, request, argument);
  }
  void* Map(int fd, std::size_t length, std::uint32_t offset) noexcept override {
    const std::lock_guard lock(mutex_);
    return kernel().Map(fd, length, offset);
  }
  void Unmap(void* memory, std::size_t length) noexcept override {
    const std::lock_guard lock(mutex_);
    kernel().Unmap(memory, length);
  }
  bool Wait(int fd, std::int64_t) noexcept override {
    ::usleep(1000);
    const std::lock_guard lock(mutex_);
    return kernel().Wait(fd, 1'000'000);
  }
  std::int64_t NowNs() noexcept override {
    const std::lock_guard lock(mutex_);
    return kernel().NowNs();
  }

  std::mutex mutex_;
  FakeCamera camera_;
};

class MaskCameraTest : public testing::Test {
 protected:
  void SetUp() override {
    camera_.With([](FakeCamera& camera) {
      camera.formats = {{V4L2_PIX_FMT_GREY, kWidth, kHeight, 6}};
    });
  }
  MaskCamera& Make() {
    CameraAddress address;
    EXPECT_TRUE(ParseMaskCamera("v4l2:/dev/video0", address).ok());
    return masks_.emplace("v4l2:/dev/video0", address, kWidth, kHeight, kMaxAge_ns, camera_,
                          "/nowhere", "/dev");
  }
  Status Attach(std::int64_t stamp_ns) {
    frame_ = {};
    frame_.depth = {pixels_, kWidth, kHeight, kWidth * 2, DepthFormat::kUint16, 0.001F};
    frame_.stamp_ns = stamp_ns;
    return masks_->Attach(frame_);
  }
  /// Asks until the answer is as expected; the other thread may not have had its turn yet.
  [[nodiscard]] bool Becomes(Status wanted, std::int64_t stamp_ns) {
    return test::Eventually([&] { return Attach(stamp_ns) == wanted; });
  }
  /// @return The stamp of the mask.
  std::int64_t Shoot(std::uint8_t value) {
    std::int64_t stamp_ns = 0;
    camera_.With([&](FakeCamera& camera) {
      camera.now_ns += 50'000'000;
      stamp_ns = camera.now_ns;
      camera.Shoot(static_cast<std::uint16_t>(value << 8 | value));
    });
    return stamp_ns;
  }
  void WaitUntilStreaming() {
    ASSERT_TRUE(test::Eventually([&] {
      bool streaming = false;
      camera_.With([&](FakeCamera& camera) { streaming = camera.streaming; });
      return streaming;
    }));
  }

  std::uint16_t pixels_[kWidth * kHeight] = {};
  SharedCamera camera_;
  std::optional<MaskCamera> masks_;
  DepthFrame frame_;
};

TEST_F(MaskCameraTest, NewestMask_BelongsToFramesOfItsTime) {
  Make();
  EXPECT_EQ(Attach(0), Status::kNotFound);
  WaitUntilStreaming();
  for (std::uint8_t value = 1; value < 10; ++value) {
    const std::int64_t stamp_ns = Shoot(value);
    ASSERT_TRUE(test::Eventually([&] {
      return Attach(stamp_ns) == Status::kOk && frame_.mask.row(kHeight - 1)[kWidth - 1] == value;
    })) << int{value};
    EXPECT_EQ(frame_.mask.width_px, kWidth);
    EXPECT_EQ(frame_.mask.stride_bytes, kWidth);
    EXPECT_EQ(Attach(stamp_ns + kMaxAge_ns + 1), Status::kTimeout);
    EXPECT_FALSE(frame_.mask.given());
  }
  EXPECT_GT(masks_->counters().used, 8U);
  EXPECT_EQ(masks_->counters().late, 9U);
}

TEST_F(MaskCameraTest, DeviceOfAnotherSizeOrFormat_IsNeverUsed) {
  camera_.With([](FakeCamera& camera) { camera.formats[0].width = 5; });
  Make();
  EXPECT_TRUE(Becomes(Status::kMaskSizeMismatch, 0));
  EXPECT_FALSE(frame_.mask.given());
  EXPECT_GT(masks_->counters().wrong_size, 0U);
}

TEST_F(MaskCameraTest, DeviceThatComesBack_IsUsedAgain) {
  Make();
  WaitUntilStreaming();
  ASSERT_TRUE(Becomes(Status::kOk, Shoot(7)));
  camera_.With([](FakeCamera& camera) {
    camera.Unplug();
    camera.streaming = false;
  });
  const std::int64_t late_ns = Shoot(8);
  EXPECT_TRUE(Becomes(Status::kTimeout, late_ns + 1'000'000'000));
  camera_.With([](FakeCamera& camera) { camera.PlugIn(); });
  WaitUntilStreaming();
  EXPECT_TRUE(Becomes(Status::kOk, Shoot(9) + 50'000'000));
}

TEST_F(MaskCameraTest, End_GivesEverythingBack) {
  Make();
  WaitUntilStreaming();
  masks_.reset();
  camera_.With([](FakeCamera& camera) {
    EXPECT_EQ(camera.open_files, 0);
    EXPECT_EQ(camera.mapped, 0);
    EXPECT_EQ(camera.open_dmabufs, 0);
  });
}

TEST(MaskName, WhatIsNone_IsRefusedWithWhatItLooksLike) {
  for (const char* name : {"v4l2:/dev/video0", "v4l2:serial=12?fps=30", "/masks", "file:masks"}) {
    EXPECT_TRUE(CheckMaskName(name).ok()) << name;
  }
  for (const char* name :
       {"", "masks", "/a/b", "file:", "v4l2:", "v4l2:video0", "v4l2:/dev/video0?format=Z16",
        "v4l2:/dev/video0?width=4&height=3", "v4l2:/dev/video0?depth_scale=1",
        "v4l2:/dev/video0?rectified=yes", "libcamera:0"}) {
    EXPECT_EQ(CheckMaskName(name).status, Status::kInvalidUri) << name;
  }
}

}  // namespace
}  // namespace disflow::posix
