// SPDX-License-Identifier: BSD-3-Clause
#include <array>

#include "disflow/baremetal/stream_memory.h"
#include "profile.h"

namespace disflow::baremetal {
namespace {

constexpr std::size_t kPixels = std::size_t{firmware::Profile::kMaxImageWidth} *
                                std::size_t{firmware::Profile::kMaxImageHeight};
std::array<std::uint16_t, kPixels> image;
hal::depth_stream::TimeBudgets budgets;

}  // namespace

std::span<std::uint16_t> StreamImage() noexcept { return image; }
hal::depth_stream::TimeBudgets& Budgets() noexcept { return budgets; }

}  // namespace disflow::baremetal
