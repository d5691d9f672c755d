// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "bag_fixture.h"

namespace disflow::posix {
namespace {

constexpr const char* kTfType = "tf2_msgs/msg/TFMessage";
constexpr double kSpeed_mps = 0.3;

double XAt(std::int64_t stamp_ns) {
  return kSpeed_mps * 1e-9 * static_cast<double>(stamp_ns - kFirst_ns);
}

/// One transform without a turn.
Bytes TfMessage(const std::string& parent, const std::string& child, std::int64_t stamp_ns,
                double x_m, Wire wire = Wire::kLittle) {
  CdrWriter writer(wire);
  writer.Add(std::uint32_t{1});
  if (wire == Wire::kRos1) writer.Add(std::uint32_t{0});
  writer.Add(static_cast<std::int32_t>(stamp_ns / 1'000'000'000));
  writer.Add(static_cast<std::uint32_t>(stamp_ns % 1'000'000'000));
  writer.AddText(parent).AddText(child);
  for (const double value : {x_m, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0}) writer.Add(value);
  return writer.bytes();
}

/// A bag whose images are of a camera on a cart that drives.
class CameraPathTest : public BagSensorTest {
 protected:
  /// @param late_ns By how much the cart's poses lie beside the images.
  void Drive(std::int64_t late_ns, Wire wire = Wire::kLittle) {
    const bool is_ros1 = wire == Wire::kRos1;
    WriteAs(wire);
    const char* const type = is_ros1 ? "tf2_msgs/TFMessage" : kTfType;
    messages_.push_back({"/tf_static", type, TfMessage("cart", CameraFrame(), 0, 2.0, wire)});
    for (int k = -1; k <= kFrames; ++k) {
      const std::int64_t stamp_ns = StampOf(k) + late_ns;
      messages_.push_back({"/tf", type, TfMessage("cart", "wheel", stamp_ns, 9.0, wire)});
      messages_.push_back({"/tf", type, TfMessage("map", "cart", stamp_ns, XAt(stamp_ns), wire)});
    }
  }
  /// As the fixture's images have it.
  [[nodiscard]] static std::string CameraFrame() { return "camera_optical_frame"; }

  [[nodiscard]] BagOptions InWorld(const fs::path& file) const {
    BagOptions options = Options(file);
    options.world_frame = "map";
    return options;
  }
  /// @return Where the camera was in each frame; NaN where nobody knows.
  [[nodiscard]] static std::vector<double> PathOf(const BagOptions& options) {
    BagSensor sensor(options);
    const hal::Fault opened = sensor.Open();
    EXPECT_TRUE(opened.ok()) << opened.message;
    std::vector<double> x_m;
    DepthFrame frame;
    while (sensor.Next(0, frame).ok()) {
      const auto x = static_cast<double>(frame.T_wc.translation().x());
      x_m.push_back(frame.has_T_wc ? x : std::nan(""));
    }
    EXPECT_EQ(x_m.size(), std::size_t{kFrames});
    return x_m;
  }
  void ExpectDriven(const BagOptions& options) const {
    const std::vector<double> x_m = PathOf(options);
    for (std::size_t k = 0; k < x_m.size(); ++k)
      EXPECT_NEAR(x_m[k], 2.0 + XAt(StampOf(static_cast<int>(k))), 1e-5) << k;
  }
};

TEST_F(CameraPathTest, CameraThatIsCarried_IsWhereItWasAtEachImage) {
  for (const std::int64_t late_ns : {std::int64_t{0}, std::int64_t{10'000'000}}) {
    Drive(late_ns);
    ExpectDriven(InWorld(Write()));
  }
}

TEST_F(CameraPathTest, PosesOfRos1_AreUnderstood) {
  Drive(0, Wire::kRos1);
  ExpectDriven(InWorld(Write({.encoding = "ros1"})));
}

TEST_F(CameraPathTest, WithoutAWorld_NoFrameHasAPose) {
  Drive(0);
  for (const double x_m : PathOf(Options(Write()))) EXPECT_TRUE(std::isnan(x_m));
}

TEST_F(CameraPathTest, OneWrongStamp_CostsItsOwnPoseAlone) {
  constexpr std::int64_t kHour_ns = 3'600'000'000'000;
  for (const std::int64_t error_ns : {kHour_ns, -kHour_ns}) {
    Drive(0);
    for (std::size_t i = 0; i < messages_.size(); ++i) {
      if (messages_[i].data != TfMessage("map", "cart", StampOf(4), XAt(StampOf(4)))) continue;
      messages_[i].data = TfMessage("map", "cart", StampOf(4) + error_ns, XAt(StampOf(4)));
    }
    ExpectDriven(InWorld(Write()));
  }
}

TEST_F(CameraPathTest, DamagedMessages_ArePassedOver) {
  Drive(0);
  messages_.insert(messages_.begin(), {"/tf", kTfType, "whatever"});
  messages_.push_back({"/tf_static", kTfType, "whatever"});
  ExpectDriven(InWorld(Write()));
}

TEST_F(CameraPathTest, WorldThatDoesNotLeadToTheCamera_IsRefusedByName) {
  Drive(0);
  BagOptions options = InWorld(Write());
  options.world_frame = "earth";
  ExpectRefused(options, Status::kNotFound, "earth to camera_optical_frame");
}

}  // namespace
}  // namespace disflow::posix
