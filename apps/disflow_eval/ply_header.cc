// SPDX-License-Identifier: BSD-3-Clause
#include "ply_header.h"

#include <algorithm>
#include <charconv>
#include <system_error>
#include <utility>

#include "errors.h"
#include "text_file.h"

namespace disflow::apps {
namespace {

namespace fs = std::filesystem;

constexpr std::pair<std::string_view, PlyType> kTypeNames[] = {
    {"char", PlyType::kInt8},      {"int8", PlyType::kInt8},       {"uchar", PlyType::kUint8},
    {"uint8", PlyType::kUint8},    {"short", PlyType::kInt16},     {"int16", PlyType::kInt16},
    {"ushort", PlyType::kUint16},  {"uint16", PlyType::kUint16},   {"int", PlyType::kInt32},
    {"int32", PlyType::kInt32},    {"uint", PlyType::kUint32},     {"uint32", PlyType::kUint32},
    {"float", PlyType::kFloat32},  {"float32", PlyType::kFloat32}, {"double", PlyType::kFloat64},
    {"float64", PlyType::kFloat64}};

PlyType ParseType(const fs::path& file, std::size_t line, std::string_view name) {
  for (const auto& [known, type] : kTypeNames) {
    if (known == name) return type;
  }
  throw InputError(file, line, "type '" + std::string(name) + "' is unknown");
}

using Words = std::vector<std::string_view>;

bool ParseFormat(const fs::path& file, std::size_t line, const Words& words) {
  const std::string_view format = words.size() == 3 ? words[1] : std::string_view();
  if (format == "ascii") return false;
  if (format == "binary_little_endian") return true;
  throw InputError(
      file, line,
      "the format must be 'ascii 1.0' or 'binary_little_endian 1.0'; write the mesh anew");
}

void AddElement(const fs::path& file, std::size_t line, const Words& words, PlyHeader& header) {
  PlyElement element;
  std::from_chars_result read{nullptr, std::errc::invalid_argument};
  if (words.size() == 3) {
    element.name = words[1];
    const char* const end = words[2].data() + words[2].size();
    read = std::from_chars(words[2].data(), end, element.count);
    if (read.ptr != end) read.ec = std::errc::invalid_argument;
  }
  if (read.ec != std::errc()) throw InputError(file, line, "'element NAME COUNT' is needed");
  // Vertices of two kinds would not all have what the others have.
  const bool is_known =
      std::any_of(header.elements.begin(), header.elements.end(),
                  [&element](const PlyElement& other) { return other.name == element.name; });
  if (is_known) throw InputError(file, line, "the element '" + element.name + "' is there twice");
  header.elements.push_back(std::move(element));
}

PlyProperty ParseProperty(const fs::path& file, std::size_t line, const Words& words) {
  PlyProperty property;
  if (words.size() == 3) {
    property.type = ParseType(file, line, words[1]);
  } else if (words.size() == 5 && words[1] == "list") {
    property.count_type = ParseType(file, line, words[2]);
    property.type = ParseType(file, line, words[3]);
  } else {
    throw InputError(file, line,
                     "'property TYPE NAME' or 'property list TYPE TYPE NAME' is needed");
  }
  property.name = words.back();
  return property;
}

/// One line after the first.
/// @return Whether the header goes on.
bool ParseHeaderLine(const fs::path& file, std::size_t line, const Words& words, bool& has_format,
                     PlyHeader& header) {
  if (words.empty() || words[0] == "comment" || words[0] == "obj_info") return true;
  if (words[0] == "end_header") return false;
  if (words[0] == "format") {
    header.binary = ParseFormat(file, line, words);
    has_format = true;
  } else if (words[0] == "element") {
    AddElement(file, line, words, header);
  } else if (words[0] == "property" && !header.elements.empty()) {
    header.elements.back().properties.push_back(ParseProperty(file, line, words));
  } else {
    throw InputError(file, line, "'" + std::string(words[0]) + "' does not belong here");
  }
  return true;
}

}  // namespace

PlyHeader ParsePlyHeader(const fs::path& file, std::string_view text) {
  PlyHeader header;
  bool has_format = false;
  for (std::size_t line = 1;; ++line) {
    const std::size_t end = text.find('\n', header.size);
    if (end == std::string_view::npos) {
      throw InputError(file, line == 1 ? "is no PLY file" : "ends within its PLY header");
    }
    const Words words = SplitAtSpaces(text.substr(header.size, end - header.size));
    header.size = end + 1;
    if (line == 1) {
      if (words != Words{"ply"}) throw InputError(file, "is no PLY file: it must start with 'ply'");
    } else if (!ParseHeaderLine(file, line, words, has_format, header)) {
      break;
    }
  }
  if (!has_format) throw InputError(file, "does not say its format in the header");
  return header;
}

}  // namespace disflow::apps
