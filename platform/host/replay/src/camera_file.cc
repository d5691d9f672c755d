// SPDX-License-Identifier: BSD-3-Clause
#include "camera_file.h"

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "disflow/host/image_limits.h"
#include "disflow/host/sequence_layout.h"
#include "text_table.h"

namespace disflow::host {
namespace {

namespace fs = std::filesystem;

/// Either kind of file holds a handful of numbers.
constexpr std::uintmax_t kMaxCamera_bytes = 65536;

hal::Fault CheckCamera(const fs::path& file, const PinholeCamera& camera) {
  if (camera.IsValid()) return {};
  return hal::MakeFault(Status::kInvalidIntrinsics,
                        "%s: fx, fy, cx, cy = %g, %g, %g, %g; positive focal lengths are needed",
                        file.c_str(), static_cast<double>(camera.fx_px),
                        static_cast<double>(camera.fy_px), static_cast<double>(camera.cx_px),
                        static_cast<double>(camera.cy_px));
}

hal::Fault ReadNumber(const fs::path& file, const nlohmann::json& json, const char* key,
                      double& value) {
  const auto found = json.find(key);
  if (found == json.end() || !found->is_number()) {
    return hal::MakeFault(Status::kCorrupt, "%s: the number \"%s\" is missing", file.c_str(), key);
  }
  value = found->get<double>();
  return {};
}

hal::Fault ReadSide(const fs::path& file, const nlohmann::json& json, const char* key, int& side) {
  double value = 0.0;
  const hal::Fault fault = ReadNumber(file, json, key, value);
  if (!fault.ok()) return fault;
  if (!(value >= 1.0 && value <= kMaxImageSide_px)) {
    return hal::MakeFault(Status::kInvalidImageSize, "%s: \"%s\" is %g; 1 to %u are possible",
                          file.c_str(), key, value, kMaxImageSide_px);
  }
  side = static_cast<int>(value);
  return {};
}

hal::Fault CheckPixels(const fs::path& file, const CameraDescription& description) {
  const auto pixels = static_cast<std::uint64_t>(description.width_px) *
                      static_cast<std::uint64_t>(description.height_px);
  if (pixels <= kMaxImagePixels) return {};
  return hal::MakeFault(
      Status::kInvalidImageSize, "%s: %d x %d pixels are too many; %ju can be read", file.c_str(),
      description.width_px, description.height_px, std::uintmax_t{kMaxImagePixels});
}

hal::Fault ReadJsonCamera(const fs::path& file, CameraDescription& description) {
  std::string text;
  hal::Fault fault = ReadTextFile(file, kMaxCamera_bytes, text);
  if (!fault.ok()) return fault;
  const nlohmann::json json = nlohmann::json::parse(text, nullptr, false);
  if (!json.is_object()) {
    return hal::MakeFault(Status::kCorrupt,
                          "%s: is not JSON; {\"width\",\"height\",\"fx\",\"fy\",\"cx\",\"cy\"} is "
                          "needed",
                          file.c_str());
  }
  fault = ReadSide(file, json, "width", description.width_px);
  if (fault.ok()) fault = ReadSide(file, json, "height", description.height_px);
  if (fault.ok()) fault = CheckPixels(file, description);
  double fx = 0.0;
  double fy = 0.0;
  double cx = 0.0;
  double cy = 0.0;
  if (fault.ok()) fault = ReadNumber(file, json, "fx", fx);
  if (fault.ok()) fault = ReadNumber(file, json, "fy", fy);
  if (fault.ok()) fault = ReadNumber(file, json, "cx", cx);
  if (fault.ok()) fault = ReadNumber(file, json, "cy", cy);
  if (!fault.ok()) return fault;
  description.camera = {static_cast<float>(fx), static_cast<float>(fy), static_cast<float>(cx),
                        static_cast<float>(cy)};
  return CheckCamera(file, description.camera);
}

hal::Fault ReadMatrixCamera(const fs::path& file, CameraDescription& description) {
  TextTable table;
  hal::Fault fault = table.Read(file);
  if (!fault.ok()) return fault;
  if (table.rows().size() != 3) {
    return hal::MakeFault(Status::kCorrupt, "%s: holds %zu lines; the 3x3 matrix K is needed",
                          file.c_str(), table.rows().size());
  }
  std::vector<double> first;
  std::vector<double> second;
  fault = table.ParseNumbers(table.rows()[0], 3, first);
  if (fault.ok()) fault = table.ParseNumbers(table.rows()[1], 3, second);
  if (!fault.ok()) return fault;
  description.camera = {static_cast<float>(first[0]), static_cast<float>(second[1]),
                        static_cast<float>(first[2]), static_cast<float>(second[2])};
  return CheckCamera(file, description.camera);
}

}  // namespace

hal::Fault ReadCamera(const fs::path& sequence_dir, CameraDescription& description) {
  if (fs::exists(sequence_dir / kCameraFile)) {
    return ReadJsonCamera(sequence_dir / kCameraFile, description);
  }
  if (fs::exists(sequence_dir / kIntrinsicsFile)) {
    return ReadMatrixCamera(sequence_dir / kIntrinsicsFile, description);
  }
  return hal::MakeFault(Status::kNotFound,
                        "%s: has neither %s nor %s; add one or say K=fx,fy,cx,cy",
                        sequence_dir.c_str(), kCameraFile, kIntrinsicsFile);
}

}  // namespace disflow::host
