// SPDX-License-Identifier: BSD-3-Clause
#include "allocation_count.h"

#include <atomic>

#include "counted_malloc.h"

namespace {

std::atomic<long> calls{0};

void CountAllocation() { calls.fetch_add(1, std::memory_order_relaxed); }

}  // namespace

namespace disflow::bench {

long AllocationCount() noexcept { return calls.load(std::memory_order_relaxed); }

}  // namespace disflow::bench
