// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/posix/dds/ros_names.h"

#include <algorithm>

namespace disflow::posix {
namespace {

bool IsDigit(char c) noexcept { return c >= '0' && c <= '9'; }
bool IsNameCharacter(char c) noexcept {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || IsDigit(c) || c == '_';
}
bool IsPart(std::string_view text) noexcept {
  return !text.empty() && !IsDigit(text.front()) &&
         std::all_of(text.begin(), text.end(), IsNameCharacter);
}

}  // namespace

bool IsRosName(std::string_view name) noexcept {
  if (name.empty()) return false;
  while (!name.empty()) {
    if (name.front() != '/') return false;
    name.remove_prefix(1);
    const std::size_t size = std::min(name.find('/'), name.size());
    if (!IsPart({name.data(), size})) return false;
    name.remove_prefix(size);
  }
  return true;
}

std::string RosNamePart(std::string_view text) {
  std::string part(text);
  std::replace_if(
      part.begin(), part.end(), [](char c) { return !IsNameCharacter(c); }, '_');
  if (part.empty() || IsDigit(part.front())) part.insert(0, 1, '_');
  return part;
}

std::string TopicName(std::string_view ros_name) { return "rt" + std::string(ros_name); }
std::string RequestTopicName(std::string_view ros_name) {
  return "rq" + std::string(ros_name) + "Request";
}
std::string ReplyTopicName(std::string_view ros_name) {
  return "rr" + std::string(ros_name) + "Reply";
}

}  // namespace disflow::posix
