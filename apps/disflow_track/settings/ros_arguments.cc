// SPDX-License-Identifier: BSD-3-Clause
#include "settings/ros_arguments.h"

#include <algorithm>
#include <array>
#include <string_view>

#include "disflow/posix/shown_text.h"
#include "settings/refusal.h"

namespace disflow::apps {
namespace {

constexpr std::string_view kBegin = "--ros-args";
constexpr std::string_view kAssign = ":=";
/// Topics that come in, by the option that names them.
constexpr std::array<std::string_view, 2> kOfSensor = {"depth", "info"};
constexpr std::array<std::string_view, 1> kOfLink = {"mask"};

template <class List>
bool Holds(const List& list, std::string_view text) {
  return std::find(list.begin(), list.end(), text) != list.end();
}

/// Words of ROS's for which there is nothing here.
bool IsForeign(std::string_view word) {
  constexpr std::array<std::string_view, 4> kWords = {"--log-level", "--log-config-file",
                                                      "--enclave", "-e"};
  const bool is_switch = word.starts_with("--enable-") || word.starts_with("--disable-");
  return Holds(kWords, word) || is_switch;
}

class RosArgumentReader {
 public:
  explicit RosArgumentReader(std::vector<std::string>& arguments) : arguments_(arguments) {}

  [[nodiscard]] RosArguments Read() {
    std::vector<std::string> rest;
    bool of_ros = false;
    for (at_ = 0; at_ < arguments_.size(); ++at_) {
      const std::string& word = arguments_[at_];
      if (word == kBegin) {
        of_ros = true;
      } else if (of_ros && word == "--") {
        of_ros = false;
      } else if (!of_ros || !Take(word)) {
        rest.push_back(word);
      }
    }
    arguments_ = std::move(rest);
    return std::move(ros_);
  }

 private:
  /// @return Whether it is ROS's, and taken with what follows it.
  bool Take(const std::string& word) {
    if (word == "-r" || word == "--remap") {
      ReadRule(Next(word, "FROM:=TO"));
    } else if (word == "-p" || word == "--param") {
      const std::string text = Next(word, "NAME:=VALUE");
      (void)Split(text, word);
      ros_.parameters.push_back(text);
    } else if (IsForeign(word)) {
      Refuse(std::string(kBegin) + ": ",
             posix::ShownText(word) + " means nothing here; known are -r, -p and --params-file");
    } else {
      return false;
    }
    return true;
  }

  std::string Next(const std::string& word, const char* form) {
    if (++at_ < arguments_.size()) return arguments_[at_];
    Refuse(std::string(kBegin) + " " + word + ": ", std::string(form) + " is missing");
  }

  struct Rule {
    std::string_view from;
    std::string_view to;
  };

  /// @param text Outlives what comes back.
  static Rule Split(const std::string& text, const std::string& word) {
    const std::string_view rule = text;
    const std::size_t assign = rule.find(kAssign);
    const std::string where =
        std::string(kBegin) + " " + word + " " + posix::ShownText(text) + ": ";
    if (assign == std::string_view::npos || assign == 0 || assign + kAssign.size() == rule.size())
      Refuse(where, "is not NAME:=VALUE");
    if (rule.substr(0, assign).find(':') != std::string_view::npos)
      Refuse(where, "this is one node, so leave out what stands before the first colon");
    return {rule.substr(0, assign), rule.substr(assign + kAssign.size())};
  }

  void ReadRule(const std::string& text) {
    const Rule rule = Split(text, "-r");
    // An address joins its options by it.
    if (rule.to.find('&') != std::string_view::npos) RefuseRule(text, "a name has no &");
    if (rule.from == "__node" || rule.from == "__name") {
      ros_.name = rule.to;
    } else if (rule.from == "__ns") {
      ros_.node_namespace = rule.to.starts_with('/') ? "" : "/";
      ros_.node_namespace += rule.to;
    } else if (Holds(kOfSensor, rule.from) || Holds(kOfLink, rule.from)) {
      ros_.topics.push_back({std::string(rule.from), std::string(rule.to)});
    } else {
      RefuseRule(text,
                 "there is nothing of that name to be called otherwise; known are depth, info, "
                 "mask, __node and __ns");
    }
  }

  [[noreturn]] static void RefuseRule(const std::string& text, const char* why) {
    Refuse(std::string(kBegin) + " -r " + posix::ShownText(text) + ": ", why);
  }

  std::vector<std::string>& arguments_;
  std::size_t at_ = 0;
  RosArguments ros_;
};

/// Sets one option of an address.
void Put(std::string_view key, const std::string& value, std::string& uri) {
  const std::size_t begin = uri.find(':') + 1;
  std::string_view rest = std::string_view(uri).substr(begin);
  std::string put = uri.substr(0, begin) + std::string(key) + "=" + value;
  while (!rest.empty()) {
    const std::string_view item = rest.substr(0, rest.find('&'));
    rest.remove_prefix(std::min(item.size() + 1, rest.size()));
    if (item.substr(0, item.find('=')) != key) put.append("&").append(item);
  }
  uri = std::move(put);
}

/// A name as ROS makes it whole: relative ones are the namespace's, ~ is the node.
std::string Whole(const std::string& topic, const DdsNodeAddress& node) {
  if (topic.starts_with('/')) return topic;
  if (topic.starts_with("~/")) return node.FullName() + topic.substr(1);
  return node.node_namespace + "/" + topic;
}

void PutNode(const RosArguments& ros, std::string& uri) {
  if (!IsDdsAddress(uri)) return;
  if (!ros.name.empty()) Put("name", ros.name, uri);
  if (!ros.node_namespace.empty()) Put("namespace", ros.node_namespace, uri);
}

template <class Keys>
void PutTopics(const RosArguments& ros, const Keys& keys, const DdsNodeAddress& node,
               std::string& uri) {
  if (!IsDdsAddress(uri)) return;
  for (const RosArguments::Topic& topic : ros.topics)
    if (Holds(keys, topic.option)) Put(topic.option, Whole(topic.topic, node), uri);
}

}  // namespace

RosArguments TakeRosArguments(std::vector<std::string>& arguments) {
  return RosArgumentReader(arguments).Read();
}

DdsNodeAddress NodeOf(const RosArguments& ros, const Options& options) {
  std::string link = options.dds_link;
  for (const std::string& uri : options.links)
    if (IsDdsAddress(uri)) link = uri;
  if (IsDdsAddress(options.sensor)) {
    // A relative topic, for which the node is wanted, is none yet.
    std::string uri = options.sensor;
    Put("depth", "/any", uri);
    const DdsSensorAddress sensor = ParseDdsSensorAddress(uri);
    if (link.empty() || ParseDdsAddress(link).domain == sensor.domain)
      return SensorNode(sensor, link);
  }
  if (!link.empty()) return ParseDdsAddress(link);
  std::string nobody = "dds:domain=0";
  PutNode(ros, nobody);
  return ParseDdsAddress(nobody);
}

void PutIntoAddresses(const RosArguments& ros, Options& options) {
  PutNode(ros, options.sensor);
  for (std::string& link : options.links) PutNode(ros, link);
  if (ros.topics.empty()) return;
  const DdsNodeAddress node = NodeOf(ros, options);
  PutTopics(ros, kOfSensor, node, options.sensor);
  for (std::string& link : options.links) PutTopics(ros, kOfLink, node, link);
}

void CheckTopicsAreUsed(const RosArguments& ros, const Options& options) {
  for (const RosArguments::Topic& topic : ros.topics) {
    const bool of_sensor = Holds(kOfSensor, topic.option);
    if (of_sensor ? IsDdsAddress(options.sensor) : !options.dds_link.empty()) continue;
    Refuse(
        std::string(kBegin) + " -r " + topic.option + ":=" + posix::ShownText(topic.topic) + ": ",
        of_sensor ? "needs a sensor of ROS 2: --sensor dds:domain=0"
                  : "needs a link to ROS 2: --link dds:domain=0");
  }
}

}  // namespace disflow::apps
