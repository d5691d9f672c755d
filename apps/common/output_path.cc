// SPDX-License-Identifier: BSD-3-Clause
#include "output_path.h"

#include <charconv>
#include <string>
#include <system_error>

namespace disflow::apps {
namespace {

namespace fs = std::filesystem;

// As the kernel has it.
constexpr int kMostLinks = 40;

std::optional<int> NumberIn(const std::string& name) {
  int number = 0;
  const char* const end = name.data() + name.size();
  const auto [rest, error] = std::from_chars(name.data(), end, number);
  if (error != std::errc() || rest != end || number < 0) return std::nullopt;
  return number;
}

/// If it is an entry of the folder of this process's descriptors.
std::optional<int> EntryOfDescriptors(const fs::path& path) {
  const std::optional<int> number = NumberIn(path.filename().string());
  if (!number) return std::nullopt;
  std::error_code error;
  const fs::path folder = fs::canonical(path.parent_path(), error);
  if (error || folder != fs::canonical("/proc/self/fd", error)) return std::nullopt;
  return number;
}

/// @return What a link says, taken from where it lies; empty if it is none.
fs::path TargetOf(const fs::path& path) {
  std::error_code error;
  const fs::path target = fs::read_symlink(path, error);
  return error ? fs::path() : path.parent_path() / target;
}

}  // namespace

std::optional<int> DescriptorOf(const fs::path& path) {
  fs::path at = path;
  for (int links = 0; links < kMostLinks && !at.empty(); ++links) {
    if (const auto descriptor = EntryOfDescriptors(at)) return descriptor;
    at = TargetOf(at);
  }
  return std::nullopt;
}

fs::path FollowLinks(const fs::path& path) {
  fs::path at = path;
  for (int links = 0; links < kMostLinks; ++links) {
    const fs::path target = TargetOf(at);
    if (target.empty()) return at;
    at = target;
  }
  return path;
}

}  // namespace disflow::apps
