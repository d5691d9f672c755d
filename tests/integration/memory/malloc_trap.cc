// SPDX-License-Identifier: BSD-3-Clause
#include "malloc_trap.h"

#include <atomic>

#ifndef DISFLOW_SANITIZED
#include "counted_malloc.h"
#endif

namespace {

std::atomic<bool> armed{false};
std::atomic<long> calls{0};

#ifndef DISFLOW_SANITIZED
void CountAllocation() {
  if (armed.load(std::memory_order_relaxed)) calls.fetch_add(1, std::memory_order_relaxed);
}
#endif

}  // namespace

#ifndef DISFLOW_SANITIZED
extern "C" {
void __libc_free(void*);

void free(void* block) {
  CountAllocation();
  __libc_free(block);
}
}
#endif

namespace disflow::test {

bool MallocTrap::available() {
#ifdef DISFLOW_SANITIZED
  return false;
#else
  return true;
#endif
}

void MallocTrap::Arm() {
  calls = 0;
  armed = true;
}

long MallocTrap::Disarm() {
  armed = false;
  return calls;
}

}  // namespace disflow::test
