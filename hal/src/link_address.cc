// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/hal/link_address.h"

#include <algorithm>
#include <charconv>
#include <cstring>
#include <system_error>

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

/// Options parted by '&': a number by the name that this kind of link has for it, key=FILE and
/// choose=yes.
/// @return false for anything else, and for one that is given twice.
[[nodiscard]] bool ParseOptions(std::string_view query, std::string_view name, std::uint32_t max,
                                std::uint32_t& value, LinkAddress& address) noexcept {
  constexpr std::string_view kKey = "key=";
  while (!query.empty()) {
    const std::size_t end = query.find('&');
    const std::string_view option = Before(query, end);
    const bool is_choice = option == "choose=yes" && !address.may_choose;
    address.may_choose = address.may_choose || is_choice;
    const bool is_key = option.starts_with(kKey) && address.key_file[0] == '\0' &&
                        CopyText(After(option, kKey.size()), address.key_file);
    if (!is_key && !is_choice && !ParseOption(option, name, max, value)) return false;
    if (end == std::string_view::npos) return true;
    query = After(query, end + 1);
    if (query.empty()) return false;
  }
  return true;
}

[[nodiscard]] Fault ParseUdp(std::string_view uri, std::string_view text,
                             LinkAddress& address) noexcept {
  std::string_view endpoint;
  std::string_view query;
  SplitQuery(text, endpoint, query);
  const std::size_t colon = endpoint.rfind(':');
  if (colon == std::string_view::npos) {
    return BadUri(uri, "the port is missing; write udp://HOST:PORT");
  }
  std::string_view host = Before(endpoint, colon);
  if (host.size() >= 2 && host.front() == '[' && host.back() == ']') {
    host = Before(After(host, 1), host.size() - 2);
  } else if (host.find(':') != std::string_view::npos) {
    return BadUri(uri, "an IPv6 address needs brackets; write udp://[ADDRESS]:PORT");
  }
  if (!CopyText(host, address.host)) {
    return BadUri(uri, "the host is missing or too long; write udp://HOST:PORT");
  }
  std::uint32_t port = 0;
  if (!ParseNumber(After(endpoint, colon + 1), kMaxPort, port)) {
    return BadUri(uri, "the port is not a number from 1 to 65535");
  }
  address.port = static_cast<std::uint16_t>(port);
  std::uint32_t bind_port = 0;
  if (!ParseOptions(query, "bind=", kMaxPort, bind_port, address)) {
    return BadUri(uri,
                  "options are ?bind=PORT, a number from 1 to 65535, &key=FILE and &choose=yes");
  }
  address.bind_port = static_cast<std::uint16_t>(bind_port);
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
  if (!ParseOptions(query, "baud=", kMaxBaud, baud, address)) {
    return BadUri(uri,
                  "options are ?baud=RATE, a number from 1 to 4000000, &key=FILE and &choose=yes");
  }
  if (baud != 0) address.baud = baud;
  return {};
}

}  // namespace

Fault ParseLinkAddress(std::string_view uri, LinkAddress& address) noexcept {
  constexpr std::string_view kUdp = "udp://";
  constexpr std::string_view kSerial = "serial://";
  LinkAddress parsed;
  Fault fault;
  if (uri.starts_with(kUdp)) {
    parsed.kind = LinkAddress::Kind::kUdp;
    fault = ParseUdp(uri, After(uri, kUdp.size()), parsed);
  } else if (uri.starts_with(kSerial)) {
    parsed.kind = LinkAddress::Kind::kSerial;
    fault = ParseSerial(uri, After(uri, kSerial.size()), parsed);
  } else {
    fault = BadUri(uri, "unknown kind; write udp://HOST:PORT or serial:///dev/NAME?baud=RATE");
  }
  if (fault.ok()) address = parsed;
  return fault;
}

}  // namespace disflow::hal
