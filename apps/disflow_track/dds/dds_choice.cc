// SPDX-License-Identifier: BSD-3-Clause
#include "dds/dds_choice.h"

#include <algorithm>
#include <string_view>
#include <utility>

#include "program/exit_status.h"

namespace disflow::apps {
namespace {

namespace ros = posix::ros;
using posix::RosQos;

std::string Text(const ImageSize& image) {
  return std::to_string(image.width_px) + " x " + std::to_string(image.height_px);
}

std::string ReadMask(const ros::Image& mask, const ImageSize& image, ObjectChoice& choice) {
  const std::string_view encoding = posix::TextOf(mask.encoding);
  if (encoding != "mono8" && encoding != "8UC1") return "the mask's encoding must be mono8";
  const auto width = static_cast<std::uint32_t>(image.width_px);
  const auto height = static_cast<std::uint32_t>(image.height_px);
  if (mask.width != width || mask.height != height)
    return "the mask must be as large as the depth image, " + Text(image);
  const std::uint64_t needed = std::uint64_t{mask.step} * (height - 1) + width;
  if (mask.step < width || mask.data._length < needed) return "the mask has too few bytes";
  choice.kind = ObjectChoice::Kind::kMask;
  choice.mask_width_px = image.width_px;
  choice.mask_height_px = image.height_px;
  choice.mask.clear();
  for (std::size_t v = 0; v < height; ++v) {
    const std::uint8_t* const row = mask.data._buffer + v * mask.step;
    choice.mask.insert(choice.mask.end(), row, row + width);
  }
  const bool shows = std::any_of(choice.mask.begin(), choice.mask.end(),
                                 [](std::uint8_t pixel) { return pixel != 0; });
  return shows ? "" : "the mask is empty";
}

}  // namespace

std::optional<ObjectChoice> ChoiceOf(const ros::PointStamped& clicked, const DdsAddress& address) {
  std::string_view frame = posix::TextOf(clicked.header.frame_id);
  if (frame.starts_with('/')) frame.remove_prefix(1);
  const bool in_world = !address.world_frame.empty() && frame == address.world_frame;
  if (!in_world && frame != address.camera_frame) return std::nullopt;
  ObjectChoice choice;
  choice.kind = ObjectChoice::Kind::kPoint;
  choice.in_world = in_world;
  choice.point_m = Vec3(static_cast<float>(clicked.point.x), static_cast<float>(clicked.point.y),
                        static_cast<float>(clicked.point.z));
  return choice;
}

std::string ReadChoice(const ros::ChooseRequest& request, const ImageSize& image,
                       ObjectChoice& choice) {
  if (image.width_px <= 0 || image.height_px <= 0) return "there is no depth image yet";
  ObjectChoice read;
  if (request.mask.data._length > 0) {
    std::string refusal = ReadMask(request.mask, image, read);
    if (refusal.empty()) choice = std::move(read);
    return refusal;
  }
  if (request.u >= static_cast<std::uint32_t>(image.width_px) ||
      request.v >= static_cast<std::uint32_t>(image.height_px)) {
    return "the pixel does not lie in the image of " + Text(image);
  }
  const auto width = static_cast<float>(image.width_px);
  const auto height = static_cast<float>(image.height_px);
  const bool is_box = request.width > 0 && request.height > 0;
  read.kind = is_box ? ObjectChoice::Kind::kBox : ObjectChoice::Kind::kPixel;
  // The pixel's middle, so that no rounding makes it another one.
  read.u = (static_cast<float>(request.u) + 0.5F) / width;
  read.v = (static_cast<float>(request.v) + 0.5F) / height;
  read.width = std::min(1.0F, static_cast<float>(request.width) / width);
  read.height = std::min(1.0F, static_cast<float>(request.height) / height);
  read.reach = std::min(1.0F, static_cast<float>(request.reach) / width);
  choice = std::move(read);
  return "";
}

DdsChoices::DdsChoices(const DdsAddress& address, const std::string& prefix, bool is_first,
                       const ImageSize& image, ObjectChannel& channel, posix::RosNode& node)
    : address_(address), image_(image), channel_(channel) {
  Require(node.Subscribe(prefix + "clicked_point", RosQos::kReliable, own_points_));
  if (is_first)
    Require(node.Subscribe("/clicked_point", RosQos::kReliable, common_points_.emplace()));
  Require(node.Serve(prefix + "choose", service_));
}

void DdsChoices::Turn() {
  TakePoints(own_points_);
  if (common_points_) TakePoints(*common_points_);
  service_.requests.TakeAll([this](const ros::ChooseRequest& request) {
    ObjectChoice choice;
    const std::string refusal = ReadChoice(request, image_, choice);
    if (refusal.empty()) channel_.Choose(std::move(choice));
    service_.Reply({request.header, refusal.empty(), posix::Lend(refusal)});
  });
}

void DdsChoices::TakePoints(Points& points) {
  points.TakeAll([this](const ros::PointStamped& clicked) {
    if (std::optional<ObjectChoice> choice = ChoiceOf(clicked, address_))
      channel_.Choose(std::move(*choice));
  });
}

}  // namespace disflow::apps
