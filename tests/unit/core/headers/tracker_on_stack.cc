// SPDX-License-Identifier: BSD-3-Clause
// A tracker that no stack holds.
#include "disflow/tracker.h"

unsigned int Frames() {
  const disflow::Tracker<disflow::profiles::Dense> tracker;
  return tracker.totals().frames;
}
