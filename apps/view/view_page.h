// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "disflow/posix/view/web_server.h"

namespace disflow::apps {

/// @return The live view's page, all its files. Static storage.
[[nodiscard]] std::span<const posix::WebAsset> ViewPage() noexcept;

}  // namespace disflow::apps
