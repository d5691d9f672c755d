// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace disflow::test {

/// Counts calls of malloc, calloc, realloc, memalign, free and of operator new and delete (which
/// end there), in this program. Not available under sanitizers, which own malloc.
class MallocTrap {
 public:
  [[nodiscard]] static bool available();
  /// Starts counting from zero.
  static void Arm();
  /// Stops counting. @return Calls since Arm().
  static long Disarm();
};

}  // namespace disflow::test
