// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <new>
#include <type_traits>

namespace disflow {

/// One piece of memory for stages of a frame that follow each other and keep nothing from frame to
/// frame. As large as the largest of them.
template <class... Stages>
class StageScratch {
  static_assert((std::is_trivially_destructible_v<Stages> && ...), "stages are never destroyed");

 public:
  StageScratch() = default;
  StageScratch(const StageScratch&) = delete;
  StageScratch& operator=(const StageScratch&) = delete;

  /// A new Stage in the memory. Ends the stage that was begun before: it must not be used any more.
  template <class Stage>
  [[nodiscard]] Stage& Begin() noexcept {
    static_assert((std::is_same_v<Stage, Stages> || ...));
    // Not value-initialised: what a stage does not initialise itself need not be cleared.
    return *::new (static_cast<void*>(memory_)) Stage;
  }

 private:
  alignas(Stages...) std::byte memory_[std::max({sizeof(Stages)...})];
};

}  // namespace disflow
