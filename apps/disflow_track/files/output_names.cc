// SPDX-License-Identifier: BSD-3-Clause
#include "files/output_names.h"

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "files/output_file.h"
#include "input_paths.h"
#include "output_path.h"
#include "program/exit_status.h"

namespace disflow::apps {
namespace {

namespace fs = std::filesystem;

void Add(const std::string& option, const std::string& name, std::vector<NamedPath>& outputs) {
  if (!name.empty()) outputs.push_back(MakeNamedPath(option, name));
}

/// A file that takes its name only when it is complete, and the name that it has until then.
void AddAtomic(const std::string& option, const std::string& name,
               std::vector<NamedPath>& outputs) {
  Add(option, name, outputs);
  std::error_code error;
  const bool is_file = !fs::exists(name, error) || fs::is_regular_file(name, error);
  if (name.empty() || !is_file) return;
  outputs.push_back(MakeNamedPath(option, PartPath(FollowLinks(name))));
  outputs.back().name = name;
}

std::vector<NamedPath> OutputsOf(const Options& options) {
  std::vector<NamedPath> outputs;
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

void Append(std::vector<NamedPath> more, std::vector<NamedPath>& paths) {
  std::move(more.begin(), more.end(), std::back_inserter(paths));
}

std::vector<NamedPath> InputsOf(const Options& options) {
  constexpr std::string_view kMaskFile = "file:";
  std::vector<NamedPath> inputs = InputPaths("--sensor", options.sensor);
  for (const std::string& link : options.links) Append(InputPaths("--link", link), inputs);
  for (const std::string& file : options.settings_files) Add("the settings file", file, inputs);
  if (options.mask_stream.starts_with(kMaskFile))
    Add("--mask-stream", options.mask_stream.substr(kMaskFile.size()), inputs);
  return inputs;
}

}  // namespace

void RefuseSharedOutputs(const Options& options) {
  const std::string clash = FindClash(OutputsOf(options), InputsOf(options));
  if (!clash.empty()) throw Failure(kWrongUsage, clash);
}

}  // namespace disflow::apps
