// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace disflow {

/// Integer coordinates of a leaf cell.
struct OctreeCell {
  int x = 0;
  int y = 0;
  int z = 0;
};

}  // namespace disflow
