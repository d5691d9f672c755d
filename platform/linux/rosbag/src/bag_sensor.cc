// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/posix/rosbag/bag_sensor.h"

#include <exception>
#include <utility>
#include <vector>

#include "camera_messages.h"
#include "camera_path.h"
#include "depth_topics.h"
#include "disflow/host/image_limits.h"
#include "disflow/posix/shown_text.h"
#include "disflow/saturating.h"
#include "followed_topic.h"

namespace disflow::posix {
namespace {

using hal::Fault;
using hal::MakeFault;

/// A frame is, and the next call goes on.
bool IsLost(const Fault& fault) {
  return fault.status == Status::kCorrupt || fault.status == Status::kTruncated;
}

struct Mask {
  std::vector<std::uint8_t> pixels;
  int width_px = 0;
  int height_px = 0;
};

Fault ReadMask(const BagMessage& message, StampNs& stamp_ns, Mask& mask) {
  if (!IsSensorMessage(message, "Image")) {
    return MakeFault(Status::kUnsupported, "is of type %s; a mask is a sensor_msgs/msg/Image",
                     ShownText(message.type, 64).c_str());
  }
  RosImage image;
  const Fault fault = ReadImage(message, stamp_ns, image);
  if (!fault.ok()) return fault;
  if (image.encoding != "mono8" && image.encoding != "8UC1") {
    return MakeFault(Status::kUnsupported, "encoding '%s' is no mask; mono8 and 8UC1 are",
                     ShownText(image.encoding).c_str());
  }
  const std::uint64_t step = image.step_bytes;
  if (image.width_px > host::kMaxImageSide_px || image.height_px > host::kMaxImageSide_px ||
      step < image.width_px || image.data.size() < step * image.height_px) {
    return MakeFault(Status::kCorrupt, "a mask of %u x %u pixels with rows of %u and %zu bytes",
                     image.width_px, image.height_px, image.step_bytes, image.data.size());
  }
  mask.width_px = static_cast<int>(image.width_px);
  mask.height_px = static_cast<int>(image.height_px);
  mask.pixels.clear();
  for (std::size_t row = 0; row < image.height_px; ++row) {
    const auto pixels = image.data.subspan(row * image.step_bytes, image.width_px);
    mask.pixels.insert(mask.pixels.end(), pixels.begin(), pixels.end());
  }
  return {};
}

}  // namespace

/// The open recording and its buffers, which are reused from frame to frame.
struct BagSensor::State {
  explicit State(const BagOptions& bag_options) : options(bag_options) {}

  [[nodiscard]] Fault Restart();
  [[nodiscard]] Fault FindSize();
  [[nodiscard]] Fault Next(DepthFrame& frame);
  [[nodiscard]] Fault Decode(const BagMessage& message, DepthFrame& frame);
  [[nodiscard]] Fault ApplyUnit(DepthView& view) const;
  [[nodiscard]] Fault Accompany(DepthFrame& frame);
  [[nodiscard]] Fault ReadInfo(const BagMessage& message, StampNs& stamp_ns,
                               RosIntrinsics& intrinsics) const;
  [[nodiscard]] bool has_path() const noexcept { return !options.world_frame.empty(); }
  [[nodiscard]] bool has_masks() const noexcept { return !options.mask_topic.empty(); }

  const BagOptions& options;
  std::vector<std::filesystem::path> files;
  std::string note;
  TopicStream depth;
  FollowedTopic<RosIntrinsics> infos;
  FollowedTopic<Mask> masks;
  CameraPath path;
  RosDepthDecoder decoder;
  std::vector<std::uint8_t> image;  ///< Where its pixels are aligned.
  std::vector<std::uint8_t> no_mask;
  std::string camera_frame;  ///< As the first good image says.
  int taken = 0;             ///< Images, those left out included.
  int width_px = 0;
  int height_px = 0;
  hal::SensorCounters counters;
  bool open = false;
};

Fault BagSensor::State::ReadInfo(const BagMessage& message, StampNs& stamp_ns,
                                 RosIntrinsics& intrinsics) const {
  if (IsSensorMessage(message, "CameraInfo"))
    return ReadIntrinsics(message, options.rectified.value_or(false), stamp_ns, intrinsics);
  return MakeFault(Status::kUnsupported, "is of type %s; sensor_msgs/msg/CameraInfo is needed",
                   ShownText(message.type, 64).c_str());
}

/// Back to the first frame.
Fault BagSensor::State::Restart() {
  taken = 0;
  infos.Restart();
  masks.Restart();
  Fault fault = depth.Open(files, options.depth_topic);
  if (fault.ok()) fault = infos.stream.Open(files, options.info_topic);
  if (fault.ok()) {
    fault = infos.BeginWithFirst(
        [this](const BagMessage& message, StampNs& stamp_ns, RosIntrinsics& intrinsics) {
          return ReadInfo(message, stamp_ns, intrinsics);
        });
  }
  if (fault.ok() && has_masks()) fault = masks.stream.Open(files, options.mask_topic);
  // What the camera's frame is called is not known before the first image.
  if (fault.ok() && has_path() && width_px > 0) fault = path.Restart(files);
  return fault;
}

/// The first good image says how large all are.
Fault BagSensor::State::FindSize() {
  // Of damaged ones a short file may hold millions.
  constexpr int kMostDamaged = 10'000;
  if (const Fault fault = Restart(); !fault.ok()) return fault;
  DepthFrame frame;
  Fault reason;
  Fault fault = Next(frame);
  for (int damaged = 1; IsLost(fault) && damaged < kMostDamaged; ++damaged) {
    if (reason.ok()) reason = fault;
    fault = Next(frame);
  }
  const bool is_over = fault.status == Status::kEndOfStream;
  if ((is_over || IsLost(fault)) && !reason.ok()) return reason;
  if (is_over && taken == 0) return depth.Missing();
  if (!fault.ok()) return fault;
  width_px = frame.depth.width_px;
  height_px = frame.depth.height_px;
  decoder.FixSize(width_px, height_px);
  no_mask.assign(static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px), 0);
  if (has_masks()) {
    // A mask of another kind, or none at all, is to be known before the first frame.
    fault = masks.BeginWithFirst(ReadMask);
    if (!fault.ok()) return fault;
  }
  if (has_path()) {
    fault = path.Open(files, options.world_frame,
                      options.camera_frame.empty() ? camera_frame : options.camera_frame);
    if (!fault.ok()) return fault;
  }
  return Restart();
}

/// @return kCorrupt or kTruncated for a frame that is lost; the next call goes on.
Fault BagSensor::State::Next(DepthFrame& frame) {
  BagMessage message;
  for (bool wanted = false; !wanted;) {
    if (taken >= options.first && taken - options.first >= options.count)
      return MakeFault(Status::kEndOfStream, "%s: as many as were asked for", options.path.c_str());
    const Fault fault = depth.Next(message);
    if (!fault.ok()) return fault;
    wanted = taken++ >= options.first;
  }
  frame = DepthFrame{};
  if (width_px == 0) camera_frame = ReadFrameName(message);
  Fault fault = Decode(message, frame);
  if (fault.ok()) fault = ApplyUnit(frame.depth);
  if (fault.ok()) fault = Accompany(frame);
  if (fault.ok()) return fault;
  // At the start an unknown type is the wrong topic; of all else this message is lost.
  const bool is_for_good = fault.status == Status::kUnsupported && width_px == 0;
  const bool is_short = fault.status == Status::kTruncated;
  return MakeFault(is_for_good || is_short ? fault.status : Status::kCorrupt, "%s: image %d: %s",
                   options.depth_topic.c_str(), taken - 1, fault.message);
}

Fault BagSensor::State::Decode(const BagMessage& message, DepthFrame& frame) {
  if (IsSensorMessage(message, "Image")) {
    RosImage raw;
    const Fault fault = ReadImage(message, frame.stamp_ns, raw);
    if (!fault.ok()) return fault;
    image.assign(raw.data.begin(), raw.data.end());
    raw.data = image;
    // librealsense calls its depth so; what a step of it means stands elsewhere.
    if (raw.encoding == "mono16") {
      if (!options.unit_m) {
        return MakeFault(Status::kUnsupported,
                         "encoding 'mono16' has no unit; if it is depth, say scale=0.001 (metres "
                         "per step)");
      }
      raw.encoding = "16UC1";
    }
    return decoder.Decode(raw, frame.depth);
  }
  if (IsSensorMessage(message, "CompressedImage")) {
    CompressedImage packed;
    const Fault fault = ReadCompressedImage(message, frame.stamp_ns, packed);
    if (!fault.ok()) return fault;
    return decoder.DecodeCompressed(packed.format, packed.data, frame.depth);
  }
  return MakeFault(Status::kUnsupported,
                   "is of type %s; sensor_msgs/msg/Image or CompressedImage is needed",
                   ShownText(message.type, 64).c_str());
}

Fault BagSensor::State::ApplyUnit(DepthView& view) const {
  if (!options.unit_m) return {};
  if (view.format != DepthFormat::kUint16)
    return MakeFault(Status::kUnsupported, "scale is for 16-bit images; these are in metres");
  view.unit_m = static_cast<float>(*options.unit_m);
  return {};
}

/// Adds intrinsics and mask.
Fault BagSensor::State::Accompany(DepthFrame& frame) {
  Fault fault = infos.FollowTo(frame.stamp_ns, [this](const BagMessage& message, StampNs& stamp_ns,
                                                      RosIntrinsics& intrinsics) {
    return ReadInfo(message, stamp_ns, intrinsics);
  });
  if (!fault.ok()) return fault;
  const RosIntrinsics& intrinsics = infos.current();
  if (intrinsics.width_px != static_cast<std::uint32_t>(frame.depth.width_px) ||
      intrinsics.height_px != static_cast<std::uint32_t>(frame.depth.height_px)) {
    return MakeFault(Status::kCorrupt, "has %d x %d pixels, but %s is of images of %u x %u",
                     frame.depth.width_px, frame.depth.height_px, options.info_topic.c_str(),
                     intrinsics.width_px, intrinsics.height_px);
  }
  frame.camera = intrinsics.camera;
  if (has_path() && width_px > 0) fault = path.Accompany(frame);
  if (!fault.ok() || !has_masks() || no_mask.empty()) return fault;
  fault = masks.FollowTo(frame.stamp_ns, ReadMask);
  const Mask& mask = masks.current();
  if (mask.pixels.empty()) {
    frame.mask = {no_mask.data(), width_px, height_px, width_px};
  } else {
    frame.mask = {mask.pixels.data(), mask.width_px, mask.height_px, mask.width_px};
  }
  return fault;
}

BagSensor::BagSensor(BagOptions options)
    : options_(std::move(options)), state_(std::make_unique<State>(options_)) {}

BagSensor::~BagSensor() = default;

const std::string& BagSensor::note() const { return state_->note; }

Fault BagSensor::DoOpen() noexcept try {
  State& state = *state_;
  if (state.open) return {};
  Fault fault = ListBagFiles(options_.path, state.files);
  if (fault.ok()) fault = NoteWhatIsCut(state.files, state.note);
  if (fault.ok() && options_.depth_topic.empty()) {
    fault = FindDepthTopic(state.files, options_);
    if (fault.ok()) {
      state.note.append(state.note.empty() ? "" : "; ")
          .append(options_.path.string() + ": its depth images are those of ")
          .append(options_.depth_topic);
    }
  }
  if (fault.ok()) fault = state.FindSize();
  state.open = fault.ok();
  name_ = options_.depth_topic + " of " + options_.path.string();
  return fault;
} catch (const std::exception& error) {
  return MakeFault(Status::kIoError, "%s: %s", options_.path.c_str(), error.what());
}

Fault BagSensor::DoNext(std::int64_t /*timeout_ns*/, DepthFrame& frame) noexcept try {
  State& state = *state_;
  if (!state.open)
    return MakeFault(Status::kNotOpen, "%s: not open; call Open() first", options_.path.c_str());
  const Fault fault = state.Next(frame);
  if (fault.ok()) AddSaturating(state.counters.frames);
  if (IsLost(fault)) AddSaturating(state.counters.corrupt);
  return fault;
} catch (const std::exception& error) {
  return MakeFault(Status::kIoError, "%s: %s", options_.path.c_str(), error.what());
}

void BagSensor::DoClose() noexcept { state_->open = false; }

hal::SensorInfo BagSensor::DoInfo() const noexcept {
  hal::SensorInfo info;
  info.name = name_.c_str();
  info.width_px = state_->width_px;
  info.height_px = state_->height_px;
  info.epoch_stamps = true;
  return info;
}

hal::SensorCounters BagSensor::DoCounters() const noexcept { return state_->counters; }

}  // namespace disflow::posix
