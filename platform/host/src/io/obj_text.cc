// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/host/obj_text.h"

#include <algorithm>
#include <cstdint>
#include <fstream>
#include <string_view>
#include <system_error>
#include <utility>

namespace disflow::host {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kSpaces = " \t\r";

/// The first word of a line; what follows it stays.
std::string_view TakeWord(std::string_view& line) {
  line.remove_prefix(std::min(line.find_first_not_of(kSpaces), line.size()));
  const std::string_view word = line.substr(0, line.find_first_of(kSpaces));
  line.remove_prefix(word.size());
  return word;
}

bool HasTooManyCorners(std::string_view line) {
  constexpr int kMostCorners = 99;
  for (int corners = 0; !TakeWord(line).empty(); ++corners)
    if (corners == kMostCorners) return true;
  return false;
}

}  // namespace

hal::Fault ReadObjText(const fs::path& file, std::string& text) {
  constexpr std::uintmax_t kMaxBytes = std::uintmax_t{1} << 26U;
  constexpr int kMaxLines = 1 << 21;
  std::error_code error;
  const bool is_folder = fs::is_directory(file, error);
  std::ifstream stream(file, std::ios::binary);
  if (!stream || is_folder) {
    return hal::MakeFault(Status::kNotFound, "%s: cannot be opened; an OBJ file is needed",
                          file.c_str());
  }
  const std::uintmax_t size = fs::file_size(file, error);
  if (!error && size > kMaxBytes) {
    return hal::MakeFault(Status::kCorrupt, "%s: %ju bytes are too many; %ju can be read",
                          file.c_str(), size, kMaxBytes);
  }
  std::string kept;
  int kept_lines = 0;
  std::string line;
  for (int number = 1; std::getline(stream, line); ++number) {
    std::string_view rest = line;
    const std::string_view word = TakeWord(rest);
    const bool is_face = word == "f";
    if (!is_face && word != "v" && word != "vt" && word != "vn") continue;
    if (is_face && HasTooManyCorners(rest)) {
      return hal::MakeFault(Status::kCorrupt,
                            "%s:%d: a face of a hundred corners and more; split it into triangles",
                            file.c_str(), number);
    }
    if (++kept_lines > kMaxLines) {
      return hal::MakeFault(Status::kCorrupt, "%s: more than %d vertices and faces; simplify it",
                            file.c_str(), kMaxLines);
    }
    kept.append(line).append(1, '\n');
  }
  text = std::move(kept);
  return {};
}

}  // namespace disflow::host
