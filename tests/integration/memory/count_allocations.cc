// SPDX-License-Identifier: BSD-3-Clause
// Preloaded into a program (LD_PRELOAD) it counts the allocations of the whole process, all
// threads, and writes their number into the file that DISFLOW_ALLOCATIONS names when the program
// ends.
#include <atomic>
#include <cerrno>
#include <cstddef>
#include <cstdio>
#include <cstdlib>

namespace {

std::atomic<long> calls{0};

void Count() { calls.fetch_add(1, std::memory_order_relaxed); }

[[gnu::destructor]] void WriteNumber() {
  const long number = calls;
  const char* const name = std::getenv("DISFLOW_ALLOCATIONS");
  std::FILE* const file = name != nullptr ? std::fopen(name, "w") : nullptr;
  if (file == nullptr) return;
  (void)std::fprintf(file, "%ld\n", number);
  (void)std::fclose(file);
}

}  // namespace

// glibc lets others define these; its own versions stay reachable under other names.
extern "C" {
void* __libc_malloc(std::size_t);
void* __libc_calloc(std::size_t, std::size_t);
void* __libc_realloc(void*, std::size_t);
void* __libc_memalign(std::size_t, std::size_t);

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
}
