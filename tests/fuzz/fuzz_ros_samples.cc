// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What other participants of a DDS domain send, as bytes: taken apart by Cyclone DDS, read and
/// answered by everything that the program lets others ask and say. Whatever it is, each request
/// has one reply, settings stay such as can be used, and images are such as can be read.

#include <unistd.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "chosen_object_check.h"
#include "dds/dds_choice.h"
#include "dds/dds_inputs.h"
#include "dds/dds_lifecycle.h"
#include "dds/dds_parameters.h"
#include "depth_image_check.h"
#include "disflow/config_fields.h"
#include "disflow/posix/dds/ros_depth_sensor.h"
#include "fuzzed_numbers.h"
#include "raw_samples.h"

namespace {

using namespace disflow;
using fuzz::FuzzedNumbers;
using fuzz::RawWriter;
using fuzz::Require;
namespace ros = posix::ros;

constexpr int kWidth_px = 16;
constexpr int kHeight_px = 12;
constexpr const char* kPacked = "/packed/compressedDepth";
/// Fewer than the program takes in one turn.
constexpr int kMostMessages = 16;

/// Alone in its domain, as far as a machine allows.
std::shared_ptr<posix::RosNode> OpenNode() {
  auto node = std::make_shared<posix::RosNode>();
  const auto domain = 120U + static_cast<std::uint32_t>(::getpid()) % 100U;
  Require(node->Open({.network = {domain, "lo", {}}, .name = "disflow"}).ok());
  return node;
}

apps::DdsAddress Address() {
  apps::DdsAddress address;
  address.camera_frame = "camera";
  address.world_frame = "map";
  address.mask_topic = "/mask";
  return address;
}

/// The other end of a service.
class Caller {
 public:
  template <class Request, class Response>
  static Caller Of(dds_entity_t participant, const std::string& service) {
    const dds_entity_t topic =
        RawWriter::TopicOf<Response>(participant, posix::ReplyTopicName(service));
    dds_qos_t* const qos = dds_create_qos();
    dds_qset_reliability(qos, DDS_RELIABILITY_RELIABLE, DDS_MSECS(100));
    dds_qset_history(qos, DDS_HISTORY_KEEP_ALL, 0);
    const dds_entity_t reader = dds_create_reader(participant, topic, qos, nullptr);
    dds_delete_qos(qos);
    Require(reader > 0);
    return Caller(RawWriter::Of<Request>(participant, posix::RequestTopicName(service)), reader);
  }

  void Ask(bool is_big_endian, const std::vector<std::uint8_t>& body) {
    if (requests_.Write(is_big_endian, body)) ++asked_;
  }
  void CheckReplies() {
    int replies = 0;
    void* reply = nullptr;
    dds_sample_info_t info;
    while (dds_take(replies_, &reply, &info, 1, 1) == 1) {
      if (info.valid_data) ++replies;
      (void)dds_return_loan(replies_, &reply, 1);
      reply = nullptr;
    }
    Require(replies == std::exchange(asked_, 0));
  }

 private:
  Caller(const RawWriter& requests, dds_entity_t replies)
      : requests_(requests), replies_(replies) {}

  RawWriter requests_;
  dds_entity_t replies_;
  int asked_ = 1;  ///< RawWriter has sent one.
};

/// The program's node with all that its thread serves, and somebody else's ends of its topics. One
/// for all inputs, as in a run of days.
class Program {
 public:
  Program() {
    AddCallers();
    for (const char* const topic : {"/tf", "/tf_static"}) AddTopic<ros::TFMessage>(topic);
    AddTopic<ros::Image>("/mask");
    AddTopic<ros::CompressedImage>(kPacked);
    AddTopic<ros::PointStamped>("/clicked_point");
    AddTopic<ros::Image>("/depth");
    AddTopic<ros::CameraInfo>("/camera_info");
    OpenSensor();
    Turn();
  }

  void Take(std::uint8_t topic, const std::vector<std::uint8_t>& body) {
    const bool is_big_endian = (topic & 0x80U) != 0;
    const std::size_t place = (topic & 0x7fU) % (callers_.size() + topics_.size());
    if (place < callers_.size()) {
      callers_[place].Ask(is_big_endian, body);
    } else {
      topics_[place - callers_.size()].Write(is_big_endian, body);
    }
  }

  void Turn() {
    parameters_.Turn();
    lifecycle_.Turn();
    choices_.Turn();
    inputs_.Turn(clock_);
    for (Caller& caller : callers_) caller.CheckReplies();
    CheckSettings();
    apps::ObjectChoice choice;
    if (channel_.TakeChoice(choice)) fuzz::CheckStart(choice, kWidth_px, kHeight_px);
    CheckMask();
    CheckPoses();
    CheckImages();
    SendInfo();
  }

 private:
  void AddCallers() {
    const auto add = [this]<class Request, class Response>(const char* name) {
      callers_.push_back(
          Caller::Of<Request, Response>(participant_, std::string("/disflow/") + name));
    };
#define DISFLOW_ADD(Name, name) \
  add.template operator()<ros::Name##Request, ros::Name##Response>(name)
    DISFLOW_ADD(GetParameters, "get_parameters");
    DISFLOW_ADD(GetParameterTypes, "get_parameter_types");
    DISFLOW_ADD(DescribeParameters, "describe_parameters");
    DISFLOW_ADD(ListParameters, "list_parameters");
    DISFLOW_ADD(SetParameters, "set_parameters");
    DISFLOW_ADD(SetParametersAtomically, "set_parameters_atomically");
    DISFLOW_ADD(GetState, "get_state");
    DISFLOW_ADD(ChangeState, "change_state");
    DISFLOW_ADD(GetAvailableStates, "get_available_states");
    DISFLOW_ADD(GetAvailableTransitions, "get_available_transitions");
    DISFLOW_ADD(Choose, "object/choose");
#undef DISFLOW_ADD
  }

  template <class Message>
  void AddTopic(const char* name) {
    topics_.push_back(RawWriter::Of<Message>(participant_, posix::TopicName(name)));
  }

  /// The first image says how large all are.
  void OpenSensor() {
    (void)sensor_.Open();
    std::string encoding = "16UC1";
    std::vector<std::uint8_t> pixels(std::size_t{kWidth_px} * kHeight_px * 2, 3);
    ros::Image image{};
    image.header.stamp.sec = 1;
    image.width = kWidth_px;
    image.height = kHeight_px;
    image.step = kWidth_px * 2;
    image.encoding = encoding.data();
    posix::Lend(pixels, image.data);
    SendInfo();
    topics_[topics_.size() - 2].Send(image);
    Require(sensor_.Open().ok());
    Require(packed_.Subscribe(*node_, kPacked).ok());
  }
  void SendInfo() {
    ros::CameraInfo info{};
    info.width = kWidth_px;
    info.height = kHeight_px;
    info.k[0] = info.k[4] = 20.0;
    info.k[2] = 8.0;
    info.k[5] = 6.0;
    info.k[8] = 1.0;
    topics_.back().Send(info);
  }

  void CheckSettings() {
    const Config now = channel_.settings().Now();
    Require(Validate(now).field == nullptr);
    std::vector<double> fixed;
    VisitFields(start_, [&fixed](const auto& field) {
      if (!field.at_run_time) fixed.push_back(static_cast<double>(field.value));
    });
    std::size_t place = 0;
    VisitFields(now, [&](const auto& field) {
      if (!field.at_run_time) Require(static_cast<double>(field.value) == fixed[place++]);
    });
  }

  void CheckMask() {
    static const std::vector<std::uint16_t> depth(std::size_t{kWidth_px} * kHeight_px);
    DepthFrame frame;
    frame.depth = {depth.data(),         kWidth_px, kHeight_px, kWidth_px * 2,
                   DepthFormat::kUint16, 0.001F};
    Require((masks_.Attach(frame) == Status::kOk) == frame.mask.given());
    if (frame.mask.given()) Require(frame.mask.width_px == kWidth_px);
  }

  void CheckPoses() {
    hal::CameraPoseHistory history({});
    poses_.MoveTo(history, 0);
  }

  void CheckImages() {
    DepthFrame frame;
    for (int i = 0; i < kMostMessages; ++i) {
      const hal::Fault fault = sensor_.Next(0, frame);
      if (fault.status == Status::kTimeout) break;
      if (!fault.ok()) continue;
      fuzz::CheckDepth(frame.depth);
      Require(frame.camera.IsValid());
    }
    posix::RosDepthTopic::Image image;
    while (packed_.Take(image)) {
      if (image.fault.ok()) fuzz::CheckDepth(image.depth);
    }
  }

  const Config start_{};
  std::shared_ptr<posix::RosNode> node_ = OpenNode();
  dds_entity_t participant_ = node_->participant();
  apps::ObjectChannel channel_{"object", 0, [] { return nullptr; }};
  std::vector<apps::ObjectChannel*> channels_ = {&channel_};
  apps::DdsParameters parameters_{node_->full_name(), channels_, *node_};
  apps::DdsLifecycle lifecycle_{node_->full_name(), channels_, *node_};
  apps::DdsChoices choices_{Address(), "/disflow/object/", true, {kWidth_px, kHeight_px}, channel_,
                            *node_};
  apps::PoseMailbox poses_;
  apps::MaskMailbox masks_{"mask", kWidth_px, kHeight_px, std::int64_t{1} << 62U};
  apps::DdsInputs inputs_{Address(), *node_, &poses_, &masks_};
  apps::DdsClock clock_{apps::DdsClock::Stamps::kRos};
  posix::RosDepthSensor sensor_{node_, {"/depth", "/camera_info", false}};
  posix::RosDepthTopic packed_;
  std::vector<Caller> callers_;
  std::vector<RawWriter> topics_;
};

}  // namespace

/// Messages one after another: a byte that chooses the topic and the order of bytes, two for the
/// length, and the bytes behind the head of its representation.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static Program program;
  FuzzedNumbers input(data, size);
  for (int i = 0; i < kMostMessages && !input.empty(); ++i) {
    const auto topic = input.Take<std::uint8_t>();
    const auto length = input.Take<std::uint16_t>();
    program.Take(topic, input.TakeBytes(length));
  }
  program.Turn();
  return 0;
}
