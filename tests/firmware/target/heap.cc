// SPDX-License-Identifier: BSD-3-Clause
#include <cstddef>

namespace {
alignas(8) std::byte heap[DISFLOW_TEST_HEAP_BYTES];
std::size_t heap_used = 0;
}  // namespace

/// Memory for the C library's heap, which tests and printf() use and the code under test does not.
extern "C" void* _sbrk(std::ptrdiff_t more) {
  if (more > static_cast<std::ptrdiff_t>(sizeof(heap) - heap_used))
    return reinterpret_cast<void*>(-1);
  void* const begin = heap + heap_used;
  heap_used += static_cast<std::size_t>(more);
  return begin;
}
