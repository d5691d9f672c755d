// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "disflow/depth/depth_frame.h"

namespace disflow::host {

/// Writes a depth image as floats in metres, row behind row.
/// @param target Has room for all pixels; need not be aligned.
void CopyMetres(const DepthView& depth, void* target) noexcept;

}  // namespace disflow::host
