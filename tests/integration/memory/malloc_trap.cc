// SPDX-License-Identifier: BSD-3-Clause
#include "malloc_trap.h"

#include <atomic>
#include <cerrno>
#include <cstddef>

namespace {

std::atomic<bool> armed{false};
std::atomic<long> calls{0};

#ifndef DISFLOW_SANITIZED
void Count() {
  if (armed.load(std::memory_order_relaxed)) calls.fetch_add(1, std::memory_order_relaxed);
}
#endif

}  // namespace

#ifndef DISFLOW_SANITIZED
// glibc lets a program define these; its own versions stay reachable under other names.
extern "C" {
void* __libc_malloc(std::size_t);
void* __libc_calloc(std::size_t, std::size_t);
void* __libc_realloc(void*, std::size_t);
void* __libc_memalign(std::size_t, std::size_t);
void __libc_free(void*);

void* malloc(std::size_t size) {
  Count();
  return __libc_malloc(size);
}
void* calloc(std::size_t count, std::size_t size) {
  Count();
  return __libc_calloc(count, size);
}
void* realloc(void* block, std::size_t size) {
  Count();
  return __libc_realloc(block, size);
}
void* memalign(std::size_t alignment, std::size_t size) {
  Count();
  return __libc_memalign(alignment, size);
}
void* aligned_alloc(std::size_t alignment, std::size_t size) {
  Count();
  return __libc_memalign(alignment, size);
}
int posix_memalign(void** block, std::size_t alignment, std::size_t size) {
  Count();
  *block = __libc_memalign(alignment, size);
  return *block == nullptr ? ENOMEM : 0;
}
void free(void* block) {
  Count();
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
