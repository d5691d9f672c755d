// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "disflow/depth/depth_frame.h"
#include "disflow/types.h"

namespace disflow {

/// Notices images that are the one before once more under a new stamp, as drivers send when the
/// camera has nothing new. With a real sensor's noise no two images are alike.
class ImageRepeats {
 public:
  /// Whether the image is the same as the last one that was not. Looks at every fourth row.
  [[nodiscard]] bool IsRepeat(const DepthView& depth, StampNs stamp_ns) noexcept;

  /// Stamp under which the image was given first.
  [[nodiscard]] StampNs first_ns() const noexcept { return first_ns_; }

 private:
  bool has_image_ = false;
  std::uint64_t fingerprint_ = 0;
  StampNs first_ns_ = 0;
};

}  // namespace disflow
