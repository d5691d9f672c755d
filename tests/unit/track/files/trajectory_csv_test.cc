// SPDX-License-Identifier: BSD-3-Clause
#include "files/trajectory_csv.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <map>
#include <random>
#include <sstream>

#include "program/exit_status.h"
#include "program/status_token.h"
#include "scratch_folder.h"

namespace disflow::apps {
namespace {

class TrajectoryCsvTest : public test::ScratchFolderTest {
 protected:
  using Row = std::map<std::string, std::string>;

  /// @return The rows written, each value by its column's name.
  std::vector<Row> Write(const std::vector<FrameResult>& results, bool timing = true) {
    {
      TrajectoryCsv csv(Path("run.csv"), timing);
      for (const FrameResult& result : results) EXPECT_TRUE(csv.Write(result));
    }
    std::istringstream text(test::ReadFile(Path("run.csv")));
    std::string line;
    std::getline(text, line);
    const std::vector<std::string> names = Split(line);
    std::vector<Row> rows;
    while (std::getline(text, line)) {
      const std::vector<std::string> values = Split(line);
      EXPECT_EQ(values.size(), names.size());
      Row& row = rows.emplace_back();
      for (std::size_t i = 0; i < std::min(names.size(), values.size()); ++i)
        row[names[i]] = values[i];
      EXPECT_EQ(row.size(), names.size()) << "two columns have one name";
    }
    return rows;
  }

 private:
  static std::vector<std::string> Split(const std::string& line) {
    std::vector<std::string> values(1);
    for (const char c : line) {
      if (c == ',') {
        values.emplace_back();
      } else {
        values.back() += c;
      }
    }
    return values;
  }
};

float Number(const std::string& text) { return std::strtof(text.c_str(), nullptr); }

TEST_F(TrajectoryCsvTest, AnyFloat_IsReadBackToTheLastBit) {
  std::mt19937 random(1);
  const auto any = [&random] {
    for (;;) {
      const auto bits = static_cast<std::uint32_t>(random());
      float value = 0.0F;
      std::memcpy(&value, &bits, sizeof(value));
      if (std::isfinite(value)) return value;
    }
  };
  std::vector<FrameResult> results(200);
  for (FrameResult& result : results) {
    Estimate& estimate = result.estimate;
    estimate.status = Status::kOk;
    for (int i = 0; i < 3; ++i) {
      estimate.twist.linear_mps[i] = any();
      estimate.twist.angular_rps[i] = any();
      estimate.weak.axis[i] = any();
    }
    estimate.score = any();
    estimate.rms_m = any();
    estimate.inverse_depth_std_per_m = any();
    for (int i = 0; i < 36; ++i) estimate.pose_covariance.data()[i] = any();
    for (int i = 0; i < 36; ++i) estimate.twist_covariance.data()[i] = any();
  }
  const std::vector<Row> rows = Write(results);
  ASSERT_EQ(rows.size(), results.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const Estimate& estimate = results[i].estimate;
    const Row& row = rows[i];
    EXPECT_EQ(Number(row.at("vx")), estimate.twist.linear_mps.x());
    EXPECT_EQ(Number(row.at("wz")), estimate.twist.angular_rps.z());
    EXPECT_EQ(Number(row.at("score")), estimate.score);
    EXPECT_EQ(Number(row.at("rms_m")), estimate.rms_m);
    EXPECT_EQ(Number(row.at("noise")), estimate.inverse_depth_std_per_m);
    EXPECT_EQ(Number(row.at("weak_y")), estimate.weak.axis.y());
    int column = 0;
    for (int r = 0; r < 6; ++r) {
      for (int c = r; c < 6; ++c, ++column) {
        const std::string place = std::to_string(column);
        EXPECT_EQ(Number(row.at("cov_pose_" + place)), estimate.pose_covariance(r, c));
        EXPECT_EQ(Number(row.at("cov_twist_" + place)), estimate.twist_covariance(r, c));
      }
    }
  }
}

TEST_F(TrajectoryCsvTest, LongestValues_FitIntoTheRow) {
  FrameResult result;
  result.frame = std::numeric_limits<std::int64_t>::min();
  result.total_ns = std::numeric_limits<std::int64_t>::min();
  result.sensor.dropped = std::numeric_limits<std::uint32_t>::max();
  Estimate& estimate = result.estimate;
  constexpr float kLong = -1.17549449e-38F;
  estimate.stamp_ns = std::numeric_limits<std::int64_t>::min();
  estimate.status = Status::kOk;  // of other frames some numbers are left out
  estimate.state = TrackingState::kInitialising;
  estimate.twist.linear_mps.setConstant(kLong);
  estimate.twist.angular_rps.setConstant(kLong);
  estimate.pose_covariance.setConstant(kLong);
  estimate.twist_covariance.setConstant(kLong);
  estimate.weak.kind = WeakKind::kTranslation;
  estimate.weak.axis.setConstant(kLong);
  estimate.weak.std = estimate.score = estimate.conflict = estimate.visible = kLong;
  estimate.rms_m = estimate.inverse_depth_std_per_m = kLong;
  estimate.stage_ns.fill(std::numeric_limits<std::int64_t>::min());
  const std::vector<Row> rows = Write({result});
  ASSERT_EQ(rows.size(), 1U);
  EXPECT_EQ(rows[0].at("timestamp"), "-9223372036.854775808");
  EXPECT_EQ(rows[0].at("dropped"), "4294967295");
  EXPECT_EQ(Number(rows[0].at("cov_twist_20")), kLong);
}

TEST_F(TrajectoryCsvTest, NotANumberAndInfinity_AreWordsThatReadBack) {
  FrameResult result;
  result.estimate.score = std::numeric_limits<float>::quiet_NaN();
  result.estimate.rms_m = -std::numeric_limits<float>::infinity();
  const std::vector<Row> rows = Write({result});
  EXPECT_TRUE(std::isnan(Number(rows[0].at("score"))));
  EXPECT_EQ(Number(rows[0].at("rms_m")), -std::numeric_limits<float>::infinity());
}

TEST_F(TrajectoryCsvTest, Stamps_AreExactInNanoseconds) {
  std::vector<FrameResult> results;
  for (const std::int64_t stamp_ns :
       {std::int64_t{0}, std::int64_t{1}, std::int64_t{-1}, std::int64_t{1'700'000'000'123'456'789},
        std::numeric_limits<std::int64_t>::max()}) {
    results.emplace_back().estimate.stamp_ns = stamp_ns;
  }
  const std::vector<Row> rows = Write(results);
  ASSERT_EQ(rows.size(), 5U);
  EXPECT_EQ(rows[0].at("timestamp"), "0.000000000");
  EXPECT_EQ(rows[1].at("timestamp"), "0.000000001");
  EXPECT_EQ(rows[2].at("timestamp"), "-0.000000001");
  EXPECT_EQ(rows[3].at("timestamp"), "1700000000.123456789");
  EXPECT_EQ(rows[4].at("timestamp"), "9223372036.854775807");
}

TEST_F(TrajectoryCsvTest, WithoutTiming_AllTimesAreZeroAndNothingElse) {
  FrameResult result;
  result.total_ns = 5'000'000;
  result.estimate.stage_ns.fill(1'000'000);
  result.estimate.stamp_ns = 7;
  const Row timed = Write({result})[0];
  const Row untimed = Write({result}, /*timing=*/false)[0];
  int differing = 0;
  for (const auto& [name, value] : timed) {
    if (untimed.at(name) == value) continue;
    ++differing;
    EXPECT_EQ(untimed.at(name), "0") << name;
    EXPECT_EQ(name.substr(name.size() - 3), "_ms");
  }
  EXPECT_EQ(differing, kStageCount + 1);
}

TEST_F(TrajectoryCsvTest, FileThatCannotBeWritten_IsRefusedAtTheStart) {
  try {
    const TrajectoryCsv csv("/dev/full", true);
    FAIL();
  } catch (const Failure& failure) {
    EXPECT_EQ(failure.status(), kOutputFailed);
  }
}

}  // namespace
}  // namespace disflow::apps
