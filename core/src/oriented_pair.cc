// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/flow/oriented_pair.h"

#include <cmath>

namespace disflow {
namespace {

/// What of a direction stands across a line.
Vec3 Across(const Vec3& direction, const Vec3& line) noexcept {
  return direction - direction.dot(line) * line;
}

/// Axes along the line and along what of a direction stands across it.
Mat3 Axes(const Vec3& line, const Vec3& direction) noexcept {
  Vec3 across = Across(direction, line);
  const float length = across.norm();
  across = length > 1e-3F ? Vec3(across / length) : Vec3(line.unitOrthogonal());
  Mat3 axes;
  axes << line, across, line.cross(across);
  return axes;
}

}  // namespace

bool OrientedPair::IsLike(const OrientedPair& other, float cosine_tolerance) const noexcept {
  const auto alike = [&](float a, float b) { return std::abs(a - b) <= cosine_tolerance; };
  return alike(normal_a.dot(line), other.normal_a.dot(other.line)) &&
         alike(normal_b.dot(line), other.normal_b.dot(other.line)) &&
         alike(normal_a.dot(normal_b), other.normal_a.dot(other.normal_b));
}

PoseObjectFromCamera OrientedPair::LaidOnto(const OrientedPair& known_o) const noexcept {
  // Sum or difference of the normals, whichever says more of the turn about the line.
  const Vec3 sum = Across(normal_a + normal_b, line);
  const Vec3 difference = Across(normal_a - normal_b, line);
  const float sign = sum.squaredNorm() > difference.squaredNorm() ? 1.0F : -1.0F;
  const Mat3 rotation = Axes(known_o.line, known_o.normal_a + sign * known_o.normal_b) *
                        Axes(line, normal_a + sign * normal_b).transpose();
  return {rotation, Vec3(0.5F * (known_o.a_m + known_o.b_m) - rotation * (0.5F * (a_m + b_m)))};
}

}  // namespace disflow
