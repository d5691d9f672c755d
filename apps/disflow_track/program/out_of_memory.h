// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace disflow::apps {

/// From now on the program says so when no more memory is to be had, and ends at once with
/// kInputFailed: whatever was tracked is with the kernel already, and no thread could go on.
void EndWhenOutOfMemory() noexcept;

}  // namespace disflow::apps
