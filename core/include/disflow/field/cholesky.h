// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

/// @file
/// Cholesky factorisation of small symmetric matrices over plain column-major storage.
///
/// Eigen's own LLT refers to malloc from 32 rows on (blocked products), even at fixed sizes; these
/// loops do not, and their inner loops run down contiguous columns so that compilers vectorise
/// them.

namespace disflow {

/// Factorises A = L L^T in place; the lower triangle holds A before and L after, the diagonal of L
/// is stored inverted.
/// @param a Column-major, element (row, column) at a[column * stride + row].
/// @return false if A is not positive definite to working precision (NaN included); `a` is then
/// spoilt.
[[nodiscard]] inline bool CholeskyFactorise(float* a, int size, int stride) noexcept {
  // A pivot that has lost this much of its diagonal element is nothing but rounding.
  constexpr float kSmallestPivot = 1e-6F;
  for (int j = 0; j < size; ++j) {
    float* column = a + j * stride;
    const float smallest = kSmallestPivot * column[j];
    // Left-looking: subtract what the columns before contribute, four at a time to spare memory
    // traffic.
    int k = 0;
    for (; k + 3 < j; k += 4) {
      const float* c0 = a + k * stride;
      const float* c1 = c0 + stride;
      const float* c2 = c1 + stride;
      const float* c3 = c2 + stride;
      const float f0 = c0[j], f1 = c1[j], f2 = c2[j], f3 = c3[j];
      for (int i = j; i < size; ++i)
        column[i] -= (f0 * c0[i] + f1 * c1[i]) + (f2 * c2[i] + f3 * c3[i]);
    }
    for (; k < j; ++k) {
      const float* other = a + k * stride;
      const float factor = other[j];
      for (int i = j; i < size; ++i) column[i] -= factor * other[i];
    }
    const float pivot = column[j];
    if (!(pivot > 0.0F && pivot > smallest) || !std::isfinite(pivot)) return false;
    const float inverse = 1.0F / std::sqrt(pivot);
    for (int i = j + 1; i < size; ++i) column[i] *= inverse;
    column[j] = inverse;
  }
  return true;
}

/// Solves L x = b in place, with L from CholeskyFactorise().
inline void CholeskySolveLower(const float* l, int size, int stride, float* x) noexcept {
  for (int j = 0; j < size; ++j) {
    const float* column = l + j * stride;
    const float value = x[j] * column[j];
    x[j] = value;
    for (int i = j + 1; i < size; ++i) x[i] -= value * column[i];
  }
}

/// Solves L^T x = b in place.
inline void CholeskySolveUpper(const float* l, int size, int stride, float* x) noexcept {
  for (int j = size - 1; j >= 0; --j) {
    const float* column = l + j * stride;
    float value = x[j];
    for (int i = j + 1; i < size; ++i) value -= column[i] * x[i];
    x[j] = value * column[j];
  }
}

}  // namespace disflow
