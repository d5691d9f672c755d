// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>

namespace disflow::apps {

/// An input file is missing or malformed; what() names file, line and reason. Exit status 3.
class InputError : public std::runtime_error {
 public:
  explicit InputError(const std::string& text) : std::runtime_error(text) {}
  InputError(const std::filesystem::path& file, const std::string& text)
      : std::runtime_error(file.string() + ": " + text) {}
  InputError(const std::filesystem::path& file, std::size_t line, const std::string& text)
      : std::runtime_error(file.string() + ":" + std::to_string(line) + ": " + text) {}
};

/// A result could not be written; what() names the file and reason. Exit status 4.
class OutputError : public std::runtime_error {
 public:
  OutputError(const std::filesystem::path& file, const std::string& text)
      : std::runtime_error(file.string() + ": " + text) {}
};

}  // namespace disflow::apps
