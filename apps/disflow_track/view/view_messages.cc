// SPDX-License-Identifier: BSD-3-Clause
#include "view/view_messages.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "ply_bytes.h"

namespace disflow::apps {
namespace {

constexpr float kPositionUnit_m = 0.00025F;
constexpr float kFlowUnit_mps = 0.00025F;
constexpr float kDistanceUnit_m = 0.00001F;
constexpr float kLargestWord = 65535.0F;
constexpr float kLargestNormal = 127.0F;

/// Every message begins so.
void AppendHeader(ViewMessage kind, int object, std::uint16_t detail, std::size_t count,
                  ViewBytes& bytes) {
  AppendBytes(kind, bytes);
  AppendBytes(static_cast<std::uint8_t>(object), bytes);
  AppendBytes(detail, bytes);
  AppendBytes(static_cast<std::uint32_t>(count), bytes);
}

double SecondsOf(StampNs stamp_ns) { return static_cast<double>(stamp_ns) * 1e-9; }
float Milliseconds(std::int64_t span_ns) { return static_cast<float>(span_ns) * 1e-6F; }

/// @return The smallest number for NaN, which no value within the range gives.
std::int16_t InUnits(float value, float unit) {
  constexpr float kLargest = std::numeric_limits<std::int16_t>::max();
  if (std::isnan(value)) return std::numeric_limits<std::int16_t>::min();
  return static_cast<std::int16_t>(std::lround(std::clamp(value / unit, -kLargest, kLargest)));
}

void AppendInUnits(const Vec3& vector, float unit, ViewBytes& bytes) {
  for (int i = 0; i < 3; ++i) AppendBytes(InUnits(vector[i], unit), bytes);
}

/// @param share 0 to 1; others are clamped.
std::uint16_t AsWord(float share) {
  return static_cast<std::uint16_t>(std::lround(std::clamp(share, 0.0F, 1.0F) * kLargestWord));
}

void AppendDeviations(const Mat6& covariance, ViewBytes& bytes) {
  // In this order NaN stays NaN.
  for (int i = 0; i < 6; ++i) AppendBytes(std::sqrt(std::max(covariance(i, i), 0.0F)), bytes);
}

void AppendFrame(const FrameResult& result, ViewBytes& bytes) {
  const Estimate estimate = Published(result.estimate);
  AppendBytes(SecondsOf(estimate.stamp_ns), bytes);
  AppendBytes(static_cast<std::uint32_t>(result.frame), bytes);
  AppendBytes(estimate.state, bytes);
  AppendBytes(estimate.status, bytes);
  AppendBytes(estimate.quality, bytes);
  AppendBytes(estimate.reset_counter, bytes);
  AppendBytes(estimate.T_co.translation(), bytes);
  const Eigen::Quaternion<float, Eigen::DontAlign> rotation(estimate.T_co.rotation());
  for (const float part : {rotation.w(), rotation.x(), rotation.y(), rotation.z()}) {
    AppendBytes(part, bytes);
  }
  AppendBytes(estimate.twist.linear_mps, bytes);
  AppendBytes(estimate.twist.angular_rps, bytes);
  AppendDeviations(estimate.pose_covariance, bytes);
  AppendDeviations(estimate.twist_covariance, bytes);
  for (const std::int64_t stage_ns : estimate.stage_ns) AppendBytes(Milliseconds(stage_ns), bytes);
  AppendBytes(Milliseconds(result.total_ns), bytes);
  AppendBytes(estimate.samples, bytes);
  AppendBytes(estimate.inliers, bytes);
  AppendBytes(estimate.edge_inliers, bytes);
  AppendBytes(estimate.weak.kind, bytes);
  AppendBytes(estimate.iterations, bytes);
  AppendBytes(estimate.score, bytes);
  AppendBytes(estimate.rms_m, bytes);
}

struct Box {
  Vec3 low_m = Vec3::Zero();
  Vec3 size_m = Vec3::Zero();
};

Box BoundsOf(const std::vector<SurfaceVertex>& vertices) {
  if (vertices.empty()) return {};
  Vec3 low_m = vertices.front().position_m;
  Vec3 high_m = low_m;
  for (const SurfaceVertex& vertex : vertices) {
    low_m = low_m.cwiseMin(vertex.position_m);
    high_m = high_m.cwiseMax(vertex.position_m);
  }
  return {low_m, high_m - low_m};
}

void AppendVertices(const std::vector<SurfaceVertex>& vertices, const Box& box, float largest_std_m,
                    ViewBytes& bytes) {
  for (const SurfaceVertex& vertex : vertices) {
    for (int i = 0; i < 3; ++i) {
      const float size_m = std::max(box.size_m[i], 1e-9F);
      AppendBytes(AsWord((vertex.position_m[i] - box.low_m[i]) / size_m), bytes);
    }
    AppendBytes(AsWord(vertex.std_m / std::max(largest_std_m, 1e-9F)), bytes);
  }
  for (const SurfaceVertex& vertex : vertices) {
    for (int i = 0; i < 3; ++i) {
      const float part = std::clamp(vertex.normal[i], -1.0F, 1.0F) * kLargestNormal;
      AppendBytes(static_cast<std::int8_t>(std::lround(part)), bytes);
    }
    AppendBytes(std::int8_t{0}, bytes);
  }
}

template <class Index>
void AppendTriangles(const std::vector<SurfaceMesh::Triangle>& triangles, ViewBytes& bytes) {
  for (const SurfaceMesh::Triangle& triangle : triangles) {
    for (const std::uint32_t index : triangle) AppendBytes(static_cast<Index>(index), bytes);
  }
}

}  // namespace

ViewBytes EncodeText(ViewMessage kind, int object, std::string_view json) {
  ViewBytes bytes;
  AppendHeader(kind, object, 0, json.size(), bytes);
  const std::size_t header_bytes = bytes.size();
  bytes.resize(header_bytes + json.size());
  std::copy(json.begin(), json.end(), bytes.data() + header_bytes);
  return bytes;
}

ViewBytes EncodeFrames(int object, std::span<const FrameResult> results) {
  ViewBytes bytes;
  bytes.reserve(8 + results.size() * kFrameRecordBytes);
  AppendHeader(ViewMessage::kFrames, object, kFrameRecordBytes, results.size(), bytes);
  for (const FrameResult& result : results) AppendFrame(result, bytes);
  return bytes;
}

ViewBytes EncodeSurface(int object, StampNs stamp_ns, const SurfaceMesh& mesh) {
  const auto& vertices = mesh.vertices();
  const bool is_small = vertices.size() <= std::numeric_limits<std::uint16_t>::max();
  const std::size_t index_bytes = is_small ? sizeof(std::uint16_t) : sizeof(std::uint32_t);
  float largest_std_m = 0.0F;
  for (const SurfaceVertex& vertex : vertices) {
    largest_std_m = std::max(largest_std_m, vertex.std_m);
  }
  const SurfaceMesh::StdRange range = mesh.ColouredRange();
  const Box box = BoundsOf(vertices);
  ViewBytes bytes;
  bytes.reserve(56 + 12 * vertices.size() + 3 * index_bytes * mesh.triangles().size());
  AppendHeader(ViewMessage::kSurface, object, static_cast<std::uint16_t>(index_bytes),
               vertices.size(), bytes);
  AppendBytes(static_cast<std::uint32_t>(mesh.triangles().size()), bytes);
  AppendBytes(range.low_m, bytes);
  AppendBytes(range.high_m, bytes);
  AppendBytes(largest_std_m, bytes);
  AppendBytes(SecondsOf(stamp_ns), bytes);
  AppendBytes(box.low_m, bytes);
  AppendBytes(box.size_m, bytes);
  AppendVertices(vertices, box, largest_std_m, bytes);
  if (is_small) {
    AppendTriangles<std::uint16_t>(mesh.triangles(), bytes);
  } else {
    AppendTriangles<std::uint32_t>(mesh.triangles(), bytes);
  }
  return bytes;
}

ViewBytes EncodeFlow(int object, StampNs stamp_ns, const FlowCloud& flow) {
  const auto& samples = flow.samples();
  const std::size_t step =
      std::max<std::size_t>(1, (samples.size() + kShownFlowSamples - 1) / kShownFlowSamples);
  constexpr std::uint16_t kSampleBytes = 16;
  ViewBytes bytes;
  AppendHeader(ViewMessage::kFlow, object, kSampleBytes, (samples.size() + step - 1) / step, bytes);
  AppendBytes(SecondsOf(stamp_ns), bytes);
  for (std::size_t i = 0; i < samples.size(); i += step) {
    AppendInUnits(samples[i].position_m, kPositionUnit_m, bytes);
    AppendInUnits(samples[i].flow_mps, kFlowUnit_mps, bytes);
    AppendBytes(InUnits(samples[i].distance_m, kDistanceUnit_m), bytes);
    AppendBytes(std::uint16_t{0}, bytes);
  }
  return bytes;
}

ViewBytes EncodeDepth(int object, const DepthPicture& picture) {
  const auto pixels = static_cast<std::size_t>(picture.width_px() * picture.height_px());
  const std::span depth_mm = std::span(picture.depth_mm()).first(pixels);
  std::uint16_t nearest_mm = std::numeric_limits<std::uint16_t>::max();
  std::uint16_t farthest_mm = 0;
  for (const std::uint16_t value_mm : depth_mm) {
    if (value_mm == 0) continue;
    nearest_mm = std::min(nearest_mm, value_mm);
    farthest_mm = std::max(farthest_mm, value_mm);
  }
  nearest_mm = std::min(nearest_mm, farthest_mm);
  const int range_mm = std::max(1, farthest_mm - nearest_mm);
  ViewBytes bytes;
  bytes.reserve(12 + pixels + pixels / 8 + 1);
  AppendHeader(ViewMessage::kDepth, object, static_cast<std::uint16_t>(picture.width_px()),
               static_cast<std::size_t>(picture.height_px()), bytes);
  AppendBytes(nearest_mm, bytes);
  AppendBytes(farthest_mm, bytes);
  for (const std::uint16_t value_mm : depth_mm) {
    // 0 is kept for pixels without depth.
    const int level = value_mm == 0 ? 0 : 1 + 254 * (value_mm - nearest_mm) / range_mm;
    bytes.push_back(static_cast<std::uint8_t>(level));
  }
  for (std::size_t i = 0; i < pixels; i += 8) {
    unsigned bits = 0;
    for (std::size_t k = i; k < std::min(i + 8, pixels); ++k) {
      bits |= static_cast<unsigned>(picture.object()[k] != 0) << (k - i);
    }
    bytes.push_back(static_cast<std::uint8_t>(bits));
  }
  return bytes;
}

std::optional<ObjectChoice> DecodeChoice(std::span<const std::uint8_t> command) noexcept {
  if (command.size() < kViewLongCommandBytes) return std::nullopt;
  const auto share = [command](std::size_t at) {
    return static_cast<float>(command[at] | command[at + 1] << 8) /
           static_cast<float>(std::numeric_limits<std::uint16_t>::max());
  };
  ObjectChoice choice;
  choice.u = share(4);
  choice.v = share(6);
  choice.reach = share(8);
  choice.width = share(10);
  choice.height = share(12);
  const bool is_box = choice.width > 0.0F && choice.height > 0.0F;
  choice.kind = is_box ? ObjectChoice::Kind::kBox : ObjectChoice::Kind::kPixel;
  return choice;
}

std::optional<ViewSetting> DecodeSetting(std::span<const std::uint8_t> command) noexcept {
  if (command.size() < kViewLongCommandBytes) return std::nullopt;
  ViewSetting setting;
  std::memcpy(&setting.number, command.data() + 2, sizeof(setting.number));
  std::memcpy(&setting.value, command.data() + 4, sizeof(setting.value));
  return setting;
}

}  // namespace disflow::apps
