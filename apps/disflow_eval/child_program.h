// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace disflow::apps {

/// The shell's convention for a program that is not there.
inline constexpr int kProgramNotFound = 127;

/// Runs a program to its end, without a shell. It shares this program's streams.
/// @param words Program (a path, or a name that is looked up in PATH) and its arguments.
/// @param folder Where it runs.
/// @return Its exit status, or kProgramNotFound.
/// @throws OutputError if no process can be started.
[[nodiscard]] int RunProgram(std::vector<std::string> words, const std::filesystem::path& folder);

}  // namespace disflow::apps
