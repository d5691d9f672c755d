// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <random>

#include "disflow/types.h"

namespace disflow::testing {

/// Symmetric positive definite, eigenvalues of at least 1.
inline Mat6 RandomPositiveDefinite(unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<float> normal;
  Mat6 root;
  for (int i = 0; i < 36; ++i) root(i / 6, i % 6) = normal(random);
  return root * root.transpose() + Mat6::Identity();
}

}  // namespace disflow::testing
