// SPDX-License-Identifier: BSD-3-Clause
#include "named_path.h"

#include <algorithm>
#include <system_error>
#include <utility>

#include "output_path.h"

namespace disflow::apps {
namespace {

namespace fs = std::filesystem;

fs::path Resolve(const std::string& name) {
  std::error_code error;
  fs::path path = fs::weakly_canonical(FollowLinks(fs::absolute(name, error)), error);
  if (error) path = name;                                  // opening it will say what is wrong
  return path.has_filename() ? path : path.parent_path();  // "flow/"
}

bool AreOne(const NamedPath& a, const NamedPath& b) {
  std::error_code error;
  const bool same = a.path == b.path || fs::equivalent(a.path, b.path, error);
  // By its name: where /dev/stdout leads, if that is a pipe, is no path.
  return same && !fs::is_other(a.name, error);
}

bool LiesIn(const fs::path& path, const fs::path& folder) {
  const auto [in_folder, in_path] =
      std::mismatch(folder.begin(), folder.end(), path.begin(), path.end());
  return in_folder == folder.end() && in_path != path.end();
}

std::string FindSharedOutput(std::span<const NamedPath> outputs) {
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const NamedPath& a = outputs[j];
      const NamedPath& b = outputs[i];
      if (a.option == b.option || !AreOne(a, b)) continue;
      const std::string names = a.name == b.name ? a.name : a.name + " and " + b.name;
      return a.option + " and " + b.option + " would both write " + names +
             "; give each a name of its own";
    }
  }
  return {};
}

}  // namespace

NamedPath MakeNamedPath(std::string option, std::string name) {
  fs::path path = Resolve(name);
  return {std::move(option), std::move(name), std::move(path)};
}

std::string FindClash(std::span<const NamedPath> outputs, std::span<const NamedPath> inputs) {
  for (const NamedPath& output : outputs) {
    for (const NamedPath& input : inputs) {
      if (!AreOne(output, input) && !LiesIn(output.path, input.path)) continue;
      return output.option + " " + output.name + " would overwrite an input, " + input.option +
             " " + input.name + "; give it a name of its own";
    }
  }
  return FindSharedOutput(outputs);
}

}  // namespace disflow::apps
