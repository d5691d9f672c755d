// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/host/replay_sensor.h"

#include <algorithm>
#include <exception>
#include <string>
#include <utility>
#include <vector>

#include "disflow/host/image_limits.h"
#include "disflow/host/png_image.h"
#include "disflow/host/sequence_layout.h"
#include "float_depth_file.h"
#include "sequence_index.h"

namespace disflow::host {
namespace {

using hal::Fault;

/// A file of one frame that is missing or no image at all is that frame's loss only.
Fault AsLostFrame(Fault fault) {
  if (!fault.ok() && fault.status != Status::kTruncated) fault.status = Status::kCorrupt;
  return fault;
}

}  // namespace

/// The last mask of an object.
struct ObjectMask {
  std::vector<std::uint8_t> pixels;
  int width_px = 0;
  int height_px = 0;
};

/// The open sequence and its buffers, which are reused from frame to frame.
struct ReplaySensor::State {
  explicit State(const ReplayOptions& replay_options) : options(replay_options) {}

  [[nodiscard]] Fault FindSize();
  [[nodiscard]] Fault CheckMasks() const;
  [[nodiscard]] Fault SizeFault(const RecordedFrame& source, const DepthView& depth) const;
  [[nodiscard]] Fault ReadFrame(const RecordedFrame& source, DepthFrame& frame);
  [[nodiscard]] Fault ReadDepth(const RecordedFrame& source, DepthFrame& frame);
  [[nodiscard]] Fault ReadMasks(const RecordedFrame& source, DepthFrame& frame);
  [[nodiscard]] Fault ReadMask(const std::filesystem::path& path, ObjectMask& mask);

  const ReplayOptions& options;
  SequenceIndex index;
  int width_px = 0;
  int height_px = 0;
  FloatImage depth_float;
  GrayImage depth_png;
  GrayImage mask_png;
  std::vector<ObjectMask> masks;  ///< One per object.
  std::vector<std::uint8_t> labels;
  int held_masks = 0;
  std::size_t next = 0;
  hal::SensorCounters counters;
  bool open = false;
};

/// The camera's file may not say the image size: then the first readable image does.
Fault ReplaySensor::State::FindSize() {
  width_px = index.camera.width_px;
  height_px = index.camera.height_px;
  Fault fault;
  for (std::size_t i = 0; i < index.frames.size() && width_px == 0; ++i) {
    DepthFrame frame;
    fault = ReadDepth(index.frames[i], frame);
    if (!fault.ok()) continue;
    width_px = frame.depth.width_px;
    height_px = frame.depth.height_px;
  }
  return width_px > 0 ? Fault{} : fault;
}

/// Every object's last mask is kept.
Fault ReplaySensor::State::CheckMasks() const {
  const std::uint64_t pixels = static_cast<std::uint64_t>(width_px) *
                               static_cast<std::uint64_t>(height_px) *
                               static_cast<std::uint64_t>(index.masked_objects);
  constexpr std::uint64_t kMaxMaskPixels = 4 * kMaxImagePixels;
  if (pixels <= kMaxMaskPixels) return {};
  return hal::MakeFault(Status::kImageTooLarge,
                        "%s: masks of %d objects and %d x %d pixels are too many; choose with "
                        "object=NAME",
                        options.dir.c_str(), index.masked_objects, width_px, height_px);
}

/// Says where the size is from that the image does not have.
Fault ReplaySensor::State::SizeFault(const RecordedFrame& source, const DepthView& depth) const {
  // Its name alone, since a Fault has no room for two long paths.
  const std::string other =
      index.camera.width_px > 0 ? std::string(kCameraFile) + " says" : "the first is";
  return hal::MakeFault(Status::kCorrupt, "%s: is %d x %d pixels, %s %d x %d", source.depth.c_str(),
                        depth.width_px, depth.height_px, other.c_str(), width_px, height_px);
}

Fault ReplaySensor::State::ReadFrame(const RecordedFrame& source, DepthFrame& frame) {
  frame = DepthFrame{};
  frame.camera = source.camera.value_or(index.camera.camera);
  frame.stamp_ns = source.stamp_ns;
  frame.has_T_wc = source.has_T_wc;
  frame.T_wc = source.T_wc;
  Fault fault = ReadDepth(source, frame);
  if (fault.ok() && (frame.depth.width_px != width_px || frame.depth.height_px != height_px))
    fault = SizeFault(source, frame.depth);
  if (fault.ok() && index.masked_objects > 0) fault = ReadMasks(source, frame);
  return AsLostFrame(fault);
}

Fault ReplaySensor::State::ReadDepth(const RecordedFrame& source, DepthFrame& frame) {
  DepthView& view = frame.depth;
  Fault fault;
  if (index.float_depth) {
    fault = ReadFloatDepth(source.depth, depth_float);
    view.data = depth_float.pixels.data();
    view.width_px = depth_float.width_px;
    view.height_px = depth_float.height_px;
    view.format = DepthFormat::kFloat32;
  } else {
    fault = ReadGrayPng(source.depth, depth_png);
    view.data = depth_png.pixels.data();
    view.width_px = depth_png.width_px;
    view.height_px = depth_png.height_px;
    view.format = DepthFormat::kUint16;
    view.unit_m = options.unit_m ? static_cast<float>(*options.unit_m) : source.unit_m;
  }
  view.stride_bytes = static_cast<std::ptrdiff_t>(view.width_px) * view.bytes_per_pixel();
  return fault;
}

Fault ReplaySensor::State::ReadMasks(const RecordedFrame& source, DepthFrame& frame) {
  for (std::size_t i = 0; i < masks.size(); ++i) {
    const Fault fault = ReadMask(source.masks[i], masks[i]);
    if (!fault.ok()) return fault;
  }
  if (masks.size() == 1) {
    const ObjectMask& mask = masks.front();
    frame.mask = {mask.pixels.data(), mask.width_px, mask.height_px, mask.width_px};
    return {};
  }
  labels.assign(labels.size(), 0);
  // The first last, so that it wins where masks overlap.
  for (std::size_t i = masks.size(); i-- > 0;) {
    const ObjectMask& mask = masks[i];
    if (mask.width_px != width_px || mask.height_px != height_px) {
      return hal::MakeFault(Status::kCorrupt, "%s: is %d x %d pixels, the depth image %d x %d",
                            source.masks[i].c_str(), mask.width_px, mask.height_px, width_px,
                            height_px);
    }
    for (std::size_t pixel = 0; pixel < labels.size(); ++pixel)
      if (mask.pixels[pixel] != 0) labels[pixel] = static_cast<std::uint8_t>(i + 1);
  }
  frame.mask = {labels.data(), width_px, height_px, width_px};
  return {};
}

Fault ReplaySensor::State::ReadMask(const std::filesystem::path& path, ObjectMask& mask) {
  if (path.empty()) {
    ++held_masks;
    return {};
  }
  Fault fault = ReadGrayPng(path, mask_png);
  // What there is of a cut mask would be taken for the whole object.
  if (!fault.ok()) fault.status = Status::kCorrupt;
  if (!fault.ok()) return fault;
  mask.pixels.resize(mask_png.pixels.size());
  // Values are kept, since they may be labels.
  std::transform(mask_png.pixels.begin(), mask_png.pixels.end(), mask.pixels.begin(),
                 [](std::uint16_t value) {
                   constexpr std::uint16_t kHighest = 255;
                   return static_cast<std::uint8_t>(std::min<std::uint16_t>(value, kHighest));
                 });
  mask.width_px = mask_png.width_px;
  mask.height_px = mask_png.height_px;
  return {};
}

ReplaySensor::ReplaySensor(ReplayOptions options)
    : options_(std::move(options)), state_(std::make_unique<State>(options_)) {}

ReplaySensor::~ReplaySensor() = default;

int ReplaySensor::held_masks() const { return state_->held_masks; }

const std::string& ReplaySensor::note() const { return state_->index.cut_note; }

Fault ReplaySensor::DoOpen() noexcept try {
  State& state = *state_;
  if (state.open) return {};
  Fault fault = IndexSequence(options_, state.index);
  if (fault.ok()) fault = state.FindSize();
  if (fault.ok()) fault = state.CheckMasks();
  if (!fault.ok()) return fault;
  state.labels.assign(
      static_cast<std::size_t>(state.width_px) * static_cast<std::size_t>(state.height_px), 0);
  state.masks.assign(static_cast<std::size_t>(state.index.masked_objects),
                     {state.labels, state.width_px, state.height_px});
  state.held_masks = 0;
  state.next = 0;
  state.counters = {};
  name_ = "replay of " + options_.dir.string() + ", " + std::to_string(state.index.frames.size()) +
          " frames";
  state.open = true;
  return {};
} catch (const std::exception& error) {
  return hal::MakeFault(Status::kIoError, "%s: %s", options_.dir.c_str(), error.what());
}

Fault ReplaySensor::DoNext(std::int64_t /*timeout_ns*/, DepthFrame& frame) noexcept try {
  State& state = *state_;
  if (!state.open) {
    return hal::MakeFault(Status::kNotOpen, "%s: not open; call Open() first",
                          options_.dir.c_str());
  }
  if (state.next == state.index.frames.size()) {
    return hal::MakeFault(Status::kEndOfStream, "%s: the sequence is over", options_.dir.c_str());
  }
  Fault fault = state.ReadFrame(state.index.frames[state.next++], frame);
  ++(fault.ok() ? state.counters.frames : state.counters.corrupt);
  return fault;
} catch (const std::exception& error) {
  ++state_->counters.corrupt;
  return hal::MakeFault(Status::kCorrupt, "%s: %s", options_.dir.c_str(), error.what());
}

void ReplaySensor::DoClose() noexcept { state_->open = false; }

hal::SensorInfo ReplaySensor::DoInfo() const noexcept {
  const State& state = *state_;
  hal::SensorInfo info;
  info.name = name_.c_str();
  info.width_px = state.width_px;
  info.height_px = state.height_px;
  if (const auto& frames = state.index.frames; frames.size() > 1) {
    const auto duration_ns = static_cast<double>(frames.back().stamp_ns - frames.front().stamp_ns);
    const auto intervals = static_cast<double>(frames.size() - 1);
    if (duration_ns > 0.0) info.rate_hz = static_cast<float>(intervals * 1e9 / duration_ns);
  }
  return info;
}

hal::SensorCounters ReplaySensor::DoCounters() const noexcept { return state_->counters; }

}  // namespace disflow::host
