// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/posix/view/web_address.h"

#include <arpa/inet.h>
#include <netinet/in.h>

#include <charconv>
#include <cstring>

namespace disflow::posix {
namespace {

constexpr int kLargestPort = 65535;

hal::Fault WrongAddress(std::string_view text) {
  return hal::MakeFault(Status::kInvalidUri,
                        "%.*s: is no address to listen on; write :PORT, ADDRESS:PORT or "
                        "[IPV6-ADDRESS]:PORT, e.g. :8080 or 0.0.0.0:8080; ?token=none "
                        "may follow an address of this machine only",
                        static_cast<int>(text.size()), text.data());
}

bool ParsePort(std::string_view text, int& port) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), port);
  return !text.empty() && error == std::errc() && end == text.data() + text.size() && port >= 0 &&
         port <= kLargestPort;
}

bool ParseHost(std::string_view text, WebAddress& address) {
  if (text.empty() || text == "localhost") return true;
  const bool in_brackets = text.size() > 2 && text.front() == '[' && text.back() == ']';
  address.is_ipv6 = in_brackets;
  address.host = in_brackets ? text.substr(1, text.size() - 2) : text;
  if (in_brackets) {
    in6_addr bytes{};
    if (inet_pton(AF_INET6, address.host.c_str(), &bytes) != 1) return false;
    address.is_loopback = std::memcmp(&bytes, &in6addr_loopback, sizeof(bytes)) == 0;
    return true;
  }
  in_addr bytes{};
  if (inet_pton(AF_INET, address.host.c_str(), &bytes) != 1) return false;
  constexpr std::uint32_t kLoopbackNet = 127;
  address.is_loopback = (ntohl(bytes.s_addr) >> 24U) == kLoopbackNet;
  return true;
}

}  // namespace

std::string WebAddress::Url(int listened_port) const {
  const bool is_any = host == "0.0.0.0" || host == "::";
  const std::string name = is_any ? "localhost" : is_ipv6 ? "[" + host + "]" : host;
  return "http://" + name + ":" + std::to_string(listened_port) + "/";
}

hal::Fault ParseWebAddress(std::string_view text, WebAddress& address) {
  address = {};
  constexpr std::string_view kWithoutToken = "?token=none";
  address.without_token = text.ends_with(kWithoutToken);
  const std::string_view where =
      address.without_token ? text.substr(0, text.size() - kWithoutToken.size()) : text;
  const std::size_t colon = where.rfind(':');
  const bool has_host = colon != std::string_view::npos;
  const std::string_view port = has_host ? where.substr(colon + 1) : where;
  const bool valid = ParsePort(port, address.port) &&
                     ParseHost(has_host ? where.substr(0, colon) : std::string_view(), address) &&
                     (address.is_loopback || !address.without_token);
  return valid ? hal::Fault{} : WrongAddress(text);
}

}  // namespace disflow::posix
