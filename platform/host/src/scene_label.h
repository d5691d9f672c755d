// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace disflow::host {

/// What a pixel shows. Objects are 1, 2, ...
namespace SceneLabel {
inline constexpr std::uint32_t kBackground = 0;
inline constexpr std::uint32_t kFirstObject = 1;
inline constexpr std::uint32_t kOccluder = 1000;
}  // namespace SceneLabel

}  // namespace disflow::host
