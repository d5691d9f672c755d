// SPDX-License-Identifier: BSD-3-Clause
#include "input_paths.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <system_error>
#include <utility>

#include "disflow/host/numbered_files.h"
#include "disflow/host/sequence_layout.h"
#include "disflow/host/simulation_options.h"
#include "disflow/host/uri.h"

namespace disflow::apps {
namespace {

namespace fs = std::filesystem;

/// Collects what one option reads.
class Inputs {
 public:
  explicit Inputs(const std::string& option) : option_(option) {}

  void Add(const fs::path& path) { paths_.push_back(MakeNamedPath(option_, path.string())); }

  void AddSimulation(const host::Uri& uri) {
    host::SimulationOptions options;
    if (!ParseSimulationUri(uri, options).ok()) return;  // opening it says what is wrong
    for (const host::SimulatedShape& shape : ObjectShapes(options))
      if (!shape.obj_file.empty()) Add(shape.obj_file);
  }

  /// A recorded sequence of any layout.
  void AddSequence(const fs::path& dir) {
    for (const char* const name :
         {host::kCameraFile, host::kIntrinsicsFile, host::kDataFile, host::kDepthFolder,
          host::kMaskedDepthFolder, host::kMaskFolder, host::kInfraredFolder, host::kTruthFolder,
          host::kWorldPoseFile, host::kPoseFolder, host::kTumDepthFile, host::kTumPoseFile,
          host::kBopCameraFile, host::kBopTruthFile, host::kBopVisibleFolder, "mask"})
      AddIfThere(dir / name);
    if (IsThere(dir / host::kBopCameraFile)) AddBopModels(dir);
    if (!IsThere(dir / host::kDepthFolder) && !IsThere(dir / host::kMaskedDepthFolder))
      AddLooseImages(dir);
  }

  /// A file that ROS recorded, or the folder of several.
  void AddRecording(const fs::path& path) {
    constexpr std::array kExtensions = {".mcap", ".db3", ".bag", ".active", ".yaml", ".zstd"};
    std::error_code error;
    if (!fs::is_directory(path, error)) return Add(path);
    for (fs::directory_iterator entry(path, error), end; !error && entry != end;
         entry.increment(error)) {
      const fs::path extension = entry->path().extension();
      if (std::find(kExtensions.begin(), kExtensions.end(), extension) != kExtensions.end())
        Add(entry->path());
    }
  }

  [[nodiscard]] std::vector<NamedPath> Take() { return std::move(paths_); }

 private:
  static bool IsThere(const fs::path& path) {
    std::error_code error;
    return fs::exists(path, error);
  }
  void AddIfThere(const fs::path& path) {
    if (IsThere(path)) Add(path);
  }
  void AddBopModels(const fs::path& dir) {
    for (const fs::path& folder : host::BopModelFolders(dir)) AddIfThere(folder);
  }
  void AddLooseImages(const fs::path& dir) {
    std::vector<host::NumberedFile> images;
    if (!host::ListNumberedFiles(dir, host::kImageExtension, images).ok()) return;
    for (const host::NumberedFile& image : images) Add(image.path);
  }

  std::string option_;
  std::vector<NamedPath> paths_;
};

}  // namespace

std::vector<NamedPath> InputPaths(const std::string& option, const std::string& address) {
  Inputs inputs(option);
  host::Uri uri;
  const bool is_address = ParseUri(address, uri).ok();
  const std::string plain = address.substr(0, address.find('?'));
  std::error_code error;
  if (is_address && uri.scheme == "sim") {
    inputs.AddSimulation(uri);
  } else if (is_address && uri.scheme == "replay") {
    inputs.AddSequence(uri.path);
  } else if (is_address && uri.scheme == "rosbag") {
    inputs.AddRecording(uri.path);
  } else if (fs::is_directory(address, error)) {
    inputs.AddSequence(address);
  } else if (fs::exists(plain, error)) {
    inputs.AddRecording(plain);
  }
  for (const auto& [key, value] : uri.query)
    if (key == "intrinsics" || key == "key") inputs.Add(value);
  return inputs.Take();
}

}  // namespace disflow::apps
