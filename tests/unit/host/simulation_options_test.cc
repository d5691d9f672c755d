// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/host/simulation_options.h"

#include <gtest/gtest.h>

#include <string>

#include "disflow/host/stereo_camera.h"

namespace disflow::host {
namespace {

hal::Fault Parse(const std::string& text, SimulationOptions& options) {
  Uri uri;
  const hal::Fault fault = ParseUri(text, uri);
  return fault.ok() ? ParseSimulationUri(uri, options) : fault;
}

TEST(SimulationOptions, EveryKey_ReachesItsField) {
  SimulationOptions options;
  const hal::Fault fault = Parse(
      "sim:bottle?motion=flying&noise=kinect&seed=7&frames=12&fps=60&width=320&height=240&focal="
      "250&occluder=arm&drop=0.25&repeat=0.05&jitter_ms=3&blank_s=2&blank_at_s=1.5&distance_m=1.5&"
      "camera=moving&mask=sloppy&"
      "mask_delay=2&"
      "mask_"
      "grow_px=+6&mask_flicker=0.1&format=z16",
      options);
  ASSERT_TRUE(fault.ok()) << fault.message;
  EXPECT_EQ(options.object, ObjectKind::kBottle);
  EXPECT_EQ(options.motion, MotionKind::kFlying);
  EXPECT_EQ(options.noise, NoiseKind::kKinect);
  EXPECT_EQ(options.seed, 7U);
  EXPECT_EQ(options.frames, 12);
  EXPECT_EQ(options.fps, 60.0);
  EXPECT_EQ(options.width_px, 320);
  EXPECT_EQ(options.height_px, 240);
  EXPECT_EQ(options.focal_px, 250.0);
  EXPECT_EQ(options.occluder, OccluderKind::kArm);
  EXPECT_EQ(options.drop, 0.25);
  EXPECT_EQ(options.repeat, 0.05);
  EXPECT_EQ(options.jitter_ms, 3.0);
  EXPECT_EQ(options.blank_s, 2.0);
  EXPECT_EQ(options.blank_at_s, 1.5);
  EXPECT_EQ(options.distance_m, 1.5);
  EXPECT_EQ(options.mask_delay, 2);
  EXPECT_EQ(options.mask_grow_px, 6);
  EXPECT_EQ(options.mask_flicker, 0.1);
  EXPECT_EQ(options.camera, CameraKind::kMoving);
  EXPECT_EQ(options.mask, MaskKind::kSloppy);
  EXPECT_EQ(options.format, DepthFormat::kUint16);
}

TEST(SimulationOptions, ObjFile_KeepsItsPath) {
  SimulationOptions options;
  ASSERT_TRUE(Parse("sim:obj:/meshes/003_box.obj?seed=2", options).ok());
  EXPECT_EQ(options.object, ObjectKind::kObjFile);
  EXPECT_EQ(options.obj_file, "/meshes/003_box.obj");
  EXPECT_EQ(ObjectName(options), "003_box");
}

TEST(SimulationOptions, UsualCamera_IsFastYcbsScaledToTheWidth) {
  const PinholeCamera camera = SimulatedCamera({});
  EXPECT_NEAR(camera.fx_px, 614.715F, 1e-3F);
  EXPECT_EQ(camera.fx_px, camera.fy_px);
  EXPECT_EQ(camera.cx_px, 320.0F);
  EXPECT_EQ(camera.cy_px, 180.0F);
}

TEST(SimulationOptions, MissingOpenCv_IsNamed) {
  SimulationOptions options;
  const hal::Fault fault = Parse("sim:mug?noise=stereo", options);
  if (StereoIsAvailable()) {
    EXPECT_TRUE(fault.ok()) << fault.message;
    EXPECT_EQ(options.noise, NoiseKind::kStereo);
    return;
  }
  EXPECT_EQ(fault.status, Status::kUnsupported);
  EXPECT_NE(std::string(fault.message).find("without OpenCV"), std::string::npos) << fault.message;
}

struct BadAddress {
  const char* name;
  const char* text;
  const char* named;    // what the message must name
  const char* allowed;  // and what it must offer
};

void PrintTo(const BadAddress& address, std::ostream* stream) { *stream << address.name; }

class BadSimulationAddress : public testing::TestWithParam<BadAddress> {};

TEST_P(BadSimulationAddress, IsNamedWithWhatIsAllowed) {
  SimulationOptions options;
  options.seed = 99;
  const hal::Fault fault = Parse(GetParam().text, options);
  EXPECT_EQ(fault.status, Status::kInvalidUri);
  EXPECT_NE(std::string(fault.message).find(GetParam().named), std::string::npos) << fault.message;
  EXPECT_NE(std::string(fault.message).find(GetParam().allowed), std::string::npos)
      << fault.message;
  EXPECT_EQ(options.seed, 99U) << "options must stay as they were";
}

INSTANTIATE_TEST_SUITE_P(
    All, BadSimulationAddress,
    testing::Values(BadAddress{"UnknownObject", "sim:teapot", "teapot", "bottle"},
                    BadAddress{"NoFile", "sim:obj:", "obj:", "obj:FILE"},
                    BadAddress{"UnknownMotion", "sim:box?motion=slow", "motion=slow", "rotate360"},
                    BadAddress{"UnknownOption", "sim:box?speed=1", "speed", "motion"},
                    BadAddress{"NegativeSeed", "sim:box?seed=-1", "seed=-1", "0 to"},
                    BadAddress{"NoFrames", "sim:box?frames=0", "frames=0", "1 to"},
                    BadAddress{"FramesNoNumber", "sim:box?frames=10x", "frames=10x", "1 to"},
                    BadAddress{"UnknownNoise", "sim:box?noise=real", "noise=real", "stereo"},
                    BadAddress{"AllRepeated", "sim:box?repeat=1", "repeat=1", "0 to 0.9"},
                    BadAddress{"EarlyMask", "sim:box?mask_delay=-1", "mask_delay=-1", "0 to 30"},
                    BadAddress{"TwoSigns", "sim:box?mask_grow_px=+-3", "mask_grow_px", "-40 to 40"},
                    BadAddress{"UnknownMask", "sim:box?mask=leaky", "mask=leaky", "leaking"},
                    BadAddress{"DropNoNumber", "sim:box?drop=nan", "drop=nan", "0 to 0.9"},
                    BadAddress{"AllDropped", "sim:box?drop=1", "drop=1", "0 to 0.9"},
                    BadAddress{"TooWide", "sim:box?width=99999999999", "width", "4096"},
                    BadAddress{"UnknownFormat", "sim:box?format=jpeg", "format=jpeg", "z16"}),
    [](const auto& test) { return test.param.name; });

}  // namespace
}  // namespace disflow::host
