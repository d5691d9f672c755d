// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/hal/link_address.h"

#include <algorithm>
#include <charconv>
#include <cstring>
#include <system_error>
#include <utility>

namespace disflow::hal {
namespace {

constexpr std::uint32_t kMaxPort = 65535;
constexpr std::uint32_t kMaxBaud = 4'000'000;

/// printf's "%.*s" wants an int; longer texts would not fit into a Fault anyway.
struct Printable {
  int size;
  const char* text;
  explicit Printable(std::string_view view) noexcept
      : size(static_cast<int>(view.size() < 96 ? view.size() : 96)), text(view.data()) {}
};

[[nodiscard]] Fault BadUri(std::string_view uri, const char* what) noexcept {
  const Printable shown(uri);
  return MakeFault(Status::kInvalidUri, "link '%.*s': %s", shown.size, shown.text, what);
}

[[nodiscard]] bool ParseNumber(std::string_view text, std::uint32_t max,
                               std::uint32_t& value) noexcept {
  std::uint32_t parsed = 0;
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, parsed);
  if (error != std::errc{} || stop != end || parsed == 0 || parsed > max) return false;
  value = parsed;
  return true;
}

template <std::size_t kSize>
[[nodiscard]] bool CopyText(std::string_view text, char (&out)[kSize]) noexcept {
  // An embedded zero would silently cut the name for the operating system.
  if (text.empty() || text.size() >= kSize || text.find('\0') != std::string_view::npos) {
    return false;
  }
  std::memcpy(out, text.data(), text.size());
  out[text.size()] = '\0';
  return true;
}

/// std::string_view::substr() may throw, which nothing here may.
[[nodiscard]] std::string_view After(std::string_view text, std::size_t count) noexcept {
  text.remove_prefix(std::min(count, text.size()));
  return text;
}
[[nodiscard]] std::string_view Before(std::string_view text, std::size_t count) noexcept {
  return {text.data(), std::min(count, text.size())};
}

/// Splits "rest?query"; both parts may be empty.
void SplitQuery(std::string_view text, std::string_view& rest, std::string_view& query) noexcept {
  const std::size_t mark = text.find('?');
  rest = Before(text, mark);
  query = mark == std::string_view::npos ? std::string_view{} : After(text, mark + 1);
}

/// `name`=number; zero: not given yet.
[[nodiscard]] bool ParseOption(std::string_view option, std::string_view name, std::uint32_t max,
                               std::uint32_t& value) noexcept {
  return option.starts_with(name) && value == 0 &&
         ParseNumber(After(option, name.size()), max, value);
}

/// Takes `name`=one of the choices, once.
template <class Value, std::size_t kCount>
[[nodiscard]] bool ParseChoice(std::string_view option, std::string_view name,
                               const std::pair<std::string_view, Value> (&choices)[kCount],
                               Value& value) noexcept {
  if (!option.starts_with(name) || value != Value{}) return false;
  for (const auto& [text, choice] : choices) {
    if (After(option, name.size()) != text) continue;
    value = choice;
    return true;
  }
  return false;
}

/// An option that every kind of link has.
[[nodiscard]] bool ParseCommonOption(std::string_view option, LinkAddress& address) noexcept {
  using Stamps = LinkAddress::Stamps;
  using Pose = LinkAddress::Pose;
  constexpr std::string_view kKey = "key=";
  constexpr std::pair<std::string_view, Stamps> kStamps[] = {{"monotonic", Stamps::kMonotonic},
                                                             {"epoch", Stamps::kEpoch},
                                                             {"autopilot", Stamps::kAutopilot}};
  constexpr std::pair<std::string_view, Pose> kPoses[] = {{"landing_target", Pose::kLandingTarget},
                                                          {"follow_target", Pose::kFollowTarget}};
  constexpr std::pair<std::string_view, bool> kYes[] = {{"yes", true}};
  if (option.starts_with(kKey) && address.key_file[0] == '\0') {
    return CopyText(After(option, kKey.size()), address.key_file);
  }
  return ParseChoice(option, "choose=", kYes, address.may_choose) ||
         ParseChoice(option, "stamps=", kStamps, address.stamps) ||
         ParseChoice(option, "send=", kPoses, address.pose);
}

/// Options parted by '&'.
/// @param is_own Takes an option that only this kind of link has.
/// @return false for anything else, and for one that is given twice.
template <class IsOwn>
[[nodiscard]] bool ParseOptions(std::string_view query, LinkAddress& address,
                                IsOwn&& is_own) noexcept {
  while (!query.empty()) {
    const std::size_t end = query.find('&');
    const std::string_view option = Before(query, end);
    if (!is_own(option) && !ParseCommonOption(option, address)) return false;
    if (end == std::string_view::npos) return true;
    query = After(query, end + 1);
    if (query.empty()) return false;
  }
  return true;
}

/// @param own The options that only this kind of link has.
[[nodiscard]] Fault BadOptions(std::string_view uri, const char* own) noexcept {
  const Printable shown(uri);
  return MakeFault(Status::kInvalidUri,
                   "link '%.*s': options are %s, key=FILE, choose=yes, "
                   "stamps=monotonic|epoch|autopilot, send=landing_target|follow_target",
                   shown.size, shown.text, own);
}

/// Reads HOST:PORT.
/// @param query What follows it.
[[nodiscard]] Fault ParseEndpoint(std::string_view uri, std::string_view text, LinkAddress& address,
                                  std::string_view& query) noexcept {
  std::string_view endpoint;
  SplitQuery(text, endpoint, query);
  const std::size_t colon = endpoint.rfind(':');
  if (colon == std::string_view::npos) {
    return BadUri(uri, "the port is missing; write udp://HOST:PORT or tcp://HOST:PORT");
  }
  std::string_view host = Before(endpoint, colon);
  if (host.size() >= 2 && host.front() == '[' && host.back() == ']') {
    host = Before(After(host, 1), host.size() - 2);
  } else if (host.find(':') != std::string_view::npos) {
    return BadUri(uri, "an IPv6 address needs brackets; write [ADDRESS]:PORT");
  }
  if (!CopyText(host, address.host)) {
    return BadUri(uri, "the host is missing or too long; write udp://HOST:PORT or tcp://HOST:PORT");
  }
  std::uint32_t port = 0;
  if (!ParseNumber(After(endpoint, colon + 1), kMaxPort, port)) {
    return BadUri(uri, "the port is not a number from 1 to 65535");
  }
  address.port = static_cast<std::uint16_t>(port);
  return {};
}

[[nodiscard]] Fault ParseUdp(std::string_view uri, std::string_view text,
                             LinkAddress& address) noexcept {
  std::string_view query;
  const Fault fault = ParseEndpoint(uri, text, address, query);
  if (!fault.ok()) return fault;
  std::uint32_t bind_port = 0;
  const auto is_bind = [&](std::string_view option) {
    return ParseOption(option, "bind=", kMaxPort, bind_port);
  };
  if (!ParseOptions(query, address, is_bind)) {
    return BadOptions(uri, "bind=PORT (1 to 65535)");
  }
  address.bind_port = static_cast<std::uint16_t>(bind_port);
  return {};
}

[[nodiscard]] Fault ParseTcp(std::string_view uri, std::string_view text,
                             LinkAddress& address) noexcept {
  std::string_view query;
  const Fault fault = ParseEndpoint(uri, text, address, query);
  if (!fault.ok()) return fault;
  const auto is_listen = [&](std::string_view option) {
    if (option != "listen=yes" || address.listens) return false;
    return address.listens = true;
  };
  if (!ParseOptions(query, address, is_listen)) return BadOptions(uri, "listen=yes");
  return {};
}

[[nodiscard]] Fault ParseSerial(std::string_view uri, std::string_view text,
                                LinkAddress& address) noexcept {
  std::string_view device;
  std::string_view query;
  SplitQuery(text, device, query);
  if (!device.starts_with('/') || !CopyText(device, address.device)) {
    return BadUri(uri, "the device must be an absolute path; write serial:///dev/ttyUSB0");
  }
  std::uint32_t baud = 0;
  const auto is_baud = [&](std::string_view option) {
    return ParseOption(option, "baud=", kMaxBaud, baud);
  };
  if (!ParseOptions(query, address, is_baud)) {
    return BadOptions(uri, "baud=RATE (to 4000000)");
  }
  if (baud != 0) address.baud = baud;
  return {};
}

}  // namespace

Fault ParseLinkAddress(std::string_view uri, LinkAddress& address) noexcept {
  constexpr std::string_view kUdp = "udp://";
  constexpr std::string_view kTcp = "tcp://";
  constexpr std::string_view kSerial = "serial://";
  LinkAddress parsed;
  Fault fault;
  if (uri.starts_with(kUdp)) {
    parsed.kind = LinkAddress::Kind::kUdp;
    fault = ParseUdp(uri, After(uri, kUdp.size()), parsed);
  } else if (uri.starts_with(kTcp)) {
    parsed.kind = LinkAddress::Kind::kTcp;
    fault = ParseTcp(uri, After(uri, kTcp.size()), parsed);
  } else if (uri.starts_with(kSerial)) {
    parsed.kind = LinkAddress::Kind::kSerial;
    fault = ParseSerial(uri, After(uri, kSerial.size()), parsed);
  } else {
    fault = BadUri(uri,
                   "unknown kind; write udp://HOST:PORT, tcp://HOST:PORT or "
                   "serial:///dev/NAME?baud=RATE");
  }
  if (fault.ok()) address = parsed;
  return fault;
}

}  // namespace disflow::hal
