// SPDX-License-Identifier: BSD-3-Clause
#include "http_answer.h"

#include <array>

namespace disflow::posix {
namespace {

/// Builds the header lines of an answer in a buffer.
class HeaderWriter {
 public:
  HeaderWriter(lws* wsi, std::vector<std::uint8_t>& buffer)
      : wsi_(wsi),
        begin_(buffer.data() + LWS_PRE),
        position_(begin_),
        end_(buffer.data() + buffer.size()) {}

  void Status(int code) {
    Keep(lws_add_http_header_status(wsi_, static_cast<unsigned>(code), &position_, end_));
  }
  /// @param name In lower case, with its colon.
  void Add(const char* name, std::string_view value) {
    Keep(lws_add_http_header_by_name(wsi_, reinterpret_cast<const unsigned char*>(name),
                                     reinterpret_cast<const unsigned char*>(value.data()),
                                     static_cast<int>(value.size()), &position_, end_));
  }
  void Length(std::size_t bytes) {
    Keep(lws_add_http_header_content_length(wsi_, bytes, &position_, end_));
  }
  [[nodiscard]] bool Finish() {
    Keep(lws_finalize_write_http_header(wsi_, begin_, &position_, end_));
    return good_;
  }

 private:
  void Keep(int status) { good_ = good_ && status == 0; }

  lws* wsi_;
  unsigned char* begin_;
  unsigned char* position_;
  unsigned char* end_;
  bool good_ = true;
};

const char* Explain(Verdict verdict) {
  switch (verdict) {
    case Verdict::kNoToken:
      return "Open the address that disflow_track printed, with its token: ...?token=...";
    case Verdict::kForbidden:
      return "This page is served to this machine only, under the name localhost; for others "
             "start disflow_track with an address and a token, see docs/view.md.";
    case Verdict::kNotFound:
      return "There is no such page.";
    case Verdict::kWrongMethod:
      return "Only GET is answered.";
    case Verdict::kTooLarge:
      return "Requests must not have a body.";
    case Verdict::kBusy:
      return "As many browsers as may watch do so already.";
    case Verdict::kBadRequest:
    case Verdict::kAllowed:
    case Verdict::kRememberToken:
      break;
  }
  return "This request is not understood.";
}

}  // namespace

Header HeaderOf(lws* wsi, lws_token_indexes header) {
  std::array<char, kHeaderBytes> value{};
  const int room = static_cast<int>(value.size());
  const int size = lws_hdr_copy(wsi, value.data(), room, header);
  if (size < 0) return {true, false, {}};
  if (size > 0) return {true, true, std::string(value.data(), static_cast<std::size_t>(size))};
  // Of one that was not given there is no first part, of an empty one there is.
  return {lws_hdr_copy_fragment(wsi, value.data(), room, header, 0) >= 0, true, {}};
}

std::string CookieOf(lws* wsi, const std::string& name) {
  std::array<char, kHeaderBytes> value{};
  std::size_t size = value.size();
  const bool found = lws_http_cookie_get(wsi, name.c_str(), value.data(), &size) == 0;
  return found ? std::string(value.data(), size) : std::string();
}

std::string QueryOf(lws* wsi, const char* name) {
  std::array<char, kHeaderBytes> value{};
  const char* const found =
      lws_get_urlarg_by_name(wsi, name, value.data(), static_cast<int>(value.size()));
  return found == nullptr ? std::string() : std::string(found);
}

const lws_protocol_vhost_options* SecurityHeaders() {
  static const lws_protocol_vhost_options kCache = {nullptr, nullptr, "cache-control:", "no-store"};
  static const lws_protocol_vhost_options kReferrer = {&kCache, nullptr,
                                                       "referrer-policy:", "no-referrer"};
  static const lws_protocol_vhost_options kResource = {
      &kReferrer, nullptr, "cross-origin-resource-policy:", "same-origin"};
  static const lws_protocol_vhost_options kOpener = {&kResource, nullptr,
                                                     "cross-origin-opener-policy:", "same-origin"};
  static const lws_protocol_vhost_options kFrames = {&kOpener, nullptr, "x-frame-options:", "DENY"};
  static const lws_protocol_vhost_options kSniff = {&kFrames, nullptr,
                                                    "x-content-type-options:", "nosniff"};
  static const lws_protocol_vhost_options kPolicy = {
      &kSniff, nullptr, "content-security-policy:",
      "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' data:; "
      "connect-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'"};
  return &kPolicy;
}

bool WriteHeader(lws* wsi, const WebAsset& asset, std::vector<std::uint8_t>& buffer) {
  HeaderWriter header(wsi, buffer);
  header.Status(HTTP_STATUS_OK);
  header.Add("content-type:", asset.content_type);
  header.Add("content-encoding:", "gzip");
  header.Length(asset.gzip.size());
  return header.Finish();
}

bool WriteTextHeader(lws* wsi, std::size_t bytes, std::vector<std::uint8_t>& buffer) {
  HeaderWriter header(wsi, buffer);
  header.Status(HTTP_STATUS_OK);
  header.Add("content-type:", "text/plain; version=0.0.4; charset=utf-8");
  header.Length(bytes);
  return header.Finish();
}

bool WriteRedirect(lws* wsi, const std::string& cookie, std::vector<std::uint8_t>& buffer) {
  HeaderWriter header(wsi, buffer);
  header.Status(static_cast<int>(Verdict::kRememberToken));
  header.Add("location:", "/");
  header.Add("set-cookie:", cookie);
  header.Length(0);
  return header.Finish();
}

int Refuse(lws* wsi, Verdict verdict) {
  (void)lws_return_http_status(wsi, static_cast<unsigned>(verdict), Explain(verdict));
  return -1;
}

}  // namespace disflow::posix
