// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/host/bop_scene.h"
#include "foreign_sequence.h"

namespace disflow::host {
namespace {

namespace fs = std::filesystem;

constexpr const char* kPose = R"("cam_R_m2c":[0,-1,0,1,0,0,0,0,1],"cam_t_m2c":[10,20,1000],)";

/// Images 1, 2 and 5 of a video; objects 7, 3, 3 in each.
class BopSequence : public ForeignSequence {
 protected:
  void SetUp() override {
    std::string cameras = "{";
    std::string truth = "{";
    for (const int image : {1, 2, 5}) {
      const std::string name = "00000" + std::to_string(image);
      WriteDepth("depth/" + name + ".png", static_cast<std::uint16_t>(1000 + image));
      for (int object = 0; object < 3; ++object) {
        WriteMask("mask_visib/" + name + "_00000" + std::to_string(object) + ".png",
                  static_cast<std::uint8_t>(10 + object));
        WriteMask("mask/" + name + "_00000" + std::to_string(object) + ".png", 255);
      }
      const std::string key = (image > 1 ? ",\"" : "\"") + std::to_string(image) + "\":";
      cameras += key + R"({"cam_K":[50)" + std::to_string(image) +
                 R"(.0,0,20.5,0,510.0,15.5,0,0,1],"depth_scale":0.1,"view_level":4,)" +
                 R"("cam_R_w2c":[1,0,0,0,1,0,0,0,1],"cam_t_w2c":[0,0,)" +
                 std::to_string(100 * image) + "]}";
      truth += key + "[{" + kPose + R"("obj_id":7},{)" + kPose + R"("obj_id":3},{)" + kPose +
               R"("obj_id":3}])";
    }
    dir_.Write("scene_camera.json", cameras + "}");
    dir_.Write("scene_gt.json", truth + "}");
  }
  [[nodiscard]] ReplayOptions Replay(const std::string& object = "7") const {
    ReplayOptions options;
    options.dir = dir_.path();
    options.rate_hz = 25.0;
    options.object = object;
    return options;
  }
};

TEST_F(BopSequence, IsPlayedWithTheCameraAndUnitOfEachImage) {
  const std::vector<CopiedFrame> frames = Play(Replay());
  ASSERT_EQ(frames.size(), 3U);
  const int images[] = {1, 2, 5};
  for (std::size_t i = 0; i < 3; ++i) {
    const DepthFrame& frame = frames[i].frame;
    ASSERT_TRUE(frames[i].fault.ok()) << frames[i].fault.message;
    EXPECT_EQ(frame.camera.fx_px, 500.0F + static_cast<float>(images[i]));
    EXPECT_EQ(frame.camera.cy_px, 15.5F);
    EXPECT_EQ(frame.depth.unit_m, 1e-4F) << "depth_scale is in millimetres";
    EXPECT_EQ(frame.stamp_ns - frames[0].frame.stamp_ns, StampNs{40'000'000} * (images[i] - 1))
        << "left-out images take their time too";
    EXPECT_FALSE(frame.has_T_wc) << "poses are used only when asked for";
    EXPECT_EQ(frames[i].mask.front(), 10);
  }
}

TEST_F(BopSequence, CameraPoses_AreTheInverseOfWorldToCameraInMetres) {
  ReplayOptions options = Replay();
  options.world_poses = WorldPoses::kGiven;
  const std::vector<CopiedFrame> frames = Play(options);
  ASSERT_EQ(frames.size(), 3U);
  EXPECT_LT((frames[2].frame.T_wc.translation() - Vec3(0.0F, 0.0F, -0.5F)).norm(), 1e-6F);
  dir_.Write("scene_camera.json", R"({"1":{"cam_K":[500,0,20,0,500,15,0,0,1],"depth_scale":1.0}})");
  ExpectRefused(options, Status::kNotFound, "cam_R_w2c");
}

TEST_F(BopSequence, WithoutRate_IsRefused) {
  ReplayOptions options = Replay();
  options.rate_hz.reset();
  ExpectRefused(options, Status::kInvalidUri, "fps=");
}

TEST_F(BopSequence, Masks_AreThoseOfTheObjectAskedFor) {
  EXPECT_EQ(Play(Replay("gt2"))[1].mask.front(), 12);
  ReplayOptions options = Replay();
  options.mask_set = "mask";
  EXPECT_EQ(Play(options)[1].mask.front(), 255);
  options.mask_set = "none";
  EXPECT_TRUE(Play(options)[1].mask.empty());
  EXPECT_EQ(Play(Replay("gt1+7"))[0].mask.front(), 1) << "the first wins where masks overlap";
}

TEST_F(BopSequence, ChoiceThatNamesNoObjectOrSeveral_IsRefusedWithThoseThereAre) {
  for (const char* wanted : {"", "3", "box", "gt", "gtx", "-1"}) {
    ExpectRefused(Replay(wanted), Status::kNotFound, "7 gt1 gt2");
  }
  for (const char* wanted : {"4", "gt3"}) {
    ExpectRefused(Replay(wanted), Status::kNotFound, wanted);
  }
}

TEST_F(BopSequence, MissingFiles_AreNamedInFull) {
  fs::remove(dir_.path() / "depth" / "000002.png");
  fs::remove(dir_.path() / "mask_visib" / "000005_000000.png");
  const std::vector<CopiedFrame> frames = Play(Replay());
  ASSERT_EQ(frames.size(), 3U);
  EXPECT_NE(std::string(frames[1].fault.message).find("depth/000002.png"), std::string::npos);
  EXPECT_NE(std::string(frames[2].fault.message).find("mask_visib/000005_000000.png"),
            std::string::npos);
  fs::remove(dir_.path() / "scene_gt.json");
  ExpectRefused(Replay(), Status::kNotFound, "scene_gt.json");
}

TEST_F(BopSequence, BadCameras_AreNamedWithTheirImage) {
  const std::pair<const char*, const char*> cases[] = {
      {R"({"4":{"depth_scale":1.0}})", "image 4"},
      {R"({"4":{"cam_K":[1,2,3],"depth_scale":1.0}})", "image 4"},
      {R"({"4":{"cam_K":[0,0,20,0,500,15,0,0,1],"depth_scale":1.0}})", "image 4"},
      {R"({"4":{"cam_K":[500,9,20,0,500,15,0,0,1],"depth_scale":1.0}})", "image 4"},
      {R"({"4":{"cam_K":[500,0,20,0,500,15,0,0,1],"depth_scale":0}})", "image 4"},
      {R"({"four":{"cam_K":[500,0,20,0,500,15,0,0,1],"depth_scale":1}})", "four"},
      {R"({"9999999999":{}})", "9999999999"},
      {R"({"4":{"cam_K":[500,0,20)", "JSON"},
      {"{}", "no image"},
      {"[]", "no image"},
      {"1", "no image"},
      {"", "JSON"},
  };
  for (const auto& [text, named] : cases) {
    dir_.Write("scene_camera.json", text);
    const hal::Fault fault = ReplaySensor(Replay()).Open();
    EXPECT_FALSE(fault.ok()) << text;
    for (const char* part : {"scene_camera.json", named}) {
      EXPECT_NE(std::string(fault.message).find(part), std::string::npos) << fault.message;
    }
  }
}

TEST_F(BopSequence, Truth_IsInMetresAndBadOneIsNamed) {
  BopObjects objects;
  ASSERT_TRUE(ReadBopObjects(dir_.path(), objects).ok());
  ASSERT_EQ(objects[5].size(), 3U);
  EXPECT_EQ(objects[5][0].id, 7);
  const Vec3d x_c = objects[5][0].T_co * Vec3d(1.0, 0.0, 0.0);
  EXPECT_LT((x_c - Vec3d(0.01, 1.02, 1.0)).norm(), 1e-12);
  for (const char* text :
       {R"({"5":[{"cam_t_m2c":[0,0,1],"obj_id":1}]})",
        R"({"5":[{"cam_R_m2c":[2,0,0,0,1,0,0,0,1],"cam_t_m2c":[0,0,1],"obj_id":1}]})",
        R"({"5":[{"cam_R_m2c":[1,0,0,0,1,0,0,0,1],"cam_t_m2c":[0,0,1]}]})"}) {
    dir_.Write("scene_gt.json", text);
    BopObjects none;
    const hal::Fault fault = ReadBopObjects(dir_.path(), none);
    EXPECT_EQ(fault.status, Status::kCorrupt);
    EXPECT_NE(std::string(fault.message).find("scene_gt.json: image 5"), std::string::npos)
        << fault.message;
  }
}

}  // namespace
}  // namespace disflow::host
