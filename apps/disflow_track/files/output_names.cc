// SPDX-License-Identifier: BSD-3-Clause
#include "files/output_names.h"

#include <filesystem>
#include <string>
#include <system_error>
#include <vector>

#include "files/output_file.h"
#include "program/exit_status.h"

namespace disflow::apps {
namespace {

namespace fs = std::filesystem;

struct Output {
  std::string option;  ///< For messages.
  std::string name;    ///< As the user wrote it.
  fs::path path;       ///< What is written; absolute and without links, as far as it exists.
};

/// Where a file will be created if its name is a symbolic link to nothing.
fs::path FollowLinks(fs::path path) {
  constexpr int kMostLinks = 40;  // as Linux itself
  std::error_code error;
  for (int i = 0; i < kMostLinks && fs::is_symlink(path, error); ++i) {
    const fs::path target = fs::read_symlink(path, error);
    if (error) break;
    path = target.is_absolute() ? target : path.parent_path() / target;
  }
  return path;
}

fs::path Resolve(const std::string& name) {
  std::error_code error;
  fs::path path = fs::weakly_canonical(FollowLinks(fs::absolute(name, error)), error);
  if (error) path = name;                                  // opening it will say what is wrong
  return path.has_filename() ? path : path.parent_path();  // "flow/"
}

void Add(const std::string& option, const std::string& name, std::vector<Output>& outputs) {
  if (!name.empty()) outputs.push_back({option, name, Resolve(name)});
}

/// A file that takes its name only when it is complete, and the name that it has until then.
void AddAtomic(const std::string& option, const std::string& name, std::vector<Output>& outputs) {
  Add(option, name, outputs);
  std::error_code error;
  const bool is_file = !fs::exists(name, error) || fs::is_regular_file(name, error);
  if (!name.empty() && is_file) outputs.push_back({option, name, Resolve(PartPath(name))});
}

std::vector<Output> OutputsOf(const Options& options) {
  std::vector<Output> outputs;
  for (const ObjectOptions& object : options.objects) {
    const std::string of = options.objects.size() > 1 ? " of the object " + object.name : "";
    Add("--csv" + of, object.files.csv, outputs);
    AddAtomic("--mesh" + of, object.files.mesh, outputs);
    AddAtomic("--mesh-picture" + of, object.files.mesh_picture, outputs);
    Add("--flow" + of, object.files.flow, outputs);
  }
  Add("--record", options.record, outputs);
  return outputs;
}

bool AreOne(const Output& a, const Output& b) {
  std::error_code error;
  const bool same = a.path == b.path || fs::equivalent(a.path, b.path, error);
  return same && !fs::is_character_file(a.path, error);
}

}  // namespace

void RefuseSharedOutputs(const Options& options) {
  const std::vector<Output> outputs = OutputsOf(options);
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const Output& a = outputs[j];
      const Output& b = outputs[i];
      if (a.option == b.option || !AreOne(a, b)) continue;
      const std::string names = a.name == b.name ? a.name : a.name + " and " + b.name;
      throw Failure(kWrongUsage, a.option + " and " + b.option + " would both write " + names +
                                     "; give each a name of its own");
    }
  }
}

}  // namespace disflow::apps
