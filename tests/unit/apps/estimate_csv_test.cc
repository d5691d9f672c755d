// SPDX-License-Identifier: BSD-3-Clause
#include "estimate_csv.h"

#include <gtest/gtest.h>

#include <cmath>

#include "errors.h"
#include "scratch_dir.h"

namespace disflow::apps {
namespace {

using testing::IsSubstring;

constexpr const char* kHeader = "frame,timestamp,x,y,z,qx,qy,qz,qw,vx,vy,vz,wx,wy,wz";
constexpr const char* kRow = ",0.5,1,2,3,0,0,0,1,4,5,6,7,8,9";

class EstimateCsvTest : public testing::Test {
 protected:
  EstimateTable Load(const std::string& text, int frames = 10) {
    return LoadEstimates(dir_.Write("run.csv", text), frames);
  }
  std::string Refusal(const std::string& text, int frames = 10) {
    return MessageOf<InputError>([&] { (void)Load(text, frames); });
  }

  ScratchDir dir_;
};

TEST_F(EstimateCsvTest, PlainRow_IsReadAsWritten) {
  const EstimateTable table = Load(std::string(kHeader) + "\n3" + kRow + "\n");
  ASSERT_EQ(table.rows.size(), 1U);
  const EstimateRow& row = table.rows[0];
  EXPECT_EQ(row.frame, 3);
  EXPECT_DOUBLE_EQ(row.timestamp_s, 0.5);
  EXPECT_EQ(row.T_co.translation(), Vec3d(1, 2, 3));
  EXPECT_TRUE(row.T_co.rotation().isIdentity());
  EXPECT_EQ(row.twist.linear_mps, Vec3d(4, 5, 6));
  EXPECT_EQ(row.twist.angular_rps, Vec3d(7, 8, 9));
  EXPECT_FALSE(row.pose_covariance.has_value());
}

TEST_F(EstimateCsvTest, QuaternionOrder_IsXyzw) {
  const EstimateTable table =
      Load(std::string(kHeader) + "\n0,0,0,0,0,0.7071068,0,0,0.7071068,0,0,0,0,0,0\n");
  // A quarter turn about x takes y to z.
  EXPECT_TRUE((table.rows[0].T_co * Vec3d(0, 1, 0)).isApprox(Vec3d(0, 0, 1), 1e-6));
}

TEST_F(EstimateCsvTest, OtherOrderExtraColumnsAndCrLf_AreAccepted) {
  const EstimateTable table = Load(
      "note,wz,wy,wx,vz,vy,vx,qw,qz,qy,qx,z,y,x,timestamp,frame,status,state,total_ms,fit_ms\r\n"
      "hi,9,8,7,6,5,4,1,0,0,0,3,2,1,0.5,3,ok,tracking,1.25,\r\n");
  const EstimateRow& row = table.rows.at(0);
  EXPECT_EQ(row.frame, 3);
  EXPECT_EQ(row.T_co.translation(), Vec3d(1, 2, 3));
  EXPECT_EQ(row.twist.angular_rps, Vec3d(7, 8, 9));
  EXPECT_EQ(row.status, "ok");
  EXPECT_EQ(row.state, "tracking");
  ASSERT_EQ(table.stage_names, (std::vector<std::string>{"total", "fit"}));
  EXPECT_DOUBLE_EQ(row.stage_ms[0], 1.25);
  EXPECT_TRUE(std::isnan(row.stage_ms[1]));
  EXPECT_EQ(table.FindStage("fit"), 1U);
  EXPECT_FALSE(table.FindStage("none").has_value());
}

TEST_F(EstimateCsvTest, RefusedFrame_HasNoMotion) {
  const std::string header = std::string(kHeader) + ",status\n";
  const std::string nans = ",nan,nan,nan,nan,nan,nan,nan,nan,nan,nan,nan,nan,nan";
  const EstimateTable table = Load(header + "0,0.5" + nans + ",stamp_not_increasing\n");
  EXPECT_FALSE(table.rows.at(0).has_motion);
  EXPECT_EQ(table.rows.at(0).status, "stamp_not_increasing");
  EXPECT_NE(Refusal(header + "0,0.5" + nans + ",ok\n"), "") << "what is ok has a pose";
  EXPECT_NE(Refusal(std::string(kHeader) + "\n0,0.5" + nans + "\n"), "");
}

TEST_F(EstimateCsvTest, CovarianceColumns_BecomeASymmetricMatrix) {
  std::string header = kHeader;
  std::string row = "0";
  row += kRow;
  for (int i = 0; i < 21; ++i) {
    header += ",cov_pose_" + std::to_string(i);
    row += ",";
    row += std::to_string(i + 1);
  }
  const EstimateTable table = Load(header + "\n" + row + "\n");
  ASSERT_TRUE(table.rows[0].pose_covariance.has_value());
  const Mat6d& covariance = *table.rows[0].pose_covariance;
  EXPECT_EQ(covariance(0, 5), 6.0);  // end of the first row of the triangle
  EXPECT_EQ(covariance(1, 1), 7.0);  // start of the second
  EXPECT_EQ(covariance(5, 5), 21.0);
  EXPECT_TRUE(covariance.isApprox(covariance.transpose()));
  EXPECT_FALSE(table.rows[0].twist_covariance.has_value());
}

TEST_F(EstimateCsvTest, IncompleteCovarianceColumns_AreRefused) {
  const std::string text = std::string(kHeader) + ",cov_twist_0\n0" + kRow + ",1\n";
  EXPECT_NE(Refusal(text).find("cov_twist_"), std::string::npos);
}

TEST_F(EstimateCsvTest, MissingColumn_IsNamed) {
  const std::string message =
      Refusal("frame,timestamp,x,y,z,qx,qy,qz,qw,vx,vy,vz,wx,wy\n0,0,0,0,0,0,0,0,1,0,0,0,0,0\n");
  EXPECT_PRED_FORMAT2(IsSubstring, "run.csv:1: column wz is missing", message);
}

TEST_F(EstimateCsvTest, ColumnTwice_IsRefused) {
  const std::string text = std::string(kHeader) + ",x\n0" + kRow + ",1\n";
  EXPECT_PRED_FORMAT2(IsSubstring, "column x is there twice", Refusal(text));
}

TEST_F(EstimateCsvTest, ShortRow_IsRefusedWithItsLine) {
  const std::string text = std::string(kHeader) + "\n0" + kRow + "\n1,2,3\n";
  EXPECT_PRED_FORMAT2(IsSubstring, "run.csv:3: holds 3 fields, the header 15", Refusal(text));
}

TEST_F(EstimateCsvTest, WordNanOrTrailingTextInANumber_IsRefusedWithItsColumn) {
  for (const char* bad : {"abc", "nan", "inf", "", "1.0m", "1e999"}) {
    const std::string text = std::string(kHeader) + "\n0,0,0," + bad + ",0,0,0,0,1,0,0,0,0,0,0\n";
    EXPECT_PRED_FORMAT2(IsSubstring, "run.csv:2: field y is", Refusal(text)) << bad;
  }
}

TEST_F(EstimateCsvTest, FrameThatIsNoWholeNumber_IsRefused) {
  for (const char* bad : {"-1", "1.5", "", "99999999999999999999"}) {
    const std::string text = std::string(kHeader) + "\n" + bad + kRow + "\n";
    EXPECT_PRED_FORMAT2(IsSubstring, "field frame is", Refusal(text)) << bad;
  }
}

TEST_F(EstimateCsvTest, QuaternionThatIsNoRotation_IsRefused) {
  const std::string text = std::string(kHeader) + "\n0,0,0,0,0,0,0,0,0,0,0,0,0,0,0\n";
  EXPECT_PRED_FORMAT2(IsSubstring, "quaternion has length 0", Refusal(text));
}

TEST_F(EstimateCsvTest, RepeatedFrame_IsRefused) {
  const std::string text = std::string(kHeader) + "\n4" + kRow + "\n4" + kRow + "\n";
  EXPECT_PRED_FORMAT2(IsSubstring, "run.csv:3: frame 4 follows frame 4", Refusal(text));
}

TEST_F(EstimateCsvTest, FrameBeyondTheSequence_IsRefused) {
  const std::string text = std::string(kHeader) + "\n10" + kRow + "\n";
  EXPECT_PRED_FORMAT2(IsSubstring, "not in the sequence of 10 frames", Refusal(text));
}

TEST_F(EstimateCsvTest, EmptyFileHeaderOnlyAndMissingFile_AreRefused) {
  EXPECT_PRED_FORMAT2(IsSubstring, "holds no frame", Refusal(""));
  EXPECT_PRED_FORMAT2(IsSubstring, "holds no frame", Refusal(std::string(kHeader) + "\n"));
  EXPECT_PRED_FORMAT2(IsSubstring, "cannot be opened", MessageOf<InputError>([&] {
                        (void)LoadEstimates(dir_.path() / "none.csv", 1);
                      }));
}

TEST_F(EstimateCsvTest, BinaryRubbish_IsRefused) {
  EXPECT_FALSE(Refusal(std::string("\x00\xff\n\x01,\x02\n", 7)).empty());
}

}  // namespace
}  // namespace disflow::apps
