// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "disflow/host/png_image.h"
#include "recorded_sequence.h"

namespace disflow::host {

/// A folder of small images in the layout of somebody else.
class ForeignSequence : public testing::Test {
 protected:
  static constexpr int kWidth_px = 40;
  static constexpr int kHeight_px = 30;

  void WriteDepth(const std::string& name, std::uint16_t value) const {
    const std::filesystem::path file = dir_.path() / name;
    std::filesystem::create_directories(file.parent_path());
    const std::vector<std::uint16_t> pixels(kWidth_px * kHeight_px, value);
    ASSERT_TRUE(WriteGray16Png(file, pixels, kWidth_px, kHeight_px).ok());
  }
  void WriteMask(const std::string& name, std::uint8_t value) const {
    const std::filesystem::path file = dir_.path() / name;
    std::filesystem::create_directories(file.parent_path());
    const std::vector<std::uint8_t> pixels(kWidth_px * kHeight_px, value);
    ASSERT_TRUE(WriteGray8Png(file, pixels.data(), kWidth_px, kHeight_px, kWidth_px).ok());
  }

  [[nodiscard]] static std::vector<CopiedFrame> Play(const ReplayOptions& options) {
    ReplaySensor sensor(options);
    const hal::Fault opened = sensor.Open();
    EXPECT_TRUE(opened.ok()) << opened.message;
    return PlayAll(sensor);
  }
  static void ExpectRefused(const ReplayOptions& options, Status status, const std::string& named) {
    const hal::Fault fault = ReplaySensor(options).Open();
    EXPECT_EQ(fault.status, status) << fault.message;
    EXPECT_NE(std::string(fault.message).find(named), std::string::npos) << fault.message;
  }

  apps::ScratchDir dir_;
};

}  // namespace disflow::host
