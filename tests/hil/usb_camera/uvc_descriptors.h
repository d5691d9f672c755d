// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace disflow::hil {

using Bytes = std::vector<std::uint8_t>;

/// What the emulated camera is: one bulk stream with one format at one size.
struct CameraModelOptions {
  std::uint16_t vendor_id = 0x1209;  ///< pid.codes' number for tests.
  std::uint16_t product_id = 0x0001;
  std::string serial = "DISFLOW-TEST-1";
  std::string format = "Z16";
  int width_px = 320;
  int height_px = 240;
  int rate_hz = 30;
  std::string attach_file = "/sys/devices/platform/vhci_hcd.0/attach";  ///< Of vhci_hcd.

  [[nodiscard]] std::uint32_t image_bytes() const {
    const int planes = format == "INZI" ? 2 : 1;
    return static_cast<std::uint32_t>(width_px * height_px * 2 * planes);
  }
  [[nodiscard]] std::uint32_t interval_100ns() const {
    return static_cast<std::uint32_t>(10'000'000 / rate_hz);
  }
  /// A payload holds a whole image behind its header.
  static constexpr std::uint32_t kPayloadHeader = 2;
  [[nodiscard]] std::uint32_t payload_bytes() const { return image_bytes() + kPayloadHeader; }
};

inline constexpr std::uint8_t kStreamEndpoint = 1;  ///< Number; to the host.
inline constexpr std::uint8_t kStreamInterface = 1;

/// @return false if the format is not known.
[[nodiscard]] bool KnowsFormat(const std::string& format);

[[nodiscard]] Bytes DeviceDescriptor(const CameraModelOptions& options);
[[nodiscard]] Bytes ConfigurationDescriptor(const CameraModelOptions& options);
/// @param index 0 = languages.
[[nodiscard]] Bytes StringDescriptor(const CameraModelOptions& options, int index);
/// UVC 1.0's probe and commit control.
[[nodiscard]] Bytes StreamControl(const CameraModelOptions& options);

}  // namespace disflow::hil
