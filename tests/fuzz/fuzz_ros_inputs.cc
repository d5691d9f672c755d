// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What other participants of a DDS domain send: transforms, masks, questions to the distance
/// field; as Cyclone DDS hands it on, which has taken the bytes apart.

#include <cmath>
#include <string>
#include <vector>

#include "chosen_object_check.h"
#include "dds/dds_choice.h"
#include "dds/dds_clock.h"
#include "dds/dds_inputs.h"
#include "dds/dds_query.h"
#include "file_in_memory.h"
#include "fuzzed_numbers.h"

namespace {

using namespace disflow;
using fuzz::FuzzedNumbers;
using fuzz::Require;
namespace ros = posix::ros;

constexpr int kWidth_px = 16;
constexpr int kHeight_px = 12;

/// Names of a tree that hang together more often than chance would have it.
std::string TakeFrame(FuzzedNumbers& input) {
  constexpr const char* kNames[] = {"map", "odom", "base", "camera", "", "/map", "/"};
  const std::size_t choice = input.Take<std::uint8_t>() % 8U;
  return choice < std::size(kNames) ? kNames[choice] : input.TakeText();
}

void CheckTransforms(FuzzedNumbers& input) {
  posix::RosTransforms transforms("map", "camera");
  while (!input.empty()) {
    std::string parent = TakeFrame(input);
    std::string child = TakeFrame(input);
    ros::TransformStamped message{};
    message.header.frame_id = parent.data();
    message.header.stamp = input.Take<ros::Time>();
    message.child_frame_id = child.data();
    message.transform.rotation.w = 1.0;
    const auto kind = input.Take<std::uint8_t>();
    if ((kind & 2U) != 0) message.transform = input.Take<decltype(message.transform)>();
    transforms.Add(apps::TransformOf(message), (kind & 1U) != 0);
    if (const auto camera = transforms.Camera()) {
      // What is too far for a number is refused by whoever keeps the poses.
      hal::CameraPoseHistory history({});
      const StampNs stamp_ns = camera->ros_ns;
      const Status status = history.Add(stamp_ns, camera->T_wc, 0, stamp_ns);
      if (status == Status::kOk) Require(camera->T_wc.IsFinite());
    }
  }
}

void CheckMask(FuzzedNumbers& input) {
  static const std::vector<std::uint16_t> depth(std::size_t{kWidth_px} * kHeight_px);
  apps::MaskMailbox masks("mask", kWidth_px, kHeight_px, 100'000'000);
  apps::DdsClock clock(apps::DdsClock::Stamps::kRos);
  std::string encoding = input.Take<std::uint8_t>() % 2 == 0 ? "mono8" : input.TakeText();
  ros::Image image{};
  image.encoding = encoding.data();
  image.header.stamp = input.Take<ros::Time>();
  image.width = input.Take<std::uint8_t>() % 2 == 0 ? kWidth_px : input.Take<std::uint32_t>();
  image.height = input.Take<std::uint8_t>() % 2 == 0 ? kHeight_px : input.Take<std::uint32_t>();
  image.step = input.Take<std::uint8_t>() % 2 == 0 ? kWidth_px : input.Take<std::uint32_t>();
  std::vector<std::uint8_t> pixels = input.rest();
  posix::Lend(pixels, image.data);
  PutMask(image, clock, masks);
  DepthFrame frame;
  frame.depth = {depth.data(), kWidth_px, kHeight_px, kWidth_px * 2, DepthFormat::kUint16, 0.001F};
  frame.stamp_ns = clock.FromRos(posix::RosNanoseconds(image.header.stamp));
  Require((masks.Attach(frame) == Status::kOk) == frame.mask.given());
  if (!frame.mask.given()) return;
  Require(frame.mask.width_px == kWidth_px && frame.mask.height_px == kHeight_px);
  for (int v = 0; v < kHeight_px; ++v) {
    const auto* const row = pixels.data() + static_cast<std::size_t>(v) * image.step;
    Require(std::equal(row, row + kWidth_px, frame.mask.row(v)));
  }
}

/// A model that knows something of a few points only, and says of each what it was asked.
class FewPoints final : public apps::ModelSnapshot {
 public:
  [[nodiscard]] const Config& config() const noexcept override { return config_; }
  [[nodiscard]] Expected<DistanceQuery> Query(const Vec3& x_m) noexcept override {
    ++asked_;
    DistanceQuery answer;
    answer.distance_m = x_m.x();
    return {answer, x_m.y() > 1.0F ? Status::kOutOfBounds : Status::kOk};
  }
  int StreamSamples(SampleSink& /*sink*/) const noexcept override { return 0; }
  [[nodiscard]] Expected<SurfaceCounts> ExtractSurface(float /*resolution_m*/,
                                                       TriangleSink& /*sink*/) noexcept override {
    return {};
  }
  [[nodiscard]] std::size_t asked() const { return asked_; }

 private:
  Config config_;
  std::size_t asked_ = 0;
};

void CheckQueries(FuzzedNumbers& input) {
  using Queries = apps::DdsQueries;
  const apps::DdsFrames frames{"camera", "object", ""};
  Queries queries;
  std::vector<ros::Point> points;
  for (int requests = 0; requests < 40 && !input.empty(); ++requests) {
    points.resize(input.Take<std::uint16_t>() % (2 * Queries::kMaxPoints));
    for (ros::Point& point : points) point = input.Take<ros::Point>();
    ros::QueryRequest request{};
    posix::Lend(points, request.points);
    queries.Take(request, frames);
  }
  queries.SnapshotAsked();
  FewPoints model;
  std::size_t turns = 0;
  for (; queries.AwaitsSnapshot(); ++turns) {
    const std::size_t before = model.asked();
    queries.Answer(model, 0, frames);
    // The points, and one question a request whether there is a model at all.
    Require(model.asked() - before <= Queries::kPointsPerTurn + Queries::kMaxRequests);
  }
  Require(turns <= Queries::kMaxRequests * (Queries::kMaxPoints / Queries::kPointsPerTurn + 1));
}

void CheckChoices(FuzzedNumbers& input) {
  apps::DdsAddress address;
  address.camera_frame = "camera";
  address.world_frame = "map";
  std::string name = TakeFrame(input);
  ros::PointStamped clicked{};
  clicked.header.frame_id = name.data();
  clicked.point = input.Take<ros::Point>();
  if (const auto choice = ChoiceOf(clicked, address))
    fuzz::CheckStart(*choice, kWidth_px, kHeight_px);
  ros::ChooseRequest request{};
  request.u = input.Take<std::uint8_t>();
  request.v = input.Take<std::uint8_t>();
  request.width = input.Take<std::uint32_t>();
  request.height = input.Take<std::uint32_t>();
  request.reach = input.Take<std::uint32_t>();
  std::string encoding = input.Take<std::uint8_t>() % 4 != 0 ? "mono8" : input.TakeText();
  request.mask.encoding = encoding.data();
  request.mask.width =
      input.Take<std::uint8_t>() % 4 != 0 ? kWidth_px : input.Take<std::uint32_t>();
  request.mask.height =
      input.Take<std::uint8_t>() % 4 != 0 ? kHeight_px : input.Take<std::uint32_t>();
  request.mask.step = input.Take<std::uint8_t>() % 4 != 0 ? kWidth_px : input.Take<std::uint32_t>();
  std::vector<std::uint8_t> pixels = input.rest();
  posix::Lend(pixels, request.mask.data);
  apps::ObjectChoice choice;
  if (ReadChoice(request, {kWidth_px, kHeight_px}, choice).empty())
    fuzz::CheckStart(choice, kWidth_px, kHeight_px);
}

}  // namespace

/// The first byte chooses what is sent.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  FuzzedNumbers input(data + 1, size - 1);
  switch (data[0] % 4) {
    case 0:
      CheckTransforms(input);
      break;
    case 1:
      CheckMask(input);
      break;
    case 2:
      CheckQueries(input);
      break;
    default:
      CheckChoices(input);
      break;
  }
  return 0;
}
