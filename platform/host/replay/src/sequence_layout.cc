// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/host/sequence_layout.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>

namespace disflow::host {
namespace {

namespace fs = std::filesystem;
using hal::Fault;
using hal::MakeFault;

constexpr double kDefaultRate_hz = 30.0;
constexpr double kNsPerS = 1e9;

/// The numbers in a file's name, in order: sorts frame-2 before frame-10.
std::vector<std::uint64_t> NumbersIn(const std::string& name) {
  std::vector<std::uint64_t> numbers;
  for (std::size_t i = 0; i < name.size();) {
    if (std::isdigit(static_cast<unsigned char>(name[i])) == 0) {
      ++i;
      continue;
    }
    std::uint64_t number = 0;
    for (; i < name.size() && std::isdigit(static_cast<unsigned char>(name[i])) != 0; ++i) {
      number = number * 10 + static_cast<std::uint64_t>(name[i] - '0');
    }
    numbers.push_back(number);
  }
  return numbers;
}

std::vector<fs::path> ListFiles(const fs::path& folder, const std::string& extension) {
  std::vector<fs::path> files;
  std::error_code error;
  for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) {
    if (it->path().extension() == extension) files.push_back(it->path());
  }
  std::sort(files.begin(), files.end(), [](const fs::path& a, const fs::path& b) {
    const std::string name_a = a.filename().string();
    const std::string name_b = b.filename().string();
    const auto numbers_a = NumbersIn(name_a);
    const auto numbers_b = NumbersIn(name_b);
    return numbers_a != numbers_b ? numbers_a < numbers_b : name_a < name_b;
  });
  return files;
}

/// All numbers of a text file. @return nothing if there is anything else in it.
std::optional<std::vector<double>> ReadNumbers(const fs::path& file) {
  std::ifstream stream(file);
  if (!stream) return std::nullopt;
  std::vector<double> numbers;
  std::string word;
  while (stream >> word) {
    char* end = nullptr;
    const double number = std::strtod(word.c_str(), &end);
    if (*end != '\0' || !std::isfinite(number)) return std::nullopt;
    numbers.push_back(number);
  }
  return numbers;
}

Fault CheckCamera(const fs::path& file, const PinholeCamera& camera) {
  if (camera.IsValid()) return {};
  return MakeFault(Status::kInvalidIntrinsics,
                   "%s: focal lengths must be positive and all values finite", file.c_str());
}

Fault ReadCameraJson(const fs::path& file, SequenceLayout& layout) {
  std::ifstream stream(file);
  try {
    const auto json = nlohmann::json::parse(stream);
    layout.width_px = json.at("width").get<int>();
    layout.height_px = json.at("height").get<int>();
    layout.camera = {json.at("fx").get<float>(), json.at("fy").get<float>(),
                     json.at("cx").get<float>(), json.at("cy").get<float>()};
  } catch (const nlohmann::json::exception& problem) {
    return MakeFault(Status::kCorrupt, "%s: want {width, height, fx, fy, cx, cy} (%s)",
                     file.c_str(), problem.what());
  }
  if (layout.width_px <= 0 || layout.height_px <= 0 || layout.width_px > 16384 ||
      layout.height_px > 16384) {
    return MakeFault(Status::kInvalidImageSize, "%s: %d x %d is no usable image size", file.c_str(),
                     layout.width_px, layout.height_px);
  }
  return CheckCamera(file, layout.camera);
}

Fault ReadCamera(const fs::path& directory, SequenceLayout& layout) {
  const fs::path json = directory / "cam_K.json";
  if (fs::exists(json)) return ReadCameraJson(json, layout);
  const fs::path matrix = directory / "camera-intrinsics.txt";
  if (!fs::exists(matrix)) {
    return MakeFault(Status::kNotFound,
                     "%s: no cam_K.json and no camera-intrinsics.txt; write one of them",
                     directory.c_str());
  }
  const auto k = ReadNumbers(matrix);
  if (!k || k->size() != 9)
    return MakeFault(Status::kCorrupt, "%s: want a 3x3 matrix", matrix.c_str());
  const auto at = [&k](std::size_t i) { return static_cast<float>((*k)[i]); };
  layout.camera = {at(0), at(4), at(2), at(5)};
  return CheckCamera(matrix, layout.camera);
}

/// Index (first column) to stamp (second column) of data.txt; lines of one number are stamps of
/// frames 0, 1, ...
Fault ReadStamps(const fs::path& file, std::map<std::uint64_t, double>& stamps) {
  std::ifstream stream(file);
  std::string line;
  for (int number = 1; std::getline(stream, line); ++number) {
    std::istringstream words(line);
    double first = 0.0;
    double second = 0.0;
    if (!(words >> first)) continue;
    const bool two = static_cast<bool>(words >> second);
    const double stamp_s = two ? second : first;
    const double index = two ? first : static_cast<double>(stamps.size());
    if (!std::isfinite(stamp_s) || !(index >= 0.0) || std::abs(stamp_s) > 9e9) {
      return MakeFault(Status::kCorrupt, "%s:%d: want \"index stamp_in_seconds\"", file.c_str(),
                       number);
    }
    stamps[static_cast<std::uint64_t>(index)] = stamp_s;
  }
  return {};
}

/// Files of a mask set by the frame number at the end of their names.
Fault FindMasks(const ReplayOptions& options, std::map<std::uint64_t, std::string>& masks) {
  if (options.mask == "none") return {};
  const fs::path root = fs::path(options.directory) / "masks";
  const bool automatic = options.mask == "auto";
  const fs::path folder = root / (automatic ? "gt" : options.mask);
  if (!fs::is_directory(folder)) {
    if (automatic) return {};
    return MakeFault(Status::kNotFound, "%s: no such mask set; use mask=none or one of those in %s",
                     folder.c_str(), root.c_str());
  }
  for (const fs::path& file : ListFiles(folder, ".png")) {
    const auto numbers = NumbersIn(file.stem().string());
    if (!numbers.empty()) masks[numbers.back()] = file.string();
  }
  if (masks.empty())
    return MakeFault(Status::kNotFound, "%s: holds no mask images", folder.c_str());
  return {};
}

Fault PoseFromMatrix(const fs::path& file, SequenceFrame& frame) {
  const auto m = ReadNumbers(file);
  if (!m || m->size() < 12)
    return MakeFault(Status::kCorrupt, "%s: want a 4x4 camera-to-world matrix", file.c_str());
  Mat3 rotation;
  Vec3 translation;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      rotation(row, column) = static_cast<float>((*m)[static_cast<std::size_t>(4 * row + column)]);
    }
    translation[row] = static_cast<float>((*m)[static_cast<std::size_t>(4 * row + 3)]);
  }
  frame.T_wc = Transform<World, Camera>(rotation, translation).Normalized();
  frame.has_T_wc = true;
  return {};
}

/// T_wc.txt: `x y z nx ny nz theta` per frame, as gt/poses.txt.
Fault PosesFromLines(const fs::path& file, std::vector<SequenceFrame>& frames) {
  const auto numbers = ReadNumbers(file);
  if (!numbers || numbers->size() < 7 * frames.size()) {
    return MakeFault(Status::kCorrupt, "%s: want %zu lines of x y z nx ny nz theta", file.c_str(),
                     frames.size());
  }
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const auto at = [&](std::size_t k) { return static_cast<float>((*numbers)[7 * i + k]); };
    frames[i].T_wc = {ExpSo3(Vec3(at(6) * Vec3(at(3), at(4), at(5)))), Vec3(at(0), at(1), at(2))};
    frames[i].has_T_wc = true;
  }
  return {};
}

Fault ReadCameraPoses(const fs::path& directory, std::vector<SequenceFrame>& frames) {
  const fs::path lines = directory / "T_wc.txt";
  if (fs::exists(lines)) return PosesFromLines(lines, frames);
  const auto files = ListFiles(directory / "pose", ".txt");
  if (files.size() != frames.size()) {
    return MakeFault(
        Status::kNotFound,
        "%s: T_wc=poses wants T_wc.txt or one pose/*.txt per image (%zu found, %zu images)",
        directory.c_str(), files.size(), frames.size());
  }
  for (std::size_t i = 0; i < files.size(); ++i) {
    if (const Fault fault = PoseFromMatrix(files[i], frames[i]); !fault.ok()) return fault;
  }
  return {};
}

std::vector<fs::path> FindDepthFiles(const fs::path& directory, bool& float_depth) {
  float_depth = true;
  auto files = ListFiles(directory / "depth", ".float");
  if (!files.empty()) return files;
  float_depth = false;
  for (const char* folder : {"depth", "masked_depth", "."}) {
    files = ListFiles(directory / folder, ".png");
    if (!files.empty()) return files;
  }
  return {};
}

void Cut(const ReplayOptions& options, std::vector<SequenceFrame>& frames) {
  const auto first = std::min(frames.size(), static_cast<std::size_t>(options.first));
  frames.erase(frames.begin(), frames.begin() + static_cast<std::ptrdiff_t>(first));
  if (options.count > 0 && frames.size() > static_cast<std::size_t>(options.count)) {
    frames.resize(static_cast<std::size_t>(options.count));
  }
}

}  // namespace

Fault FindSequence(const ReplayOptions& options, SequenceLayout& layout) {
  layout = {};
  layout.directory = options.directory;
  const fs::path directory(options.directory);
  if (!fs::is_directory(directory)) {
    return MakeFault(Status::kNotFound, "%s: no such folder", options.directory.c_str());
  }
  const auto files = FindDepthFiles(directory, layout.float_depth);
  if (files.empty()) {
    return MakeFault(Status::kUnsupported, "%s: no depth/*.float and no depth/*.png in it",
                     options.directory.c_str());
  }
  if (const Fault fault = ReadCamera(directory, layout); !fault.ok()) return fault;
  std::map<std::uint64_t, double> stamps;
  if (const Fault fault = ReadStamps(directory / "data.txt", stamps); !fault.ok()) return fault;
  std::map<std::uint64_t, std::string> masks;
  if (const Fault fault = FindMasks(options, masks); !fault.ok()) return fault;
  for (std::size_t i = 0; i < files.size(); ++i) {
    SequenceFrame frame;
    frame.depth_file = files[i].string();
    const auto numbers = NumbersIn(files[i].stem().string());
    const std::uint64_t number = numbers.empty() ? i : numbers.back();
    if (const auto mask = masks.find(number); mask != masks.end()) frame.mask_file = mask->second;
    const auto stamp = stamps.find(number);
    const double stamp_s =
        stamp != stamps.end() ? stamp->second : static_cast<double>(i) / kDefaultRate_hz;
    frame.stamp_ns = static_cast<StampNs>(std::llround(stamp_s * kNsPerS));
    layout.frames.push_back(std::move(frame));
  }
  if (options.use_camera_poses) {
    if (const Fault fault = ReadCameraPoses(directory, layout.frames); !fault.ok()) return fault;
  }
  Cut(options, layout.frames);
  return {};
}

}  // namespace disflow::host
