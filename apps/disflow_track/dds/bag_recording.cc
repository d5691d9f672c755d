// SPDX-License-Identifier: BSD-3-Clause
#include "dds/bag_recording.h"

#include <cstring>
#include <deque>
#include <utility>
#include <vector>

#include "dds/dds_clock.h"
#include "dds/dds_cloud.h"
#include "dds/dds_motion.h"
#include "dds/dds_status.h"
#include "disflow/host/depth_metres.h"
#include "disflow/posix/dds/ros_cdr.h"
#include "disflow/posix/dds/ros_names.h"
#include "disflow/posix/rosbag/mcap_writer.h"
#include "program/exit_status.h"
#include "settings/dds_address.h"

namespace disflow::apps {
namespace {

namespace ros = posix::ros;

enum Channel : std::size_t { kDepth, kInfo, kMask, kTransforms, kFirstObject };
enum ObjectChannelOf : std::size_t { kOdometry, kStatus, kCloud, kPerObject };

template <class Message>
posix::McapChannel ChannelOf(const std::string& topic) {
  const posix::RosType type = posix::RosTypeOf<Message>();
  return {topic, type.name, type.definition};
}

/// As the link's address says it, if there is one.
DdsAddress AddressOf(const Options& options) {
  DdsAddress address = options.dds_link.empty() ? DdsAddress{} : ParseDdsAddress(options.dds_link);
  // Poses of the camera may come by other ways, which have no name for what they are in.
  if (address.world_frame.empty()) address.world_frame = "world";
  return address;
}

/// Replays keep the stamps they have, so that a recording of theirs plays as they did.
DdsClock::Stamps StampsOf(const hal::SensorInfo& sensor) {
  return sensor.has_monotonic_stamps() ? DdsClock::Stamps::kMonotonic : DdsClock::Stamps::kRos;
}

/// Millimetres as they are, all else in metres.
void CopyDepth(const DepthView& depth, bool as_millimetres, std::vector<std::uint8_t>& data) {
  const std::size_t pixel = as_millimetres ? sizeof(std::uint16_t) : sizeof(float);
  const std::size_t row = static_cast<std::size_t>(depth.width_px) * pixel;
  data.resize(row * static_cast<std::size_t>(depth.height_px));
  if (!as_millimetres) {
    host::CopyMetres(depth, data.data());
    return;
  }
  for (int v = 0; v < depth.height_px; ++v)
    std::memcpy(data.data() + static_cast<std::size_t>(v) * row, depth.row(v), row);
}

}  // namespace

/// One object's names and what its messages are made of.
struct RecordedObject {
  RecordedObject(DdsFrames names, const std::string& shown_name)
      : frames(std::move(names)), status(shown_name) {}

  DdsFrames frames;
  DdsStatus status;
  DdsModelCloud cloud;
};

struct BagRecording::State {
  State(const Options& options, const hal::SensorInfo& sensor)
      : address(AddressOf(options)),
        clock(StampsOf(sensor)),
        frames{address.camera_frame, {}, address.world_frame} {
    const std::string root = "/" + address.name;
    std::vector<posix::McapChannel> channels = {
        ChannelOf<ros::Image>(root + "/depth/image_rect_raw"),
        ChannelOf<ros::CameraInfo>(root + "/depth/camera_info"),
        ChannelOf<ros::Image>(root + "/mask"), ChannelOf<ros::TFMessage>("/tf")};
    for (const ObjectOptions& object : options.objects) {
      const std::string name = address.name + "/" + posix::RosNamePart(object.name);
      objects.emplace_back(DdsFrames{address.camera_frame, name, address.world_frame},
                           address.name + ": " + object.name);
      channels.push_back(ChannelOf<ros::Odometry>("/" + name + "/odometry"));
      channels.push_back(ChannelOf<ros::DiagnosticArray>("/" + name + "/status"));
      channels.push_back(ChannelOf<ros::PointCloud2>("/" + name + "/cloud"));
    }
    Require(writer.Open(options.record, channels), kOutputFailed);
  }

  template <class Message>
  void Put(std::size_t channel, const Message& message) {
    posix::SerializeCdr(message, bytes);
    writer.Add(channel, ros_ns, bytes);
  }
  void PutFrame(const DepthFrame& frame);
  void PutImage(std::size_t channel, const char* encoding, int width_px, int height_px);
  void PutInfo(const DepthFrame& frame);
  void PutTransform(const ros::TransformStamped& transform);
  void PutResult(std::size_t number, const FrameResult& result);
  void PutClouds(std::span<const SampleList> models);

  DdsAddress address;
  DdsClock clock;
  posix::McapWriter writer;
  DdsFrames frames;  ///< Of the camera alone.
  std::deque<RecordedObject> objects;
  std::int64_t ros_ns = 0;          ///< Of the frame that is being added.
  std::vector<std::uint8_t> data;   ///< Of an image.
  std::vector<std::uint8_t> bytes;  ///< Of a message.
  int count = 0;
};

void BagRecording::State::PutFrame(const DepthFrame& frame) {
  constexpr float kMillimetre_m = 0.001F;
  const bool as_millimetres =
      frame.depth.format == DepthFormat::kUint16 && frame.depth.unit_m == kMillimetre_m;
  CopyDepth(frame.depth, as_millimetres, data);
  PutImage(kDepth, as_millimetres ? "16UC1" : "32FC1", frame.depth.width_px, frame.depth.height_px);
  PutInfo(frame);
  if (frame.has_T_wc) {
    PutTransform(MakeRosCameraTransform(frame.T_wc, ros_ns, frames));
  }
  if (!frame.mask.given()) return;
  data.clear();
  for (int v = 0; v < frame.mask.height_px; ++v)
    data.insert(data.end(), frame.mask.row(v), frame.mask.row(v) + frame.mask.width_px);
  PutImage(kMask, "mono8", frame.mask.width_px, frame.mask.height_px);
}

/// Whose pixels are in `data`.
void BagRecording::State::PutImage(std::size_t channel, const char* encoding, int width_px,
                                   int height_px) {
  const std::string name = encoding;
  ros::Image message{};
  message.header = RosHeader(ros_ns, address.camera_frame);
  message.height = static_cast<std::uint32_t>(height_px);
  message.width = static_cast<std::uint32_t>(width_px);
  message.encoding = posix::Lend(name);
  if (message.height > 0) message.step = static_cast<std::uint32_t>(data.size()) / message.height;
  posix::Lend(data, message.data);
  Put(channel, message);
}

/// Without distortion: the tracker takes images for rectified.
void BagRecording::State::PutInfo(const DepthFrame& frame) {
  static const std::string model = "plumb_bob";
  std::vector<double> d(5, 0.0);
  const auto exact = [](float value) { return static_cast<double>(value); };
  ros::CameraInfo message{};
  message.header = RosHeader(ros_ns, address.camera_frame);
  message.height = static_cast<std::uint32_t>(frame.depth.height_px);
  message.width = static_cast<std::uint32_t>(frame.depth.width_px);
  message.distortion_model = posix::Lend(model);
  posix::Lend(d, message.d);
  const PinholeCamera& camera = frame.camera;
  message.k[0] = message.p[0] = exact(camera.fx_px);
  message.k[2] = message.p[2] = exact(camera.cx_px);
  message.k[4] = message.p[5] = exact(camera.fy_px);
  message.k[5] = message.p[6] = exact(camera.cy_px);
  message.k[8] = message.p[10] = 1.0;
  message.r[0] = message.r[4] = message.r[8] = 1.0;
  Put(kInfo, message);
}

void BagRecording::State::PutResult(std::size_t number, const FrameResult& result) {
  RecordedObject& object = objects[number];
  const Estimate& estimate = result.estimate;
  const std::size_t first = kFirstObject + number * kPerObject;
  Put(first + kStatus, object.status.Message(result, 0, ros_ns, object.frames));
  // As over DDS: these messages cannot say that they hold a prediction.
  if (KindOf(estimate) != EstimateKind::kMeasured) return;
  Put(first + kOdometry, MakeRosOdometry(estimate, ros_ns, object.frames));
  PutTransform(MakeRosTransform(estimate, ros_ns, object.frames));
}

void BagRecording::State::PutTransform(const ros::TransformStamped& transform) {
  std::vector<ros::TransformStamped> transforms = {transform};
  ros::TFMessage message{};
  posix::Lend(transforms, message.transforms);
  Put(kTransforms, message);
}

void BagRecording::State::PutClouds(std::span<const SampleList> models) {
  for (std::size_t i = 0; i < models.size(); ++i) {
    RecordedObject& object = objects[i];
    Put(kFirstObject + i * kPerObject + kCloud,
        object.cloud.Message(models[i], ros_ns, object.frames));
  }
}

BagRecording::BagRecording(const Options& options, const hal::SensorInfo& sensor)
    : state_(std::make_unique<State>(options, sensor)) {}

BagRecording::~BagRecording() = default;

hal::Fault BagRecording::Add(const DepthFrame* frame, std::span<const FrameResult> results,
                             std::span<const SampleList> models) {
  State& state = *state_;
  if (frame != nullptr) {
    state.ros_ns = state.clock.ToRos(frame->stamp_ns);
    state.PutFrame(*frame);
  }
  for (std::size_t i = 0; i < results.size(); ++i) state.PutResult(i, results[i]);
  if (frame != nullptr) state.PutClouds(models);
  const hal::Fault fault = state.writer.WriteChunk();
  if (fault.ok() && frame != nullptr) ++state.count;
  return fault;
}

hal::Fault BagRecording::Finish() { return state_->writer.Close(); }

int BagRecording::frame_count() const noexcept { return state_->count; }

std::int64_t BagRecording::size_bytes() const noexcept {
  return static_cast<std::int64_t>(state_->writer.size_bytes());
}

}  // namespace disflow::apps
