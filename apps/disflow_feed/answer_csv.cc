// SPDX-License-Identifier: BSD-3-Clause
#include "answer_csv.h"

#include <cerrno>
#include <cmath>
#include <cstring>

namespace disflow::apps {
namespace {

using hal::mavlink::Odometry;

/// The body's axes (x forward, y right, z down) to the optical ones (x right, y down, z forward).
Vec3 Optical(float x, float y, float z) { return {y, z, x}; }

/// "ok", or what the numbers are worth: see docs/wire-format.md.
const char* VerdictOf(const BoardAnswer& answer) {
  if (answer.odometry.quality != Odometry::kQualityFailed) return "ok";
  return Name(std::isfinite(answer.odometry.x) ? EstimateKind::kPredicted : EstimateKind::kRefused);
}

}  // namespace

PoseCameraFromObject PoseOf(const Odometry& odometry) {
  Mat3 R_cf;
  R_cf << 0.0F, 1.0F, 0.0F, 0.0F, 0.0F, 1.0F, 1.0F, 0.0F, 0.0F;
  const Eigen::Quaternion<float, Eigen::DontAlign> q(odometry.q[0], odometry.q[1], odometry.q[2],
                                                     odometry.q[3]);
  return {Mat3(R_cf * q.toRotationMatrix()), Optical(odometry.x, odometry.y, odometry.z)};
}

Twist TwistOf(const Odometry& odometry) {
  return {Optical(odometry.vx, odometry.vy, odometry.vz),
          Optical(odometry.rollspeed, odometry.pitchspeed, odometry.yawspeed)};
}

hal::Fault AnswerCsv::Open(const std::string& path) {
  path_ = path;
  file_.reset(std::fopen(path.c_str(), "w"));
  if (file_ == nullptr) {
    return hal::MakeFault(Status::kIoError, "%s: cannot be written: %s", path.c_str(),
                          std::strerror(errno));
  }
  (void)std::fputs(
      "frame,timestamp,x,y,z,qx,qy,qz,qw,vx,vy,vz,wx,wy,wz,status,state,quality,reset_counter,"
      "segment_ms,sample_ms,register_ms,filter_ms,fuse_ms,retrain_ms,total_ms\n",
      file_.get());
  return {};
}

void AnswerCsv::Add(std::int64_t index, StampNs stamp_ns, const BoardAnswer& answer) {
  if (file_ == nullptr || !answer.tracked) return;
  std::FILE* const out = file_.get();
  const auto print = [out](float value) {
    (void)std::fprintf(out, ",%.9g", static_cast<double>(value));
  };
  (void)std::fprintf(out, "%lld,%.9f", static_cast<long long>(index),
                     static_cast<double>(stamp_ns) * 1e-9);
  const PoseCameraFromObject T_co = PoseOf(answer.odometry);
  const Eigen::Quaternion<float, Eigen::DontAlign> q(T_co.rotation());
  const Twist twist = TwistOf(answer.odometry);
  for (const float value : T_co.translation()) print(value);
  for (const float value : {q.x(), q.y(), q.z(), q.w()}) print(value);
  for (const float value : twist.linear_mps) print(value);
  for (const float value : twist.angular_rps) print(value);
  (void)std::fprintf(out, ",%s,%s,%d,%d", VerdictOf(answer),
                     Name(static_cast<TrackingState>(answer.status.state)),
                     int{answer.odometry.quality}, int{answer.odometry.reset_counter});
  for (const std::uint64_t ns : answer.timing.stage_ns) print(static_cast<float>(ns) * 1e-6F);
  print(static_cast<float>(answer.timing.frame_ns) * 1e-6F);
  (void)std::fputc('\n', out);
}

hal::Fault AnswerCsv::Close() {
  if (file_ == nullptr) return {};
  std::FILE* const file = file_.release();
  const bool bad = std::ferror(file) != 0;
  if (std::fclose(file) != 0 || bad) {
    return hal::MakeFault(Status::kIoError, "%s: not all could be written; is the disk full?",
                          path_.c_str());
  }
  return {};
}

}  // namespace disflow::apps
