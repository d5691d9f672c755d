// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "disflow/hal/depth_sensor.h"
#include "disflow/host/png_image.h"
#include "disflow/host/sequence_layout.h"
#include "disflow/host/uri.h"

namespace disflow::host {

/// `replay:DIR?mask=gt|none|SET&scale=0.001&T_wc=poses&first=0&count=0`
/// @param options Unchanged unless the result is ok.
[[nodiscard]] hal::Fault ParseReplayUri(const Uri& uri, ReplayOptions& options);

/// Plays a recorded sequence, frame by frame, as fast as it is asked to.
///
/// A frame whose file is cut or damaged is lost: Next() says kTruncated or kCorrupt and goes on
/// with the next one. Where a mask set has no image for a frame (slow segmentation networks skip
/// some), the previous mask is held and counted.
class ReplaySensor final : public hal::DepthSensor {
 public:
  explicit ReplaySensor(ReplayOptions options);

  [[nodiscard]] const SequenceLayout& layout() const { return layout_; }
  [[nodiscard]] int held_masks() const { return held_masks_; }

 private:
  hal::Fault DoOpen() noexcept override;
  hal::Fault DoNext(std::int64_t timeout_ns, DepthFrame& frame) noexcept override;
  void DoClose() noexcept override;
  [[nodiscard]] hal::SensorInfo DoInfo() const noexcept override;
  [[nodiscard]] hal::SensorCounters DoCounters() const noexcept override { return counters_; }

  [[nodiscard]] hal::Fault ReadDepth(const SequenceFrame& source, DepthFrame& frame);
  [[nodiscard]] hal::Fault ReadFloat(const std::string& file);
  [[nodiscard]] hal::Fault ReadMask(const SequenceFrame& source, DepthFrame& frame);

  ReplayOptions options_;
  SequenceLayout layout_;
  std::string name_;
  std::vector<float> depth_m_;
  GrayImage depth_png_;
  GrayImage mask_png_;
  std::vector<std::uint8_t> mask_;
  hal::SensorCounters counters_;
  std::size_t next_ = 0;
  int held_masks_ = 0;
  bool open_ = false;
};

}  // namespace disflow::host
