// SPDX-License-Identifier: BSD-3-Clause
#include "settings/dds_address.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdlib>

#include "disflow/posix/shown_text.h"
#include "program/exit_status.h"
#include "settings/refusal.h"

namespace disflow::apps {
namespace {

constexpr std::string_view kScheme = "dds:";
constexpr std::uint32_t kMaxDomain = 232;  // beyond, DDS runs out of ports
constexpr std::uint32_t kMaxWait_s = 86'400;
constexpr std::size_t kMaxText = 128;
constexpr std::size_t kMaxPeers = 16;

bool IsLetter(char c) noexcept { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }
bool IsDigit(char c) noexcept { return c >= '0' && c <= '9'; }

/// Not empty, not too long, letters, digits and the characters of `more`: none that mean something
/// to a shell, to XML or to a terminal.
bool IsText(std::string_view text, std::string_view more) noexcept {
  return !text.empty() && text.size() <= kMaxText &&
         std::all_of(text.begin(), text.end(), [more](char c) {
           return IsLetter(c) || IsDigit(c) || more.find(c) != std::string_view::npos;
         });
}

/// Who says it.
enum class Side : std::uint8_t { kBoth, kLink, kSensor };

/// One `key=value` at a time.
class Reader {
 public:
  Reader(const std::string& uri, Side side) : uri_(uri), side_(side) {}

  [[nodiscard]] DdsAddress ReadLink() {
    ReadItems();
    static_cast<DdsNodeAddress&>(link_) = node_;
    return link_;
  }
  [[nodiscard]] DdsSensorAddress ReadSensor() {
    ReadItems();
    if (sensor_.depth_topic.empty()) {
      Refuse("depth= is missing; write dds:domain=0&depth=/camera/depth/image_rect_raw");
    }
    static_cast<DdsNodeAddress&>(sensor_) = node_;
    return sensor_;
  }

 private:
  void ReadItems() {
    std::string_view rest = std::string_view(uri_).substr(kScheme.size());
    while (!rest.empty()) {
      const std::string_view item = rest.substr(0, rest.find('&'));
      rest.remove_prefix(std::min(item.size() + 1, rest.size()));
      ReadItem(item);
    }
    if (!says_domain_) ReadDomainOfRos();
  }

  void ReadItem(std::string_view item) {
    const std::size_t equals = item.find('=');
    if (equals == std::string_view::npos) Refuse(Shown(item) + " is not OPTION=VALUE");
    const std::string_view key = item.substr(0, equals);
    for (std::size_t i = 0; i < kOptions.size(); ++i) {
      if (kOptions[i].key != key || !IsOf(kOptions[i].side)) continue;
      if (seen_[i]) Refuse(std::string(key) + " is given twice");
      seen_[i] = true;
      (this->*kOptions[i].read)(item.substr(equals + 1));
      return;
    }
    std::string known;
    for (const Option& option : kOptions) {
      if (!IsOf(option.side)) continue;
      known.append(known.empty() ? "" : ", ").append(option.key);
    }
    Refuse("unknown option " + Shown(key) + "; there are " + known);
  }
  [[nodiscard]] bool IsOf(Side side) const noexcept { return side == Side::kBoth || side == side_; }

  void ReadDomain(std::string_view value) {
    ReadNumber("domain", value, kMaxDomain, node_.domain);
    says_domain_ = true;
  }
  /// As all of ROS on this machine, where the address does not say.
  void ReadDomainOfRos() {
    constexpr const char* kVariable = "ROS_DOMAIN_ID";
    const char* const value = std::getenv(kVariable);
    if (value == nullptr || *value == '\0') return;
    ReadNumber(kVariable, value, kMaxDomain, node_.domain);
  }
  void ReadWait(std::string_view value) { ReadNumber("wait", value, kMaxWait_s, sensor_.wait_s); }
  void ReadNumber(const char* key, std::string_view value, std::uint32_t max,
                  std::uint32_t& number) {
    const char* const end = value.data() + value.size();
    const auto [stop, error] = std::from_chars(value.data(), end, number);
    if (error != std::errc{} || stop != end || number > max) {
      Refuse(std::string(key) + "=" + Shown(value) + " is not a number from 0 to " +
             std::to_string(max));
    }
  }
  void ReadName(std::string_view value) {
    if (!IsText(value, "_") || IsDigit(value.front())) {
      Refuse("name=" + Shown(value) +
             " is no ROS name: letters, digits and underscores, not a digit first");
    }
    node_.name = value;
  }
  void ReadNamespace(std::string_view value) {
    if (value == "/") return;
    ReadPath("namespace", value, "namespace", "/robot1", node_.node_namespace);
  }
  void ReadInterface(std::string_view value) {
    if (!IsText(value, "._-:")) Refuse("interface=" + Shown(value) + " is no network interface");
    node_.interface = value;
  }
  void ReadPeers(std::string_view value) {
    for (bool more = true; more;) {
      const std::size_t comma = value.find(',');
      more = comma != std::string_view::npos;
      const std::string_view peer = value.substr(0, comma);
      if (!IsText(peer, "._-:[]")) Refuse("peer=" + Shown(peer) + " is no host");
      if (node_.peers.size() == kMaxPeers) Refuse("peer= names more than 16 hosts");
      node_.peers.emplace_back(peer);
      value.remove_prefix(more ? comma + 1 : value.size());
    }
  }
  void ReadCamera(std::string_view value) { ReadFrame("camera", value, link_.camera_frame); }
  void ReadWorld(std::string_view value) { ReadFrame("world", value, link_.world_frame); }
  void ReadMask(std::string_view value) {
    ReadTopic("mask", value, "/segmentation/mask", link_.mask_topic);
  }
  void ReadDepth(std::string_view value) {
    ReadTopic("depth", value, "/camera/depth/image_rect_raw", sensor_.depth_topic);
  }
  void ReadInfo(std::string_view value) {
    ReadTopic("info", value, "/camera/depth/camera_info", sensor_.info_topic);
  }
  void ReadTopic(const char* key, std::string_view value, const char* example, std::string& topic) {
    ReadPath(key, value, "topic", example, topic);
  }
  void ReadPath(const char* key, std::string_view value, const char* what, const char* example,
                std::string& path) {
    if (!IsText(value, "_/") || value.front() != '/' || value.back() == '/') {
      Refuse(std::string(key) + "=" + Shown(value) + " is no " + what + ", e.g. " + example);
    }
    path = value;
  }
  void ReadRectified(std::string_view value) { sensor_.rectified = IsYes("rectified", value); }
  void ReadChoose(std::string_view value) { link_.may_choose = IsYes("choose", value); }
  void ReadParameters(std::string_view value) { link_.may_set = IsYes("parameters", value); }
  void ReadLifecycle(std::string_view value) { link_.may_pause = IsYes("lifecycle", value); }
  void ReadReset(std::string_view value) { link_.may_reset = IsYes("reset", value); }
  [[nodiscard]] bool IsYes(const char* key, std::string_view value) const {
    if (value != "yes" && value != "no") {
      Refuse(std::string(key) + "=" + Shown(value) + " is neither yes nor no");
    }
    return value == "yes";
  }
  void ReadFrame(const char* key, std::string_view value, std::string& frame) {
    if (!IsText(value, "_-/.") || value.front() == '/') {
      Refuse(std::string(key) + "=" + Shown(value) + " is no tf frame, e.g. camera_optical_frame");
    }
    frame = value;
  }
  void ReadRos(std::string_view value) {
    if (value != "humble" && value != "iron") {
      Refuse("ros=" + Shown(value) + " is neither humble (and older) nor iron (and newer)");
    }
    node_.before_iron = value == "humble";
  }

  [[nodiscard]] static std::string Shown(std::string_view text) {
    return posix::ShownText(text, kMaxText);
  }

  [[noreturn]] void Refuse(const std::string& what) const {
    apps::Refuse(Shown(uri_) + ": ", what);
  }

  struct Option {
    std::string_view key;
    Side side;
    void (Reader::*read)(std::string_view value);
  };
  static constexpr std::array<Option, 17> kOptions = {{
      {"domain", Side::kBoth, &Reader::ReadDomain},
      {"name", Side::kBoth, &Reader::ReadName},
      {"namespace", Side::kBoth, &Reader::ReadNamespace},
      {"interface", Side::kBoth, &Reader::ReadInterface},
      {"peer", Side::kBoth, &Reader::ReadPeers},
      {"ros", Side::kBoth, &Reader::ReadRos},
      {"camera", Side::kLink, &Reader::ReadCamera},
      {"world", Side::kLink, &Reader::ReadWorld},
      {"mask", Side::kLink, &Reader::ReadMask},
      {"choose", Side::kLink, &Reader::ReadChoose},
      {"reset", Side::kLink, &Reader::ReadReset},
      {"parameters", Side::kLink, &Reader::ReadParameters},
      {"lifecycle", Side::kLink, &Reader::ReadLifecycle},
      {"depth", Side::kSensor, &Reader::ReadDepth},
      {"info", Side::kSensor, &Reader::ReadInfo},
      {"rectified", Side::kSensor, &Reader::ReadRectified},
      {"wait", Side::kSensor, &Reader::ReadWait},
  }};

  const std::string& uri_;
  Side side_;
  DdsNodeAddress node_;
  DdsAddress link_;
  DdsSensorAddress sensor_;
  std::array<bool, kOptions.size()> seen_{};
  bool says_domain_ = false;
};

}  // namespace

const char* const kDdsSensorHelp =
    "  dds:domain=N&depth=TOPIC\n"
    "               depth images of ROS 2 (docs/ros2.md): sensor_msgs/Image, or CompressedImage if "
    "TOPIC ends in\n"
    "               /compressedDepth. Options: info=TOPIC (CameraInfo; camera_info beside the "
    "images), rectified=yes|no\n"
    "               (by the topic's name), wait=30 (seconds for the first image), and name, "
    "namespace, interface,\n"
    "               peer, ros as of a link\n";

bool IsDdsAddress(std::string_view uri) noexcept { return uri.starts_with(kScheme); }

DdsAddress ParseDdsAddress(const std::string& uri) { return Reader(uri, Side::kLink).ReadLink(); }

DdsSensorAddress ParseDdsSensorAddress(const std::string& uri) {
  return Reader(uri, Side::kSensor).ReadSensor();
}

DdsNodeAddress SensorNode(const DdsSensorAddress& sensor, const std::string& link_uri) {
  const DdsAddress link = link_uri.empty() ? DdsAddress{} : ParseDdsAddress(link_uri);
  if (link_uri.empty() || link.domain != sensor.domain) return sensor;
  DdsNodeAddress node = link;
  const DdsNodeAddress nothing;
  const auto unite = [&](const char* key, auto DdsNodeAddress::*value) {
    if (sensor.*value == nothing.*value) return;
    if (link.*value != nothing.*value && link.*value != sensor.*value) {
      Refuse("--sensor dds: and --link dds: are one node in a domain: ",
             std::string(key) + "= of both must be the same");
    }
    node.*value = sensor.*value;
  };
  unite("name", &DdsNodeAddress::name);
  unite("namespace", &DdsNodeAddress::node_namespace);
  unite("interface", &DdsNodeAddress::interface);
  unite("peer", &DdsNodeAddress::peers);
  unite("ros", &DdsNodeAddress::before_iron);
  return node;
}

}  // namespace disflow::apps
