// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>

namespace disflow::posix {

/// A depth camera whose unit its maker documents.
struct CameraModel {
  std::uint16_t vendor_id;
  std::uint16_t product_id;
  const char* name;
  float unit_m;  ///< Of the depth stream as the camera comes out of its box.
};

[[nodiscard]] std::span<const CameraModel> KnownCameraModels() noexcept;

/// @return Null if the model is not known.
[[nodiscard]] const CameraModel* FindCameraModel(std::uint16_t vendor_id,
                                                 std::uint16_t product_id) noexcept;

}  // namespace disflow::posix
