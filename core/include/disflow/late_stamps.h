// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "disflow/types.h"

namespace disflow {

/// Tells frames that come late from those of a clock that was set back for good.
class LateStamps {
 public:
  /// A frame was in time.
  void Forget() noexcept { frames_ = 0; }

  /// A frame is not newer than the last one that was taken.
  /// @return Whether such frames have gone on for so long that time goes on from theirs.
  [[nodiscard]] bool GoOn(StampNs stamp_ns) noexcept;

 private:
  StampNs first_ns_ = 0;
  StampNs latest_ns_ = 0;
  std::uint8_t frames_ = 0;
};

}  // namespace disflow
