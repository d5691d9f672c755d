// SPDX-License-Identifier: BSD-3-Clause
#include "sequence.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include "errors.h"
#include "scratch_dir.h"
#include "visibility.h"

namespace disflow::apps {
namespace {

TEST(SequenceTest, Simulation_CarriesTruthModelAndImages) {
  const Sequence sequence = OpenSequence("sim:bottle?motion=fast&frames=6&width=160&height=96");
  ASSERT_EQ(sequence.truth.T_ct.size(), 6U);
  EXPECT_EQ(sequence.truth.twists.size(), 6U);
  EXPECT_EQ(sequence.model_name, "bottle");
  ASSERT_TRUE(sequence.image(5).has_value());
  EXPECT_EQ(sequence.image(5)->depth.width_px, 160);
  // Poses, model and images belong together: the bottle is where its pose says.
  const std::vector<SurfacePoint> points = SampleSurface(*sequence.model, 500);
  std::vector<bool> seen(points.size(), false);
  MarkSeen(*sequence.image(0), sequence.truth.T_ct[0], points, seen);
  const auto seen_count = std::count(seen.begin(), seen.end(), true);
  EXPECT_GT(seen_count, 100);
  EXPECT_LT(seen_count, 350) << "the far side cannot be seen";
}

TEST(SequenceTest, OneOfSeveralSimulatedObjects_IsTheOneAskedFor) {
  const std::string address = "sim:box+bottle?frames=3&width=160&height=96";
  const Sequence box = OpenSequence(address, {}, "box");
  const Sequence bottle = OpenSequence(address, {}, "bottle");
  EXPECT_EQ(bottle.model_name, "bottle");
  EXPECT_GT(bottle.truth.T_ct[0].translation().z(), box.truth.T_ct[0].translation().z() + 0.2);
  for (const char* object : {"", "can"}) {
    EXPECT_PRED_FORMAT2(testing::IsSubstring, "--object one of: box bottle",
                        MessageOf<InputError>([&] { (void)OpenSequence(address, {}, object); }));
  }
}

TEST(SequenceTest, OneOfSeveralRecordedObjects_IsTheOneAskedFor) {
  const ScratchDir dir;
  dir.Write("gt/cup/poses.txt", "0 0 0.5 0 0 1 0\n");
  dir.Write("gt/pen/poses.txt", "0 0 0.7 0 0 1 0\n");
  const auto model = dir.Write("points.xyz", "0 0 0\n0 0 1\n");
  const std::string folder = dir.path().string();
  EXPECT_EQ(OpenSequence(folder, model, "pen").truth.T_ct[0].translation().z(), 0.7);
  for (const char* object : {"", "fork"}) {
    EXPECT_PRED_FORMAT2(testing::IsSubstring, "--object one of: cup pen",
                        MessageOf<InputError>([&] { (void)OpenSequence(folder, model, object); }));
  }
}

TEST(SequenceTest, BopScene_CarriesTruthInMetresAndTheDataSetsModel) {
  const ScratchDir dir;
  const std::string scene = (dir.path() / "test" / "000048").string();
  dir.Write("test/000048/scene_camera.json",
            R"({"3":{"cam_K":[500,0,20,0,500,15,0,0,1],"depth_scale":1},)"
            R"("9":{"cam_K":[500,0,20,0,500,15,0,0,1],"depth_scale":1}})");
  const std::string object = R"({"cam_R_m2c":[1,0,0,0,1,0,0,0,1],"cam_t_m2c":[0,0,750],"obj_id":)";
  dir.Write("test/000048/scene_gt.json", R"({"9":[)" + object + "2}," + object + R"(5}],"3":[)" +
                                             object + "5}," + object + "2}]}");
  EXPECT_PRED_FORMAT2(testing::IsSubstring, "models/obj_000005.ply",
                      MessageOf<InputError>([&] { (void)OpenSequence(scene, {}, "5"); }));
  dir.Write("models/obj_000005.ply",
            "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\n"
            "property float z\nend_header\n0 30 0\n");
  const Sequence sequence = OpenSequence(scene + "/", {}, "5");
  ASSERT_EQ(sequence.truth.T_ct.size(), 2U);
  EXPECT_EQ(sequence.truth.T_ct[1].translation().z(), 0.75);
  EXPECT_EQ(sequence.truth.file_indices, (std::vector<int>{3, 9}));
  EXPECT_TRUE(sequence.truth.stamps_s.empty());
  EXPECT_DOUBLE_EQ(sequence.model->vertices.at(0).y(), 0.03);
  EXPECT_PRED_FORMAT2(testing::IsSubstring, "of: 5 2",
                      MessageOf<InputError>([&] { (void)OpenSequence(scene); }));
  EXPECT_PRED_FORMAT2(testing::IsSubstring, "image 3 does not show",
                      MessageOf<InputError>([&] { (void)OpenSequence(scene, {}, "8"); }));
}

TEST(SequenceTest, DroppedFrames_AreNoFramesOfTheSequence) {
  const Sequence sequence = OpenSequence("sim:box?frames=40&drop=0.5&width=160&height=96");
  EXPECT_LT(sequence.truth.T_ct.size(), 35U);
  ASSERT_EQ(sequence.truth.stamps_s.size(), sequence.truth.T_ct.size());
  const double last_s = sequence.truth.stamps_s.back() - sequence.truth.stamps_s.front();
  EXPECT_GT(last_s, (static_cast<double>(sequence.truth.T_ct.size()) - 1) / 30.0 + 0.01);
}

TEST(SequenceTest, PipeInPlaceOfTheModel_IsRefusedWithoutBeingOpened) {
  const ScratchDir dir;
  dir.Write("gt/poses.txt", "0 0 0.5 0 0 1 0\n");
  ASSERT_EQ(::mkfifo((dir.path() / "gt/model.obj").c_str(), 0600), 0);
  EXPECT_PRED_FORMAT2(testing::IsSubstring, "model.obj: is a pipe",
                      MessageOf<InputError>([&] { (void)OpenSequence(dir.path().string()); }));
}

TEST(SequenceTest, WrongAddresses_AreRefusedBySayingWhatIsAllowed) {
  for (const auto& [address, part] :
       {std::pair("sim:cube", "doughnut"), std::pair("sim:box?motion=slow", "flying"),
        std::pair("sim:obj:/no/such.obj", "such.obj"),
        std::pair("/no/such/folder", "is no folder")}) {
    EXPECT_PRED_FORMAT2(testing::IsSubstring, part,
                        MessageOf<InputError>([a = address] { (void)OpenSequence(a); }));
  }
}

TEST(SequenceTest, FolderWithoutModel_AsksForOneAndTakesIt) {
  const ScratchDir dir;
  dir.Write("gt/poses.txt", "0 0 0.5 0 0 1 0\n");
  const std::string message =
      MessageOf<InputError>([&] { (void)OpenSequence(dir.path().string()); });
  EXPECT_PRED_FORMAT2(testing::IsSubstring, "--model", message);
  const auto model = dir.Write("points.xyz", "0 0 0\n0 0 1\n");
  EXPECT_EQ(OpenSequence(dir.path().string(), model).model->vertices.size(), 2U);
}

}  // namespace
}  // namespace disflow::apps
