// SPDX-License-Identifier: BSD-3-Clause
#include "request.h"

#include <cstddef>

namespace disflow::posix {
namespace {

/// Without the port.
std::string_view NameOf(std::string_view host) {
  if (host.starts_with('[')) return host.substr(0, host.find(']') + 1);
  return host.substr(0, host.rfind(':'));
}

bool IsDigitsAndDots(std::string_view text) {
  return text.find_first_not_of("0123456789.") == std::string_view::npos;
}

/// A foreign page whose name was made to point here gets nothing: its browser sends that name.
bool NamesLoopback(std::string_view host) {
  const std::string_view name = NameOf(host);
  return name == "localhost" || name == "[::1]" ||
         (name.starts_with("127.") && IsDigitsAndDots(name));
}

/// A page of another site may open a WebSocket here; its browser then says where it is from.
bool IsSameOrigin(const std::optional<std::string>& origin, std::string_view host) {
  if (!origin) return true;  // not sent by a browser
  const std::size_t scheme = origin->find("://");
  return scheme != std::string::npos && std::string_view(*origin).substr(scheme + 3) == host;
}

}  // namespace

bool SameToken(std::string_view given, std::string_view wanted) noexcept {
  if (wanted.empty()) return false;
  std::size_t difference = given.size() ^ wanted.size();
  for (std::size_t i = 0; i < given.size(); ++i) {
    const auto a = static_cast<unsigned char>(given[i]);
    const auto b = static_cast<unsigned char>(wanted[i % wanted.size()]);
    difference |= static_cast<std::size_t>(a ^ b);
  }
  return difference == 0;
}

Verdict Judge(const Request& request, const AccessRules& rules) {
  if (!request.is_get) return Verdict::kWrongMethod;
  if (request.has_body) return Verdict::kTooLarge;
  if (!request.is_whole || request.host.empty()) return Verdict::kBadRequest;
  if (rules.is_loopback && !NamesLoopback(request.host)) return Verdict::kForbidden;
  if (!IsSameOrigin(request.origin, request.host)) return Verdict::kForbidden;
  if (rules.token.empty() || SameToken(request.cookie_token, rules.token) ||
      SameToken(request.bearer_token, rules.token)) {
    return Verdict::kAllowed;
  }
  return SameToken(request.query_token, rules.token) ? Verdict::kRememberToken : Verdict::kNoToken;
}

}  // namespace disflow::posix
