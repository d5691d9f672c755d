// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/host/replay_options.h"

#include <array>

#include "disflow/host/option_value.h"

namespace disflow::host {
namespace {

constexpr std::array kWorldPoses{Choice<WorldPoses>{"auto", WorldPoses::kIfRecorded},
                                 Choice<WorldPoses>{"poses", WorldPoses::kGiven},
                                 Choice<WorldPoses>{"none", WorldPoses::kNone}};
constexpr int kMaxFrames = 100'000'000;

hal::Fault ParseCamera(std::string_view text, std::optional<PinholeCamera>& camera) {
  constexpr std::array<const char*, 4> kNames{"K (fx)", "K (fy)", "K (cx)", "K (cy)"};
  constexpr float kMaxPixels = 1e5F;
  std::array<float, 4> values{};
  for (std::size_t i = 0; i < values.size(); ++i) {
    const std::size_t comma = std::min(text.find(','), text.size());
    const float min = i < 2 ? 1.0F : -kMaxPixels;
    const hal::Fault fault =
        ParseNumber(kNames[i], text.substr(0, comma), min, kMaxPixels, values[i]);
    if (!fault.ok()) return fault;
    text.remove_prefix(std::min(comma + 1, text.size()));
  }
  if (!text.empty()) {
    return hal::MakeFault(Status::kInvalidUri, "K has more than the four numbers fx,fy,cx,cy");
  }
  camera = PinholeCamera{values[0], values[1], values[2], values[3]};
  return {};
}

/// A name of a folder or object, which must not lead out of the sequence's folder.
hal::Fault ParseName(std::string_view key, std::string_view text, std::string& name) {
  if (text.empty() || text.find('/') != std::string_view::npos || text == "..") {
    return hal::MakeFault(Status::kInvalidUri, "%.*s=%.*s is not a plain name",
                          static_cast<int>(key.size()), key.data(), static_cast<int>(text.size()),
                          text.data());
  }
  name = text;
  return {};
}

hal::Fault SetOption(std::string_view key, std::string_view value, ReplayOptions& options) {
  if (key == "mask") return ParseName(key, value, options.mask_set);
  if (key == "object") return ParseName(key, value, options.object);
  if (key == "scale") return ParseNumber(key, value, 1e-7, 1.0, options.unit_m.emplace());
  if (key == "fps") return ParseNumber(key, value, 0.01, 1e4, options.rate_hz.emplace());
  if (key == "K") return ParseCamera(value, options.camera);
  if (key == "T_wc") {
    return ParseChoice(key, value, std::span<const Choice<WorldPoses>>(kWorldPoses),
                       options.world_poses);
  }
  if (key == "first") return ParseNumber(key, value, 0, kMaxFrames, options.first);
  if (key == "count") return ParseNumber(key, value, 1, kMaxFrames, options.count);
  return hal::MakeFault(Status::kInvalidUri,
                        "replay has no option %.*s; known: mask, object, scale, fps, K, T_wc, "
                        "first, count",
                        static_cast<int>(key.size()), key.data());
}

}  // namespace

hal::Fault ParseReplayUri(const Uri& uri, ReplayOptions& options) {
  ReplayOptions parsed;
  parsed.dir = uri.path;
  for (const auto& [key, value] : uri.query) {
    const hal::Fault fault = SetOption(key, value, parsed);
    if (!fault.ok()) return fault;
  }
  options = parsed;
  return {};
}

}  // namespace disflow::host
