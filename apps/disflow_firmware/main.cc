// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// DisFlow on a controller without an operating system: depth images in, pose and twist out.
/// docs/firmware.md.

#include "disflow/baremetal/board.h"
#include "disflow/baremetal/stream_memory.h"
#include "firmware.h"

int main() {
  using namespace disflow::baremetal;
  static disflow::firmware::Firmware firmware(BoardDepthSource(), BoardUart(), BoardClock(),
                                              Budgets());
  for (;;) firmware.Step();
}
