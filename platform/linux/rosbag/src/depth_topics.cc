// SPDX-License-Identifier: BSD-3-Clause
#include "depth_topics.h"

#include <optional>
#include <string>
#include <utility>

#include "topic_stream.h"

namespace disflow::posix {
namespace {

namespace fs = std::filesystem;

using hal::Fault;
using hal::MakeFault;

/// What is damaged is passed over: whoever reads the frames says it.
bool NextWhole(TopicStream& stream, BagMessage& message) {
  Fault fault;
  do fault = stream.Next(message);
  while (fault.status == Status::kCorrupt || fault.status == Status::kTruncated);
  return fault.ok();
}

Fault ListTopics(const std::vector<fs::path>& files, TopicNames& names) {
  TopicStream stream;
  for (const fs::path& file : files) {
    Fault fault = stream.Open({file}, "");
    if (!fault.ok()) return fault;
    BagMessage message;
    while (NextWhole(stream, message)) {
    }
    names.Add(stream.names());
  }
  return {};
}

void AppendTo(std::string& list, const std::string& topic) {
  list.append(" ").append(ShownText(topic));
}

/// By the first message that is whole. @return Nothing if there is none.
std::optional<bool> IsDepth(const std::vector<fs::path>& files, const std::string& topic,
                            const BagOptions& options) {
  TopicStream stream;
  if (!stream.Open(files, topic).ok()) return std::nullopt;
  BagMessage message;
  while (NextWhole(stream, message)) {
    StampNs stamp_ns = 0;
    RosImage image;
    CompressedImage packed;
    if (IsSensorType(message.type, "CompressedImage")) {
      if (ReadCompressedImage(message, stamp_ns, packed).status == Status::kTruncated) continue;
      return packed.format.find("compressedDepth") != std::string_view::npos;
    }
    if (ReadImage(message, stamp_ns, image).status == Status::kTruncated) continue;
    // Infrared images are of mono16 as well.
    return image.encoding == "16UC1" || image.encoding == "32FC1" ||
           (image.encoding == "mono16" && options.unit_m);
  }
  return std::nullopt;
}

}  // namespace

Fault FindDepthTopic(const std::vector<fs::path>& files, BagOptions& options) {
  TopicNames names;
  if (const Fault fault = ListTopics(files, names); !fault.ok()) return fault;
  const auto has_info = [&names](const std::string& topic) {
    const auto info = names.camera_types().find(topic);
    return info != names.camera_types().end() && IsSensorType(info->second, "CameraInfo");
  };
  // Each is looked for through all of the recording, which may be made to have many.
  constexpr int kMostSilent = 8;
  int silent = 0;
  std::optional<BagOptions> usable;
  std::string choice;
  std::string without_info;
  std::string infos;
  int choices = 0;
  for (const auto& [topic, type] : names.camera_types()) {
    if (IsSensorType(type, "CameraInfo")) {
      AppendTo(infos, topic);
      continue;
    }
    const std::optional<bool> is_depth =
        silent < kMostSilent ? IsDepth(files, topic, options) : std::nullopt;
    if (!is_depth) ++silent;
    if (!is_depth.value_or(false)) continue;
    BagOptions found = options;
    found.depth_topic = topic;
    SetTopicDefaults(found);
    if (has_info(found.info_topic)) {
      ++choices;
      AppendTo(choice, topic);
      usable = std::move(found);
    } else {
      AppendTo(without_info, topic);
    }
  }
  const char* const path = options.path.c_str();
  if (choices > 1) {
    return MakeFault(Status::kInvalidUri,
                     "%s: has depth images on several topics; choose one, ?depth=TOPIC:%s", path,
                     choice.c_str());
  }
  if (usable) {
    options = std::move(*usable);
    return {};
  }
  if (!without_info.empty()) {
    return MakeFault(Status::kNotFound,
                     "%s: no CameraInfo beside the depth images of%s; say ?info=TOPIC, of%s", path,
                     without_info.c_str(), infos.empty() ? " which there is none" : infos.c_str());
  }
  const std::string topics = names.List();
  return MakeFault(Status::kNotFound,
                   "%s: has no depth images (16UC1, 32FC1, compressedDepth); it has%s", path,
                   topics.empty() ? " no topics at all" : topics.c_str());
}

}  // namespace disflow::posix
