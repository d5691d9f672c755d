// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/host/replay_sensor.h"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>
#include <utility>

#include "disflow/host/option_value.h"

namespace disflow::host {
namespace {

using hal::Fault;
using hal::MakeFault;

constexpr int kManyFrames = 100'000'000;

struct CloseFile {
  void operator()(std::FILE* file) const { (void)std::fclose(file); }
};

}  // namespace

Fault ParseReplayUri(const Uri& uri, ReplayOptions& options) {
  ReplayOptions parsed;
  parsed.directory = uri.path;
  if (parsed.directory.empty())
    return MakeFault(Status::kInvalidUri, "replay: wants a folder, e.g. replay:recording");
  for (const auto& [key, value] : uri.query) {
    Fault fault;
    if (key == "mask") {
      parsed.mask = value;
      if (value.empty() || value.find('/') != std::string::npos) {
        fault = MakeFault(Status::kInvalidUri,
                          "mask=%s: want gt, none or the name of a set in masks/", value.c_str());
      }
    } else if (key == "scale") {
      fault = ParseNumber<double>(key, value, 1e-7, 1.0, parsed.scale_m);
    } else if (key == "T_wc") {
      const Choice<bool> choices[] = {{"poses", true}, {"none", false}};
      fault = ParseChoice<bool>(key, value, choices, parsed.use_camera_poses);
    } else if (key == "first") {
      fault = ParseNumber<int>(key, value, 0, kManyFrames, parsed.first);
    } else if (key == "count") {
      fault = ParseNumber<int>(key, value, 0, kManyFrames, parsed.count);
    } else {
      fault =
          MakeFault(Status::kInvalidUri,
                    "replay: knows no %s; allowed: mask, scale, T_wc, first, count", key.c_str());
    }
    if (!fault.ok()) return fault;
  }
  options = parsed;
  return {};
}

ReplaySensor::ReplaySensor(ReplayOptions options) : options_(std::move(options)) {}

Fault ReplaySensor::DoOpen() noexcept try {
  if (open_) return {};
  if (const Fault fault = FindSequence(options_, layout_); !fault.ok()) return fault;
  if (layout_.frames.empty()) {
    return MakeFault(Status::kNotFound, "%s: first=%d leaves no frame to replay",
                     options_.directory.c_str(), options_.first);
  }
  if (layout_.width_px == 0) {
    // A folder of PNG images does not say its size: the first image does.
    if (const Fault fault = ReadGrayPng(layout_.frames.front().depth_file, depth_png_); !fault.ok())
      return fault;
    layout_.width_px = depth_png_.width_px;
    layout_.height_px = depth_png_.height_px;
  }
  const auto pixels =
      static_cast<std::size_t>(layout_.width_px) * static_cast<std::size_t>(layout_.height_px);
  depth_m_.resize(layout_.float_depth ? pixels : 0);
  mask_.assign(pixels, 0);
  name_ =
      "replay of " + options_.directory + ", " + std::to_string(layout_.frames.size()) + " frames";
  next_ = 0;
  open_ = true;
  return {};
} catch (const std::exception& problem) {
  return MakeFault(Status::kIoError, "%s: %s", options_.directory.c_str(), problem.what());
}

Fault ReplaySensor::DoNext(std::int64_t, DepthFrame& frame) noexcept try {
  if (!open_)
    return MakeFault(Status::kNotOpen, "%s: the replay is not open", options_.directory.c_str());
  if (next_ == layout_.frames.size())
    return MakeFault(Status::kEndOfStream, "%s: all frames played", options_.directory.c_str());
  const SequenceFrame& source = layout_.frames[next_++];
  frame = DepthFrame{};
  frame.camera = layout_.camera;
  frame.stamp_ns = source.stamp_ns;
  frame.has_T_wc = source.has_T_wc;
  frame.T_wc = source.T_wc;
  Fault fault = ReadDepth(source, frame);
  if (fault.ok()) fault = ReadMask(source, frame);
  ++(fault.ok() ? counters_.frames : counters_.corrupt);
  return fault;
} catch (const std::exception& problem) {
  ++counters_.corrupt;
  return MakeFault(Status::kCorrupt, "%s: %s", options_.directory.c_str(), problem.what());
}

Fault ReplaySensor::ReadDepth(const SequenceFrame& source, DepthFrame& frame) {
  if (layout_.float_depth) {
    if (const Fault fault = ReadFloat(source.depth_file); !fault.ok()) return fault;
    frame.depth = {depth_m_.data(),       layout_.width_px,
                   layout_.height_px,     static_cast<std::ptrdiff_t>(layout_.width_px) * 4,
                   DepthFormat::kFloat32, 0.001F};
    return {};
  }
  Fault fault = ReadGrayPng(source.depth_file, depth_png_);
  // A file that vanished or is no image is this frame's loss, not the sequence's.
  if (fault.status == Status::kNotFound || fault.status == Status::kUnsupported)
    fault.status = Status::kCorrupt;
  if (!fault.ok()) return fault;
  if (depth_png_.width_px != layout_.width_px || depth_png_.height_px != layout_.height_px) {
    return MakeFault(Status::kCorrupt, "%s: %d x %d pixels; the sequence has %d x %d",
                     source.depth_file.c_str(), depth_png_.width_px, depth_png_.height_px,
                     layout_.width_px, layout_.height_px);
  }
  frame.depth = {depth_png_.pixels.data(), layout_.width_px,
                 layout_.height_px,        static_cast<std::ptrdiff_t>(layout_.width_px) * 2,
                 DepthFormat::kUint16,     static_cast<float>(options_.scale_m)};
  return {};
}

/// u64 width, u64 height (little endian), then float32 metres, row-major.
Fault ReplaySensor::ReadFloat(const std::string& file) {
  const std::unique_ptr<std::FILE, CloseFile> handle(std::fopen(file.c_str(), "rb"));
  if (!handle) return MakeFault(Status::kCorrupt, "%s: %s", file.c_str(), std::strerror(errno));
  std::uint64_t size[2] = {};
  if (std::fread(size, sizeof size[0], 2, handle.get()) != 2) {
    return MakeFault(Status::kTruncated, "%s: ends within its header", file.c_str());
  }
  if (size[0] != static_cast<std::uint64_t>(layout_.width_px) ||
      size[1] != static_cast<std::uint64_t>(layout_.height_px)) {
    return MakeFault(Status::kCorrupt, "%s: header says %llu x %llu, cam_K.json says %d x %d",
                     file.c_str(), static_cast<unsigned long long>(size[0]),
                     static_cast<unsigned long long>(size[1]), layout_.width_px, layout_.height_px);
  }
  const std::size_t got = std::fread(depth_m_.data(), sizeof(float), depth_m_.size(), handle.get());
  if (got != depth_m_.size()) {
    return MakeFault(Status::kTruncated, "%s: ends after %zu of %zu pixels", file.c_str(), got,
                     depth_m_.size());
  }
  if (std::fgetc(handle.get()) != EOF)
    return MakeFault(Status::kCorrupt, "%s: longer than its size says", file.c_str());
  return {};
}

Fault ReplaySensor::ReadMask(const SequenceFrame& source, DepthFrame& frame) {
  const bool wanted = options_.mask != "none" &&
                      std::any_of(layout_.frames.begin(), layout_.frames.end(),
                                  [](const SequenceFrame& f) { return !f.mask_file.empty(); });
  if (!wanted) return {};
  if (source.mask_file.empty()) {
    ++held_masks_;
  } else {
    Fault fault = ReadGrayPng(source.mask_file, mask_png_);
    if (fault.status == Status::kNotFound || fault.status == Status::kUnsupported)
      fault.status = Status::kCorrupt;
    if (!fault.ok()) return fault;
    mask_.resize(mask_png_.pixels.size());
    for (std::size_t i = 0; i < mask_.size(); ++i) mask_[i] = mask_png_.pixels[i] != 0 ? 255 : 0;
  }
  // Its own size, right or wrong: the tracker compares it with the depth image's.
  const bool read = mask_png_.width_px > 0;
  const int width_px = read ? mask_png_.width_px : layout_.width_px;
  frame.mask = {mask_.data(), width_px, read ? mask_png_.height_px : layout_.height_px, width_px};
  return {};
}

void ReplaySensor::DoClose() noexcept { open_ = false; }

hal::SensorInfo ReplaySensor::DoInfo() const noexcept {
  constexpr float kRate_hz = 30.0F;
  return {name_.c_str(), layout_.width_px, layout_.height_px, kRate_hz, false};
}

}  // namespace disflow::host
