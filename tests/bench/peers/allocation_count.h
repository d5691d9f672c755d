// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace disflow::bench {

/// Calls of malloc and its kin so far, operator new among them, of the whole program.
[[nodiscard]] long AllocationCount() noexcept;

}  // namespace disflow::bench
