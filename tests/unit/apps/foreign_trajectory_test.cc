// SPDX-License-Identifier: BSD-3-Clause
#include "foreign_trajectory.h"

#include <gtest/gtest.h>

#include "errors.h"
#include "scratch_dir.h"

namespace disflow::apps {
namespace {

using testing::IsSubstring;

constexpr const char* kBopHeader = "scene_id,im_id,obj_id,score,R,t,time\n";
constexpr const char* kTurned = "0 -1 0 1 0 0 0 0 1";  // a quarter turn about z: x goes to y

class ForeignTrajectoryTest : public testing::Test {
 protected:
  ForeignTrajectoryTest() {
    truth_.T_ct.resize(4);
    truth_.stamps_s = {1700000000.0, 1700000000.033, 1700000000.067, 1700000000.1};
    truth_.file_indices = {10, 11, 12, 14};
  }
  EstimateTable Load(const std::string& text, const std::string& object = "") {
    return LoadTrajectory(dir_.Write("run.txt", text), truth_, object);
  }
  std::string Refusal(const std::string& text, const std::string& object = "") {
    return MessageOf<InputError>([&] { (void)Load(text, object); });
  }

  GroundTruth truth_;
  ScratchDir dir_;
};

TEST_F(ForeignTrajectoryTest, Tum_IsMatchedByStamps) {
  const EstimateTable table = Load(
      "# stamp tx ty tz qx qy qz qw\n"
      "1700000000.0670 1 2 3 0 0 0.70710678 0.70710678\n"
      "1700000000.0005 4 5 6 0 0 0 1\n");
  EXPECT_FALSE(table.has_twists);
  ASSERT_EQ(table.rows.size(), 2U);
  EXPECT_EQ(table.rows[0].frame, 0);
  EXPECT_EQ(table.rows[0].T_co.translation(), Vec3d(4, 5, 6));
  EXPECT_EQ(table.rows[1].frame, 2);
  EXPECT_TRUE((table.rows[1].T_co * Vec3d(1, 0, 0)).isApprox(Vec3d(1, 3, 3), 1e-7));
  EXPECT_DOUBLE_EQ(table.rows[1].timestamp_s, 1700000000.067);
}

TEST_F(ForeignTrajectoryTest, TumThatCannotBe_IsRefusedByLine) {
  const std::string good = "1700000000 1 2 3 0 0 0 1\n";
  EXPECT_PRED_FORMAT2(IsSubstring, "run.txt:2: no frame of the sequence has this stamp",
                      Refusal(good + "1700000000.02 1 2 3 0 0 0 1\n"));
  EXPECT_PRED_FORMAT2(IsSubstring, "run.txt:2: holds 7 fields", Refusal(good + "1 2 3 4 5 6 7\n"));
  EXPECT_PRED_FORMAT2(IsSubstring, "run.txt:1: quaternion has length 2",
                      Refusal("1700000000 1 2 3 0 0 0 2\n"));
  EXPECT_PRED_FORMAT2(IsSubstring, "run.txt:1: field 2 is 'nan'",
                      Refusal("1700000000 nan 2 3 0 0 0 1\n"));
  truth_.stamps_s.clear();
  EXPECT_PRED_FORMAT2(IsSubstring, "the sequence has none", Refusal(good));
}

TEST_F(ForeignTrajectoryTest, Bop_IsMatchedByImagesAndTakesTheBestScore) {
  const EstimateTable table =
      Load(std::string(kBopHeader) + "48,12,2,0.5," + kTurned + ",100 0 500,0.25\n" +
               "48,14,2,0.1,1 0 0 0 1 0 0 0 1,1 2 3,0.5\n" + "48,14,2,0.9," + kTurned +
               ",7 8 9,0.75\n" + "48,12,3,1,1 0 0 0 1 0 0 0 1,0 0 0,0.1\n",
           "2");
  ASSERT_EQ(table.rows.size(), 2U);
  EXPECT_EQ(table.rows[0].frame, 2);
  EXPECT_TRUE((table.rows[0].T_co * Vec3d(1, 0, 0)).isApprox(Vec3d(0.1, 1, 0.5), 1e-9));
  EXPECT_EQ(table.rows[1].frame, 3);
  EXPECT_TRUE(table.rows[1].T_co.translation().isApprox(Vec3d(0.007, 0.008, 0.009), 1e-12));
  ASSERT_EQ(table.stage_names, std::vector<std::string>{"total"});
  EXPECT_DOUBLE_EQ(table.rows[1].stage_ms[0], 750.0);
  EXPECT_FALSE(table.has_twists);
}

TEST_F(ForeignTrajectoryTest, BopWithoutTimes_HasNone) {
  const EstimateTable table = Load(std::string(kBopHeader) + "1,10,1,1," + kTurned + ",1 2 3,-1\n");
  EXPECT_TRUE(table.stage_names.empty());
}

TEST_F(ForeignTrajectoryTest, BopThatCannotBe_IsRefusedByLine) {
  const auto refusal = [this](const std::string& rows, const char* object = "") {
    return Refusal(kBopHeader + rows, object);
  };
  const std::string good = std::string("1,10,1,1,") + kTurned + ",1 2 3,-1\n";
  EXPECT_PRED_FORMAT2(IsSubstring, "run.txt:3: is of another scene or object",
                      refusal(good + "1,11,2,1," + kTurned + ",1 2 3,-1\n"));
  EXPECT_PRED_FORMAT2(IsSubstring, "run.txt:2: image 13 is not in the sequence",
                      refusal(std::string("1,13,1,1,") + kTurned + ",1 2 3,-1\n"));
  EXPECT_PRED_FORMAT2(IsSubstring, "R is no rotation",
                      refusal("1,10,1,1,1 0 0 0 1 0 0 0 -1,1 2 3,-1\n"));
  EXPECT_PRED_FORMAT2(IsSubstring, "field R does not hold 9 numbers",
                      refusal("1,10,1,1,1 0 0,1 2 3,-1\n"));
  EXPECT_PRED_FORMAT2(IsSubstring, "field t does not hold 3 numbers",
                      refusal(std::string("1,10,1,1,") + kTurned + ",1 2 inf,-1\n"));
  EXPECT_PRED_FORMAT2(IsSubstring, "holds 6 fields", refusal("1,10,1,1,1 0 0,1 2 3\n"));
  EXPECT_PRED_FORMAT2(IsSubstring, "holds no pose of this object", refusal(good, "7"));
  EXPECT_PRED_FORMAT2(IsSubstring, "holds no pose of this object", refusal(""));
}

TEST_F(ForeignTrajectoryTest, OwnCsv_IsReadAsEver) {
  const EstimateTable table = Load(
      "frame,timestamp,x,y,z,qx,qy,qz,qw,vx,vy,vz,wx,wy,wz\n3,0.5,1,2,3,0,0,0,1,4,5,6,7,8,9\n");
  EXPECT_TRUE(table.has_twists);
  EXPECT_EQ(table.rows.at(0).twist.linear_mps, Vec3d(4, 5, 6));
}

TEST_F(ForeignTrajectoryTest, NothingAndRubbish_AreRefused) {
  EXPECT_FALSE(Refusal("").empty());
  EXPECT_FALSE(Refusal("# nothing\n").empty());
  EXPECT_FALSE(Refusal(std::string("\0\xff\n,,\n", 6)).empty());
}

}  // namespace
}  // namespace disflow::apps
