// SPDX-License-Identifier: BSD-3-Clause
#include "settings/dds_address.h"

#include <algorithm>
#include <array>
#include <charconv>

#include "program/exit_status.h"
#include "settings/refusal.h"

namespace disflow::apps {
namespace {

constexpr std::string_view kScheme = "dds:";
constexpr std::uint32_t kMaxDomain = 232;  // beyond, DDS runs out of ports
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

/// One `key=value` at a time.
class Reader {
 public:
  explicit Reader(const std::string& uri) : uri_(uri) {}

  [[nodiscard]] DdsAddress Read() {
    std::string_view rest = std::string_view(uri_).substr(kScheme.size());
    if (rest.empty()) Refuse("write dds:domain=0");
    while (!rest.empty()) {
      const std::string_view item = rest.substr(0, rest.find('&'));
      rest.remove_prefix(std::min(item.size() + 1, rest.size()));
      ReadItem(item);
    }
    return address_;
  }

 private:
  void ReadItem(std::string_view item) {
    const std::size_t equals = item.find('=');
    if (equals == std::string_view::npos) Refuse(Shown(item) + " is not OPTION=VALUE");
    const std::string_view key = item.substr(0, equals);
    for (std::size_t i = 0; i < kOptions.size(); ++i) {
      if (kOptions[i].key != key) continue;
      if (seen_[i]) Refuse(std::string(key) + " is given twice");
      seen_[i] = true;
      (this->*kOptions[i].read)(item.substr(equals + 1));
      return;
    }
    Refuse("unknown option " + Shown(key) +
           "; there are domain, name, interface, peer, camera, world, mask and ros");
  }

  void ReadDomain(std::string_view value) {
    const char* const end = value.data() + value.size();
    const auto [stop, error] = std::from_chars(value.data(), end, address_.domain);
    if (error != std::errc{} || stop != end || address_.domain > kMaxDomain) {
      Refuse("domain=" + Shown(value) + " is not a number from 0 to 232");
    }
  }
  void ReadName(std::string_view value) {
    if (!IsText(value, "_") || IsDigit(value.front())) {
      Refuse("name=" + Shown(value) +
             " is no ROS name: letters, digits and underscores, not a digit first");
    }
    address_.name = value;
  }
  void ReadInterface(std::string_view value) {
    if (!IsText(value, "._-:")) Refuse("interface=" + Shown(value) + " is no network interface");
    address_.interface = value;
  }
  void ReadPeers(std::string_view value) {
    for (bool more = true; more;) {
      const std::size_t comma = value.find(',');
      more = comma != std::string_view::npos;
      const std::string_view peer = value.substr(0, comma);
      if (!IsText(peer, "._-:[]")) Refuse("peer=" + Shown(peer) + " is no host");
      if (address_.peers.size() == kMaxPeers) Refuse("peer= names more than 16 hosts");
      address_.peers.emplace_back(peer);
      value.remove_prefix(more ? comma + 1 : value.size());
    }
  }
  void ReadCamera(std::string_view value) { ReadFrame("camera", value, address_.camera_frame); }
  void ReadWorld(std::string_view value) { ReadFrame("world", value, address_.world_frame); }
  void ReadMask(std::string_view value) {
    if (!IsText(value, "_/") || value.front() != '/' || value.back() == '/') {
      Refuse("mask=" + Shown(value) + " is no topic, e.g. /segmentation/mask");
    }
    address_.mask_topic = value;
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
    address_.before_iron = value == "humble";
  }

  /// What a terminal can show of text from outside.
  [[nodiscard]] static std::string Shown(std::string_view text) {
    std::string shown(text.substr(0, kMaxText));
    std::replace_if(
        shown.begin(), shown.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
    return shown;
  }

  [[noreturn]] void Refuse(const std::string& what) const {
    apps::Refuse(Shown(uri_) + ": ", what);
  }

  struct Option {
    std::string_view key;
    void (Reader::*read)(std::string_view value);
  };
  static constexpr std::array<Option, 8> kOptions = {{{"domain", &Reader::ReadDomain},
                                                      {"name", &Reader::ReadName},
                                                      {"interface", &Reader::ReadInterface},
                                                      {"peer", &Reader::ReadPeers},
                                                      {"camera", &Reader::ReadCamera},
                                                      {"world", &Reader::ReadWorld},
                                                      {"mask", &Reader::ReadMask},
                                                      {"ros", &Reader::ReadRos}}};

  const std::string& uri_;
  DdsAddress address_;
  std::array<bool, kOptions.size()> seen_{};
};

}  // namespace

bool IsDdsAddress(std::string_view uri) noexcept { return uri.starts_with(kScheme); }

DdsAddress ParseDdsAddress(const std::string& uri) { return Reader(uri).Read(); }

}  // namespace disflow::apps
