// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/baremetal/board.h"

// The emulated boards need no preparation for a program that only computes.
namespace disflow::baremetal {
void StartBoard() noexcept {}
}  // namespace disflow::baremetal
