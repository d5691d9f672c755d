// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <optional>

namespace disflow::apps {

/// @return What a name like /dev/stdout, /dev/fd/1 or /proc/self/fd/1 stands for, also by way of
/// links: a descriptor that the program was started with. None of other paths.
[[nodiscard]] std::optional<int> DescriptorOf(const std::filesystem::path& path);

/// Where a file has to be that takes the place of the one at a path: renaming a new one to the name
/// of a link would replace the link.
/// @return What the links lead to, which need not exist; the path itself if they lead in circles.
[[nodiscard]] std::filesystem::path FollowLinks(const std::filesystem::path& path);

}  // namespace disflow::apps
