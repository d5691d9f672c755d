// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <limits>

/// @file
/// Fixed-size linear algebra types of the library.
///
/// Every alias is unaligned (`Eigen::DontAlign`), so that structs that hold them can be placed
/// anywhere (static memory, stack, a caller's own class) without alignment rules for the caller.

namespace disflow {

template <class Scalar, int kRows, int kCols = 1>
using Mat = Eigen::Matrix<Scalar, kRows, kCols,
                          Eigen::DontAlign | (kRows == 1 && kCols != 1 ? Eigen::RowMajor : 0)>;

using Vec2 = Mat<float, 2>;
using Vec3 = Mat<float, 3>;
using Vec4 = Mat<float, 4>;
using Vec6 = Mat<float, 6>;
using Mat3 = Mat<float, 3, 3>;
using Mat4 = Mat<float, 4, 4>;
using Mat6 = Mat<float, 6, 6>;

/// Nanoseconds on a monotonic clock, see DepthFrame::stamp_ns.
using StampNs = std::int64_t;
inline constexpr StampNs kSecond_ns = 1'000'000'000;

/// The span from one stamp to another, at most as long as the type can tell: stamps come from
/// outside and may be anything.
[[nodiscard]] constexpr StampNs SpanNs(StampNs from_ns, StampNs to_ns) noexcept {
  constexpr StampNs kMin = std::numeric_limits<StampNs>::min();
  constexpr StampNs kMax = std::numeric_limits<StampNs>::max();
  if (from_ns < 0 && to_ns > kMax + from_ns) return kMax;
  if (from_ns > 0 && to_ns < kMin + from_ns) return kMin;
  return to_ns - from_ns;
}

/// A span of time in seconds. Only with float: many controllers compute double by software.
[[nodiscard]] constexpr float Seconds(StampNs span_ns) noexcept {
  return static_cast<float>(span_ns) * 1e-9F;
}

/// Tags that name coordinate frames in types: a Transform<Object, Camera> cannot be mixed up with
/// its inverse.
struct Camera {};  ///< Optical frame: x right, y down, z forward, metres.
struct Object {
};  ///< Rigidly attached to the tracked object; axes parallel to the camera's at the first frame.
struct World {};  ///< Given by the caller through DepthFrame::T_wc.

}  // namespace disflow
