// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <libwebsockets.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "disflow/posix/view/web_server.h"
#include "request.h"

/// @file
/// Reading and writing of HTTP headers with libwebsockets.

namespace disflow::posix {

/// Of a request, all lines together. One that has more is not answered.
inline constexpr std::size_t kHeaderBytes = 4096;

/// A header as it was given.
struct Header {
  bool is_given = false;
  bool is_whole = true;  ///< false: there was no room for it. It must not pass for one not given.
  std::string value;
};
[[nodiscard]] Header HeaderOf(lws* wsi, lws_token_indexes header);
[[nodiscard]] std::string CookieOf(lws* wsi, const std::string& name);
/// @param name With the equals sign.
[[nodiscard]] std::string QueryOf(lws* wsi, const char* name);

/// They go with every answer.
[[nodiscard]] const lws_protocol_vhost_options* SecurityHeaders();

/// @param buffer Scratch, with LWS_PRE bytes ahead.
[[nodiscard]] bool WriteTextHeader(lws* wsi, std::size_t bytes, std::vector<std::uint8_t>& buffer);
/// @param buffer Scratch, with LWS_PRE bytes ahead.
[[nodiscard]] bool WriteHeader(lws* wsi, const WebAsset& asset, std::vector<std::uint8_t>& buffer);
/// To the page, which from then on needs no token in its address.
[[nodiscard]] bool WriteRedirect(lws* wsi, const std::string& cookie,
                                 std::vector<std::uint8_t>& buffer);
/// Says why in a sentence. @return -1: the connection is to be closed.
[[nodiscard]] int Refuse(lws* wsi, Verdict verdict);

}  // namespace disflow::posix
