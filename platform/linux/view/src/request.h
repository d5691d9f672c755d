// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace disflow::posix {

/// What is looked at of an HTTP request; empty: was not given.
struct Request {
  bool is_get = false;
  bool has_body = false;
  bool is_whole = true;  ///< false: of a header there is a part only.
  std::string host;
  std::optional<std::string> origin;  ///< Programs that are no browsers give none.
  std::string cookie_token;
  std::string query_token;
  std::string bearer_token;  ///< Of programs.
};

/// Who may have what.
struct AccessRules {
  std::string token;  ///< Empty: everybody may.
  bool is_loopback = true;
};

/// As in HTTP.
enum class Verdict : int {
  kAllowed = 200,
  kRememberToken = 303,  ///< The address has the right token: it goes into a cookie.
  kBadRequest = 400,
  kNoToken = 401,
  kForbidden = 403,
  kNotFound = 404,
  kWrongMethod = 405,
  kTooLarge = 413,
  kBusy = 503,
};

/// Judges a request before it is known what it asks for.
[[nodiscard]] Verdict Judge(const Request& request, const AccessRules& rules);

/// Compares in a time that depends on the length of `given` alone.
[[nodiscard]] bool SameToken(std::string_view given, std::string_view wanted) noexcept;

}  // namespace disflow::posix
