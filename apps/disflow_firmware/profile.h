// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "disflow/config.h"
#include "disflow/limits.h"

namespace disflow::firmware {

/// What the image has memory for.
using Profile = profiles::Micro;

/// Settings of the tracker for images of this size: an object has few pixels, and two of them all
/// around its outline are too many to leave out.
[[nodiscard]] inline Config FirmwareConfig() noexcept {
  Config config;
  config.sampler.border_px = 1;
  return config;
}

}  // namespace disflow::firmware
