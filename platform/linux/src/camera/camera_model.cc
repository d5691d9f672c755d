// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/posix/camera/camera_model.h"

#include <array>

namespace disflow::posix {
namespace {

constexpr std::uint16_t kIntel = 0x8086;

// The D405 is left out on purpose: its unit differs from its family's.
constexpr std::array kModels{
    CameraModel{kIntel, 0x0AD1, "RealSense D400", 0.001F},
    CameraModel{kIntel, 0x0AD2, "RealSense D410", 0.001F},
    CameraModel{kIntel, 0x0AD3, "RealSense D415", 0.001F},
    CameraModel{kIntel, 0x0AD4, "RealSense D430", 0.001F},
    CameraModel{kIntel, 0x0B07, "RealSense D435", 0.001F},
    CameraModel{kIntel, 0x0B3A, "RealSense D435i", 0.001F},
    CameraModel{kIntel, 0x0B5C, "RealSense D455", 0.001F},
    CameraModel{kIntel, 0x0B64, "RealSense L515", 0.00025F},
    CameraModel{kIntel, 0x0AA5, "RealSense SR300", 0.000125F},
};

}  // namespace

std::span<const CameraModel> KnownCameraModels() noexcept { return kModels; }

const CameraModel* FindCameraModel(std::uint16_t vendor_id, std::uint16_t product_id) noexcept {
  for (const CameraModel& model : kModels) {
    if (model.vendor_id == vendor_id && model.product_id == product_id) return &model;
  }
  return nullptr;
}

}  // namespace disflow::posix
