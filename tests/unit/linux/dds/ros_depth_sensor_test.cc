// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/posix/dds/ros_depth_sensor.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <optional>
#include <set>

#include "eventually.h"

namespace disflow::posix {
namespace {

using hal::Fault;

constexpr int kWidth = 8;
constexpr int kHeight = 6;
constexpr std::int64_t kShort_ns = 1'000'000;
/// Of this process alone, as the domain below.
const std::string kCamera = "/cam" + std::to_string(::getpid());
const std::string kDepth = kCamera + "/image_raw";
const std::string kInfo = kCamera + "/camera_info";

/// A driver in the same process; what it writes has arrived when the call returns.
class Driver {
 public:
  explicit Driver(RosNode& node) : node_(node) {
    writer_ = Writer<ros::Image>(kDepth);
    info_writer_ = Writer<ros::CameraInfo>(kInfo);
    for (int i = 0; i < kWidth * kHeight; ++i) {
      pixels_.push_back(static_cast<std::uint8_t>(i));
      pixels_.push_back(3);
    }
    image.header.frame_id = posix::Lend(frame_id_);
    image.width = kWidth;
    image.height = kHeight;
    image.step = 2 * kWidth;
    image.encoding = posix::Lend(encoding);
    info.header.frame_id = posix::Lend(frame_id_);
    info.distortion_model = posix::Lend(model_);
    info.width = kWidth;
    info.height = kHeight;
    info.k[0] = info.k[4] = 10.0;
    info.k[2] = 4.0;
    info.k[5] = 3.0;
    info.k[8] = 1.0;
    posix::Lend(d, info.d);
  }
  Driver(const Driver&) = delete;
  Driver& operator=(const Driver&) = delete;
  ~Driver() {
    (void)dds_delete(writer_);
    (void)dds_delete(info_writer_);
  }

  void SendInfo() { EXPECT_GE(dds_write(info_writer_, &info), 0); }
  /// @param mark In the first pixel, to tell images apart.
  void SendImage(std::int32_t sec, std::uint8_t mark = 0) { SendImage(ros::Time{sec, 5}, mark); }
  void SendImage(const ros::Time& stamp, std::uint8_t mark) {
    image.header.stamp = stamp;
    pixels_[0] = mark;
    posix::Lend(pixels_, image.data);
    image.encoding = posix::Lend(encoding);
    EXPECT_GE(dds_write(writer_, &image), 0);
  }
  void Resize(std::size_t bytes) { pixels_.resize(bytes); }

  ros::Image image{};
  ros::CameraInfo info{};
  std::vector<double> d = std::vector<double>(5);
  std::string encoding = "16UC1";

 private:
  template <class Message>
  dds_entity_t Writer(const std::string& topic) {
    const dds_entity_t entity = dds_create_topic(node_.participant(), &DescriptorOf<Message>(),
                                                 TopicName(topic).c_str(), nullptr, nullptr);
    return dds_create_writer(node_.participant(), entity, nullptr, nullptr);
  }

  RosNode& node_;
  dds_entity_t writer_;
  dds_entity_t info_writer_;
  std::string frame_id_ = "eye";
  std::string model_ = "plumb_bob";
  std::vector<std::uint8_t> pixels_;
};

class RosDepthSensorTest : public testing::Test {
 protected:
  RosDepthSensorTest() {
    const auto domain = 100U + static_cast<std::uint32_t>(::getpid()) % 100U;
    const Fault fault = node_->Open({.network = {domain, "lo", {}}, .name = "test"});
    EXPECT_TRUE(fault.ok()) << fault.message;
  }

  void Open() {
    ASSERT_EQ(sensor_.Open().status, Status::kNotFound);
    driver_.emplace(*node_);
    driver_->SendInfo();
    driver_->SendImage(7, 7);
    const Fault fault = sensor_.Open();
    ASSERT_TRUE(fault.ok()) << fault.message;
    ASSERT_TRUE(sensor_.Next(kShort_ns, frame_).ok());
  }
  static int MarkOf(const DepthFrame& frame) { return std::to_integer<int>(frame.depth.row(0)[0]); }

  std::shared_ptr<RosNode> node_ = std::make_shared<RosNode>();
  RosDepthSensor sensor_{node_, {kDepth, kInfo, false}};
  std::optional<Driver> driver_;
  DepthFrame frame_;
};

TEST_F(RosDepthSensorTest, BeforeAnybodyPublishes_OpeningSaysWhatIsMissing) {
  const Fault nobody = sensor_.Open();
  EXPECT_EQ(nobody.status, Status::kNotFound);
  EXPECT_NE(std::string(nobody.message).find(kDepth + ": nobody publishes"), std::string::npos);
  driver_.emplace(*node_);
  EXPECT_NE(std::string(sensor_.Open().message).find("sent nothing yet"), std::string::npos);
  driver_->SendImage(1);
  EXPECT_NE(std::string(sensor_.Open().message).find(kInfo + ": has not come"), std::string::npos);
  EXPECT_EQ(sensor_.Next(kShort_ns, frame_).status, Status::kNotOpen);
}

TEST_F(RosDepthSensorTest, FirstImage_IsAFrameWithItsOwnStampAndIntrinsics) {
  Open();
  EXPECT_EQ(frame_.stamp_ns, 7'000'000'005);
  EXPECT_EQ(frame_.depth.width_px, kWidth);
  EXPECT_EQ(frame_.depth.height_px, kHeight);
  EXPECT_EQ(frame_.depth.format, DepthFormat::kUint16);
  EXPECT_EQ(frame_.camera.fx_px, 10.0F);
  EXPECT_EQ(frame_.camera.cy_px, 3.0F);
  EXPECT_EQ(MarkOf(frame_), 7);
  EXPECT_EQ(CheckFrame(frame_, 640, 480), Status::kOk);
  const hal::SensorInfo info = sensor_.info();
  EXPECT_EQ(info.width_px, kWidth);
  EXPECT_EQ(info.height_px, kHeight);
  EXPECT_TRUE(info.live && info.epoch_stamps);
  EXPECT_EQ(sensor_.counters().frames, 1U);
  EXPECT_EQ(sensor_.Next(kShort_ns, frame_).status, Status::kTimeout);
}

TEST_F(RosDepthSensorTest, WhenSeveralWait_TheNewestIsDeliveredAndTheOthersAreCounted) {
  Open();
  for (std::uint8_t i = 1; i <= 3; ++i) driver_->SendImage(10 + i, i);
  ASSERT_TRUE(sensor_.Next(kShort_ns, frame_).ok());
  EXPECT_EQ(MarkOf(frame_), 3);
  EXPECT_EQ(sensor_.counters().skipped, 2U);
  EXPECT_EQ(sensor_.counters().dropped, 2U);
}

TEST_F(RosDepthSensorTest, ImagesThatComeBeforeTheirIntrinsics_AreNotCountedAsLost) {
  (void)sensor_.Open();
  driver_.emplace(*node_);
  for (std::uint8_t i = 1; i <= 3; ++i) driver_->SendImage(i, i);
  driver_->SendInfo();
  ASSERT_TRUE(sensor_.Open().ok());
  ASSERT_TRUE(sensor_.Next(kShort_ns, frame_).ok());
  EXPECT_EQ(MarkOf(frame_), 3);
  EXPECT_EQ(sensor_.counters().dropped, 0U);
}

TEST_F(RosDepthSensorTest, Frame_StaysAsItIsUntilTheNextIsAskedFor) {
  Open();
  const DepthFrame held = frame_;
  for (std::uint8_t i = 1; i <= 4; ++i) driver_->SendImage(10 + i, i);
  EXPECT_EQ(MarkOf(held), 7);
}

TEST_F(RosDepthSensorTest, ImageThatIsOfNoUse_IsCountedAndTheNextGoodOneComes) {
  Open();
  const auto spoil = [this](auto&& change) {
    const ros::Image good = driver_->image;
    change();
    driver_->SendImage(20);
    driver_->image = good;
    driver_->encoding = "16UC1";
    driver_->Resize(2 * kWidth * kHeight);
    return sensor_.Next(kShort_ns, frame_).status;
  };
  EXPECT_EQ(spoil([this] { driver_->encoding = "bgr8"; }), Status::kCorrupt);
  EXPECT_EQ(spoil([this] { driver_->encoding = std::string(1'000'000, 'x'); }), Status::kCorrupt);
  EXPECT_EQ(spoil([this] { driver_->image.width = 0xFFFFFFFF; }), Status::kCorrupt);
  EXPECT_EQ(spoil([this] { driver_->image.height = kHeight + 1; }), Status::kCorrupt);
  EXPECT_EQ(spoil([this] { driver_->image.step = 0; }), Status::kCorrupt);
  EXPECT_EQ(spoil([this] { driver_->Resize(3); }), Status::kTruncated);
  EXPECT_EQ(sensor_.counters().corrupt, 6U);
  EXPECT_EQ(sensor_.counters().short_frames, 1U);
  driver_->SendImage(21, 9);
  ASSERT_TRUE(sensor_.Next(kShort_ns, frame_).ok());
  EXPECT_EQ(MarkOf(frame_), 9);
}

TEST_F(RosDepthSensorTest, ImageWithoutStamp_IsNotGivenOne) {
  Open();
  for (const ros::Time stamp : {ros::Time{0, 0}, ros::Time{-1, 5}, ros::Time{3, 1'000'000'000}}) {
    driver_->SendImage(stamp, 1);
    EXPECT_EQ(sensor_.Next(kShort_ns, frame_).status, Status::kCorrupt);
  }
  driver_->SendImage(ros::Time{0, 1}, 1);
  ASSERT_TRUE(sensor_.Next(kShort_ns, frame_).ok());
  EXPECT_EQ(frame_.stamp_ns, 1);
}

TEST_F(RosDepthSensorTest, LongerImages_GetNoMoreMemoryThanTheFirst) {
  Open();
  std::set<const void*> places;
  for (std::uint8_t i = 1; i <= 20; ++i) {
    driver_->Resize(i % 2 == 0 ? 2 * kWidth * kHeight : 1'000'000);
    driver_->SendImage(30 + i, i);
    ASSERT_TRUE(sensor_.Next(kShort_ns, frame_).ok());
    EXPECT_EQ(MarkOf(frame_), i);
    places.insert(frame_.depth.data);
  }
  EXPECT_EQ(places.size(), 2U);
}

TEST_F(RosDepthSensorTest, PublisherThatGoesAndComesBack_IsLostAndReconnected) {
  Open();
  driver_.reset();
  EXPECT_EQ(sensor_.Next(kShort_ns, frame_).status, Status::kDeviceLost);
  EXPECT_EQ(sensor_.Next(kShort_ns, frame_).status, Status::kDeviceLost);
  EXPECT_EQ(sensor_.Open().status, Status::kNotFound);
  driver_.emplace(*node_);
  ASSERT_TRUE(sensor_.Open().ok());
  EXPECT_EQ(sensor_.counters().reconnects, 1U);
  // It may be another camera: its images wait for their own intrinsics.
  driver_->SendImage(40, 40);
  EXPECT_EQ(sensor_.Next(kShort_ns, frame_).status, Status::kTimeout);
  driver_->info.k[0] = 20.0;
  driver_->SendInfo();
  ASSERT_TRUE(sensor_.Next(kShort_ns, frame_).ok());
  EXPECT_EQ(MarkOf(frame_), 40);
  EXPECT_EQ(frame_.camera.fx_px, 20.0F);
}

TEST_F(RosDepthSensorTest, PublisherThatFallsSilent_IsSaidOnceAndWaitedFor) {
  Open();
  std::string said;
  ASSERT_TRUE(test::Eventually([&] {
    said = sensor_.Next(kShort_ns, frame_).message;
    return sensor_.counters().restarts == 1;
  }));
  EXPECT_NE(said.find("no image has come"), std::string::npos) << said;
  EXPECT_EQ(sensor_.Next(kShort_ns, frame_).status, Status::kTimeout);
  EXPECT_EQ(sensor_.counters().restarts, 1U);
  driver_->SendImage(60);
  EXPECT_TRUE(sensor_.Next(kShort_ns, frame_).ok());
}

TEST_F(RosDepthSensorTest, LensThatDistorts_EndsTheStartWithWhatToDo) {
  (void)sensor_.Open();
  driver_.emplace(*node_);
  driver_->d[0] = 0.2;
  driver_->SendInfo();
  driver_->SendImage(1);
  const Fault fault = sensor_.Open();
  EXPECT_EQ(fault.status, Status::kUnsupported);
  EXPECT_NE(std::string(fault.message).find("rectified topic"), std::string::npos) << fault.message;
}

TEST_F(RosDepthSensorTest, InfoOfAnotherSize_KeepsItsImagesFromBeingTracked) {
  Open();
  driver_->info.width = 2 * kWidth;
  driver_->SendInfo();
  driver_->SendImage(50);
  const Fault fault = sensor_.Next(kShort_ns, frame_);
  EXPECT_EQ(fault.status, Status::kCorrupt);
  EXPECT_NE(std::string(fault.message).find("16 x 6"), std::string::npos) << fault.message;
  driver_->info.width = kWidth;
  driver_->SendInfo();
  driver_->SendImage(51);
  EXPECT_TRUE(sensor_.Next(kShort_ns, frame_).ok());
}

}  // namespace
}  // namespace disflow::posix
