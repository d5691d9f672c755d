// SPDX-License-Identifier: BSD-3-Clause
#include "conversions.h"

#include <cmath>
#include <cstring>
#include <limits>

namespace disflow::c {
namespace {

template <class To, class From>
void Write(const Transform<To, From>& transform, disflow_pose& pose) noexcept {
  const auto rotation = transform.rotation_quaternion();
  for (int i = 0; i < 3; ++i) pose.position_m[i] = transform.translation()[i];
  pose.quaternion_xyzw[0] = rotation.x();
  pose.quaternion_xyzw[1] = rotation.y();
  pose.quaternion_xyzw[2] = rotation.z();
  pose.quaternion_xyzw[3] = rotation.w();
}

void Write(const Vec3& vector, float (&values)[3]) noexcept {
  for (int i = 0; i < 3; ++i) values[i] = vector[i];
}

void Write(const Mat6& matrix, float (&values)[36]) noexcept {
  for (int i = 0; i < 36; ++i) values[i] = matrix(i / 6, i % 6);
}

void Write(const Counters& counters, disflow_counters& out) noexcept {
  // The same members in the same order; a test compares them one by one.
  static_assert(sizeof(Counters) == sizeof(disflow_counters));
  static_assert(Counters::kCount * sizeof(std::uint32_t) == sizeof(disflow_counters));
  std::memcpy(&out, &counters, sizeof(out));
}

[[nodiscard]] std::ptrdiff_t Stride(std::ptrdiff_t given_bytes, std::int32_t width_px,
                                    int bytes_per_pixel) noexcept {
  return given_bytes != 0 ? given_bytes : std::ptrdiff_t{width_px} * bytes_per_pixel;
}

}  // namespace

template <class To, class From>
Transform<To, From> TransformOf(const disflow_pose& pose) noexcept {
  constexpr float kUnitTolerance = 1e-3F;
  const float* const q = pose.quaternion_xyzw;
  const Eigen::Quaternion<float, Eigen::DontAlign> rotation(q[3], q[0], q[1], q[2]);
  Vec3 position(pose.position_m[0], pose.position_m[1], pose.position_m[2]);
  // Written so that NaN is not.
  if (!(std::abs(rotation.norm() - 1.0F) < kUnitTolerance)) {
    return {Eigen::Quaternion<float, Eigen::DontAlign>::Identity(),
            Vec3::Constant(std::numeric_limits<float>::quiet_NaN())};
  }
  return {rotation.normalized(), position};
}
template Transform<World, Camera> TransformOf(const disflow_pose&) noexcept;
template Transform<Object, Camera> TransformOf(const disflow_pose&) noexcept;

DepthFrame FrameOf(const disflow_frame& frame) noexcept {
  constexpr float kMillimetre_m = 0.001F;
  DepthFrame out;
  const bool is_known =
      frame.depth_format == DISFLOW_DEPTH_FLOAT32 || frame.depth_format == DISFLOW_DEPTH_UINT16;
  // What cannot be read is no image.
  out.depth.data = is_known ? frame.depth : nullptr;
  out.depth.width_px = frame.width_px;
  out.depth.height_px = frame.height_px;
  out.depth.format =
      frame.depth_format == DISFLOW_DEPTH_FLOAT32 ? DepthFormat::kFloat32 : DepthFormat::kUint16;
  out.depth.stride_bytes = Stride(frame.stride_bytes, frame.width_px, out.depth.bytes_per_pixel());
  out.depth.unit_m = frame.unit_m != 0.0F ? frame.unit_m : kMillimetre_m;
  out.camera = {frame.fx_px, frame.fy_px, frame.cx_px, frame.cy_px};
  out.stamp_ns = frame.stamp_ns;
  out.mask.data = frame.mask;
  out.mask.label = frame.mask_label;
  if (frame.mask != nullptr) {
    out.mask.width_px = frame.width_px;
    out.mask.height_px = frame.height_px;
    out.mask.stride_bytes = Stride(frame.mask_stride_bytes, frame.width_px, 1);
  }
  out.has_T_wc = frame.T_wc != nullptr;
  if (out.has_T_wc) out.T_wc = TransformOf<World, Camera>(*frame.T_wc);
  return out;
}

disflow_estimate EstimateOf(const Estimate& estimate) noexcept {
  const Estimate published = Published(estimate);
  disflow_estimate out{};
  out.stamp_ns = published.stamp_ns;
  out.status = static_cast<disflow_status>(published.status);
  out.state = static_cast<std::int32_t>(published.state);
  out.kind = static_cast<std::int32_t>(KindOf(estimate));
  Write(published.T_co, out.T_co);
  Write(published.T_wo, out.T_wo);
  out.has_T_wo = published.has_T_wo ? 1 : 0;
  Write(published.twist.linear_mps, out.linear_mps);
  Write(published.twist.angular_rps, out.angular_rps);
  Write(published.pose_covariance, out.pose_covariance);
  Write(published.twist_covariance, out.twist_covariance);
  out.weak_kind = static_cast<std::int32_t>(published.weak.kind);
  Write(published.weak.axis, out.weak_axis);
  out.weak_std = published.weak.std;
  out.quality = published.quality;
  out.reset_counter = published.reset_counter;
  out.score = published.score;
  out.conflict = published.conflict;
  out.visible = published.visible;
  out.samples = published.samples;
  out.inliers = published.inliers;
  out.edge_inliers = published.edge_inliers;
  out.hypotheses = published.hypotheses;
  out.iterations = published.iterations;
  out.rms_m = published.rms_m;
  out.inverse_depth_std_per_m = published.inverse_depth_std_per_m;
  Write(published.rejected, out.rejected);
  return out;
}

disflow_vertex VertexOf(const SurfaceVertex& vertex) noexcept {
  disflow_vertex out{};
  Write(vertex.position_m, out.position_m);
  Write(vertex.normal, out.normal);
  out.std_m = vertex.std_m;
  return out;
}

}  // namespace disflow::c
