// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <span>
#include <string>

namespace disflow::apps {

/// A file or folder as a command line names it.
struct NamedPath {
  std::string option;          ///< For messages.
  std::string name;            ///< As the user wrote it.
  std::filesystem::path path;  ///< Absolute and without links, as far as it exists.
};

[[nodiscard]] NamedPath MakeNamedPath(std::string option, std::string name);

/// Looks for two outputs that are one file or folder, and for an output that is an input or lies in
/// a folder that is one: writing it would destroy the other. Sees through other spellings (./a and
/// a), symbolic and hard links; the files need not exist. What cannot be destroyed (/dev/null, a
/// terminal, a pipe, /dev/stdout if it is one of these) may be named several times.
/// @return What is wrong, naming both options; empty if nothing is.
[[nodiscard]] std::string FindClash(std::span<const NamedPath> outputs,
                                    std::span<const NamedPath> inputs);

}  // namespace disflow::apps
