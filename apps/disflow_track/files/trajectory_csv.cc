// SPDX-License-Identifier: BSD-3-Clause
#include "files/trajectory_csv.h"

#include <array>
#include <charconv>
#include <cmath>
#include <cstring>

#include "disflow/types.h"
#include "program/exit_status.h"
#include "program/status_token.h"

namespace disflow::apps {
namespace {

constexpr int kSignificantDigits = 9;  // gives every float back exactly
constexpr int kTriangle = 21;

/// One row of text in fixed memory.
class Row {
 public:
  void Add(const char* text) noexcept {
    Separate();
    const std::size_t length = std::min(std::strlen(text), Room());
    std::memcpy(text_.data() + size_, text, length);
    size_ += length;
  }
  void Add(std::int64_t value) noexcept {
    Separate();
    Finish(std::to_chars(Here(), End(), value));
  }
  void Add(float value) noexcept {
    if (std::isnan(value)) return Add("nan");  // without the sign that it may have
    Separate();
    Finish(std::to_chars(Here(), End(), value, std::chars_format::general, kSignificantDigits));
  }
  /// Seconds with nine decimals, exact.
  void AddSeconds(std::int64_t value_ns) noexcept {
    Separate();
    const bool negative = value_ns < 0;
    const auto magnitude =
        negative ? 0 - static_cast<std::uint64_t>(value_ns) : static_cast<std::uint64_t>(value_ns);
    const auto seconds = static_cast<unsigned long long>(magnitude / kSecond_ns);
    const auto rest = static_cast<unsigned long long>(magnitude % kSecond_ns);
    const int length =
        std::snprintf(Here(), Room(), "%s%llu.%09llu", negative ? "-" : "", seconds, rest);
    if (length > 0) size_ += static_cast<std::size_t>(length);
  }
  void AddUpperTriangle(const Mat6& matrix) noexcept {
    for (int i = 0; i < 6; ++i) {
      for (int j = i; j < 6; ++j) Add(matrix(i, j));
    }
  }
  [[nodiscard]] std::string_view FinishLine() noexcept {
    text_[size_++] = '\n';
    return {text_.data(), size_};
  }

 private:
  // Every number has at most 24 characters, every word at most 24; there are 88 columns.
  static constexpr std::size_t kCapacity = 4096;

  void Separate() noexcept {
    if (size_ > 0) text_[size_++] = ',';
  }
  [[nodiscard]] char* Here() noexcept { return text_.data() + size_; }
  [[nodiscard]] char* End() noexcept { return text_.data() + kCapacity; }
  [[nodiscard]] std::size_t Room() const noexcept { return kCapacity - size_; }
  void Finish(std::to_chars_result result) noexcept {
    size_ = static_cast<std::size_t>(result.ptr - text_.data());
  }

  std::array<char, kCapacity> text_;
  std::size_t size_ = 0;
};

void AddMotion(const Estimate& estimate, Row& row) noexcept {
  const Vec3& position = estimate.T_co.translation();
  const auto rotation = estimate.T_co.rotation_quaternion();
  const Twist& twist = estimate.twist;
  for (int i = 0; i < 3; ++i) row.Add(position[i]);
  row.Add(rotation.x());
  row.Add(rotation.y());
  row.Add(rotation.z());
  row.Add(rotation.w());
  for (int i = 0; i < 3; ++i) row.Add(twist.linear_mps[i]);
  for (int i = 0; i < 3; ++i) row.Add(twist.angular_rps[i]);
}

void AddVerdict(const Estimate& estimate, Row& row) noexcept {
  row.Add(StatusToken(estimate.status));
  row.Add(Name(estimate.state));
  row.Add(std::int64_t{estimate.quality});
  row.Add(estimate.score);
  row.Add(std::int64_t{estimate.samples});
  row.Add(std::int64_t{estimate.inliers});
  row.Add(std::int64_t{estimate.edge_inliers});
  row.Add(std::int64_t{estimate.hypotheses});
  row.Add(std::int64_t{estimate.iterations});
  row.Add(estimate.rms_m);
  row.Add(std::int64_t{estimate.reset_counter});
}

void AddObservability(const Estimate& estimate, Row& row) noexcept {
  row.Add(estimate.conflict);
  row.Add(estimate.visible);
  row.Add(Name(estimate.weak.kind));
  for (int i = 0; i < 3; ++i) row.Add(estimate.weak.axis[i]);
  row.Add(estimate.weak.std);
}

std::string Header() {
  std::string header =
      "frame,timestamp,x,y,z,qx,qy,qz,qw,vx,vy,vz,wx,wy,wz,status,state,quality,score,samples,"
      "inliers,edge_inliers,hypotheses,iterations,rms_m,reset_counter";
  for (int i = 0; i < kStageCount; ++i) {
    header.append(",").append(Name(static_cast<Stage>(i))).append("_ms");
  }
  header += ",total_ms,noise";
  for (int i = 0; i < kTriangle; ++i) header += ",cov_pose_" + std::to_string(i);
  for (int i = 0; i < kTriangle; ++i) header += ",cov_twist_" + std::to_string(i);
  return header + ",conflict,visible,weak,weak_x,weak_y,weak_z,weak_std,dropped\n";
}

}  // namespace

TrajectoryCsv::TrajectoryCsv(const std::string& path, bool timing) : file_(path), timing_(timing) {
  if (!file_.Append(Header())) {
    throw Failure(kOutputFailed, path + ": cannot be written: " + std::strerror(file_.error()));
  }
}

bool TrajectoryCsv::Write(const FrameResult& result) noexcept {
  const Estimate estimate = Published(result.estimate);
  const auto milliseconds = [this](std::int64_t ns) {
    return timing_ ? static_cast<float>(static_cast<double>(ns) * 1e-6) : 0.0F;
  };
  Row row;
  row.Add(result.frame);
  row.AddSeconds(estimate.stamp_ns);
  AddMotion(estimate, row);
  AddVerdict(estimate, row);
  for (const std::int64_t stage_ns : estimate.stage_ns) row.Add(milliseconds(stage_ns));
  row.Add(milliseconds(result.total_ns));
  row.Add(estimate.inverse_depth_std_per_m);
  row.AddUpperTriangle(estimate.pose_covariance);
  row.AddUpperTriangle(estimate.twist_covariance);
  AddObservability(estimate, row);
  row.Add(std::int64_t{result.sensor.dropped});
  return file_.Append(row.FinishLine());
}

}  // namespace disflow::apps
