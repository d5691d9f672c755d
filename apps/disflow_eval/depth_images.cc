// SPDX-License-Identifier: BSD-3-Clause
#include "depth_images.h"

#include <array>
#include <bit>
#include <cstring>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>

#include "disflow/host/image_limits.h"
#include "errors.h"
#include "text_file.h"

namespace disflow::apps {
namespace {

namespace fs = std::filesystem;

static_assert(std::endian::native == std::endian::little, "images are read without swapping");

constexpr double kMaxSide_px = host::kMaxImageSide_px;
constexpr std::size_t kMaxCamera_bytes = 65536;
constexpr std::size_t kHeaderBytes = 2 * sizeof(std::uint64_t);

double Entry(const fs::path& file, const nlohmann::json& json, const char* key, double max) {
  const auto found = json.find(key);
  if (found != json.end() && found->is_number()) {
    const double value = found->get<double>();
    if (value > 0.0 && value <= max) return value;
  }
  throw InputError(file, std::string("needs a positive number '") + key + "'");
}

}  // namespace

DepthImages::DepthImages(fs::path sequence_dir) : sequence_dir_(std::move(sequence_dir)) {
  const fs::path file = sequence_dir_ / "cam_K.json";
  const auto json = nlohmann::json::parse(ReadRecordedFile(file, kMaxCamera_bytes), nullptr,
                                          /*allow_exceptions=*/false);
  if (!json.is_object()) throw InputError(file, "is no JSON object");
  const auto focal = [&](const char* key) {
    return static_cast<float>(Entry(file, json, key, 1e6));
  };
  camera_ = {focal("fx"), focal("fy"), focal("cx"), focal("cy")};
  width_px_ = static_cast<int>(Entry(file, json, "width", kMaxSide_px));
  height_px_ = static_cast<int>(Entry(file, json, "height", kMaxSide_px));
  if (Pixels() > host::kMaxImagePixels) {
    throw InputError(file, "says " + std::to_string(width_px_) + " x " +
                               std::to_string(height_px_) + " pixels; " +
                               std::to_string(host::kMaxImagePixels) + " can be read");
  }
}

fs::path DepthImages::FileOf(int index) const {
  return sequence_dir_ / "depth" / (std::to_string(index) + ".float");
}

bool DepthImages::Has(int index) const {
  std::error_code error;
  return fs::exists(FileOf(index), error);
}

DepthFrame DepthImages::Load(int index) {
  const fs::path file = FileOf(index);
  const std::string bytes = ReadRecordedFile(file);
  const std::size_t pixel_bytes = Pixels() * sizeof(float);
  std::array<std::uint64_t, 2> size{};
  if (bytes.size() >= kHeaderBytes) std::memcpy(size.data(), bytes.data(), kHeaderBytes);
  if (size[0] != static_cast<std::uint64_t>(width_px_) ||
      size[1] != static_cast<std::uint64_t>(height_px_) ||
      bytes.size() != kHeaderBytes + pixel_bytes) {
    throw InputError(file, "is truncated or not the " + std::to_string(width_px_) + " x " +
                               std::to_string(height_px_) + " image that cam_K.json promises");
  }
  depth_m_.resize(Pixels());
  std::memcpy(depth_m_.data(), bytes.data() + kHeaderBytes, pixel_bytes);
  DepthFrame frame;
  frame.camera = camera_;
  frame.depth = {depth_m_.data(), width_px_, height_px_,
                 static_cast<std::ptrdiff_t>(sizeof(float)) * width_px_, DepthFormat::kFloat32};
  return frame;
}

}  // namespace disflow::apps
