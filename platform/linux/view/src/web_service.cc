// SPDX-License-Identifier: BSD-3-Clause
#include "web_service.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <thread>
#include <utility>

#include "http_answer.h"
#include "listen_check.h"
#include "viewer.h"

namespace disflow::posix {
namespace {

constexpr std::size_t kReceiveBytes = 64;
constexpr unsigned kOwnDescriptors = 8;
constexpr int kDownload_s = 30;
/// More than the pieces of a request that somebody sends at once.
constexpr int kIdleTurns = 10;
constexpr std::chrono::milliseconds kPause{5};
constexpr lws_usec_t kSecond_us = 1'000'000;
constexpr std::string_view kMetricsPath = "/metrics";

/// Turns that only send on what libwebsockets holds back for a slow viewer show nothing either.
bool IsOutOfDescriptors() noexcept {
  const int probe = open("/dev/null", O_RDONLY | O_CLOEXEC);
  if (probe < 0) return errno == EMFILE || errno == ENFILE;
  (void)close(probe);
  return false;
}

}  // namespace

WebService::WebService(WebServerOptions options, std::span<const WebAsset> assets,
                       const MessageBoard& board, WebServer::CommandHandler on_command)
    : options_(std::move(options)),
      assets_(assets),
      board_(board),
      on_command_(std::move(on_command)),
      buffer_(LWS_PRE + Viewer::kChunkBytes) {}

WebService::~WebService() {
  if (context_ != nullptr) lws_context_destroy(context_);
}

hal::Fault WebService::Open() {
  const auto connections = static_cast<unsigned>(options_.max_connections);
  // A viewer has two.
  const unsigned descriptors =
      connections + static_cast<unsigned>(options_.max_viewers) + kOwnDescriptors;
  hal::Fault fault = CheckListening(options_.address);
  if (fault.ok()) fault = CheckDescriptors(options_.address, descriptors);
  if (!fault.ok()) return fault;
  lws_set_log_level(0, nullptr);
  protocols_[0] = {"http", OnEvent, sizeof(Download), 0, 0, nullptr, 0};
  protocols_[1] = {WebServer::kProtocol, OnEvent, sizeof(Session), kReceiveBytes, 0, nullptr, 0};
  retry_.secs_since_valid_ping = static_cast<std::uint16_t>(options_.ping_after_s);
  retry_.secs_since_valid_hangup = static_cast<std::uint16_t>(options_.hang_up_after_s);

  const WebAddress& address = options_.address;
  const bool is_any = address.host == "0.0.0.0" || address.host == "::";
  lws_context_creation_info info{};
  info.port = address.port;
  info.iface = is_any ? nullptr : address.host.c_str();
  info.protocols = protocols_.data();
  info.options = LWS_SERVER_OPTION_FAIL_UPON_UNABLE_TO_BIND;
  if (!address.is_ipv6) info.options |= LWS_SERVER_OPTION_DISABLE_IPV6;
  info.gid = static_cast<decltype(info.gid)>(-1);
  info.uid = static_cast<decltype(info.uid)>(-1);
  info.user = this;
  info.headers = SecurityHeaders();
  info.server_string = "disflow";
  info.max_http_header_data = kHeaderBytes;
  // Each connection has a buffer for its request: a slow one keeps nobody else waiting.
  info.max_http_header_pool = static_cast<unsigned short>(connections);
  info.timeout_secs = static_cast<unsigned>(options_.request_timeout_s);
  info.timeout_secs_ah_idle = info.timeout_secs;
  info.keepalive_timeout = options_.request_timeout_s;
  info.retry_and_idle_policy = &retry_;
  info.fd_limit_per_thread = descriptors;
  context_ = lws_create_context(&info);
  if (context_ == nullptr) {
    return hal::MakeFault(Status::kIoError, "%s: cannot be listened on",
                          address.Url(address.port).c_str());
  }
  port_ = lws_get_vhost_listen_port(lws_get_vhost_by_name(context_, "default"));
  // libwebsockets does not say so itself.
  if (port_ <= 0) {
    return hal::MakeFault(Status::kIoError, "%s: cannot be listened on",
                          address.Url(address.port).c_str());
  }
  // Browsers keep cookies by host, not by port.
  cookie_name_ = "disflow_" + std::to_string(port_);
  return {};
}

void WebService::Turn() {
  (void)lws_service(context_, 0);
  // A connection that cannot be taken for want of descriptors waits at the door, and libwebsockets
  // would look at it again and again.
  if (idle_turns_ < kIdleTurns) {
    ++idle_turns_;
  } else if (IsOutOfDescriptors()) {
    std::this_thread::sleep_for(kPause);
  }
}

void WebService::Wake() noexcept { lws_cancel_service(context_); }

int WebService::OnEvent(lws* wsi, lws_callback_reasons reason, void* user, void* in,
                        std::size_t size) {
  auto* const self = static_cast<WebService*>(lws_context_user(lws_get_context(wsi)));
  return self->Handle(wsi, reason, user, in, size);
}

int WebService::Handle(lws* wsi, lws_callback_reasons reason, void* user, void* in,
                       std::size_t size) {
  idle_turns_ = 0;
  switch (reason) {
    case LWS_CALLBACK_FILTER_NETWORK_CONNECTION:
      return connections_.size() < static_cast<std::size_t>(options_.max_connections) ? 0 : 1;
    case LWS_CALLBACK_SERVER_NEW_CLIENT_INSTANTIATED:
      connections_.insert(wsi);
      // libwebsockets itself forgets about some that ask for what it does not know.
      lws_set_timer_usecs(wsi, options_.connection_timeout_s * kSecond_us);
      return 0;
    case LWS_CALLBACK_TIMER:
      // Viewers stay: cancelling it for them is not reliable.
      return std::strcmp(lws_get_protocol(wsi)->name, WebServer::kProtocol) == 0 ? 0 : -1;
    case LWS_CALLBACK_WSI_DESTROY:
      connections_.erase(wsi);
      return 0;
    case LWS_CALLBACK_HTTP:
      return AnswerRequest(wsi, *static_cast<Download*>(user),
                           {static_cast<const char*>(in), size});
    case LWS_CALLBACK_HTTP_WRITEABLE:
      return ContinueDownload(wsi, *static_cast<Download*>(user));
    case LWS_CALLBACK_CLOSED_HTTP:
      if (user != nullptr) delete std::exchange(static_cast<Download*>(user)->text, nullptr);
      return 0;
    case LWS_CALLBACK_HTTP_CONFIRM_UPGRADE:
      return AnswerUpgrade(wsi);
    case LWS_CALLBACK_ESTABLISHED:
      static_cast<Session*>(user)->viewer = new Viewer(wsi, board_, on_command_);
      ++viewers_;
      return lws_callback_on_writable(wsi) < 0 ? -1 : 0;
    case LWS_CALLBACK_CLOSED:
      delete std::exchange(static_cast<Session*>(user)->viewer, nullptr);
      --viewers_;
      return 0;
    case LWS_CALLBACK_SERVER_WRITEABLE:
      return static_cast<Session*>(user)->viewer->OnWriteable(buffer_);
    case LWS_CALLBACK_RAW_RX_FILE: {
      const auto* const session = static_cast<const Session*>(lws_wsi_user(lws_get_parent(wsi)));
      return session->viewer->OnInput(buffer_);
    }
    case LWS_CALLBACK_RECEIVE:
      // Sent together with the request, before there was a WebSocket. Viewer reads all else.
      lws_close_reason(wsi, LWS_CLOSE_STATUS_PROTOCOL_ERR, nullptr, 0);
      return -1;
    case LWS_CALLBACK_EVENT_WAIT_CANCELLED:
      (void)lws_callback_on_writable_all_protocol(context_, &protocols_[1]);
      return 0;
    default:
      return 0;
  }
}

Request WebService::Read(lws* wsi) const {
  Request request;
  request.is_get = lws_hdr_total_length(wsi, WSI_TOKEN_GET_URI) > 0;
  request.has_body = lws_hdr_total_length(wsi, WSI_TOKEN_HTTP_TRANSFER_ENCODING) > 0 ||
                     lws_hdr_total_length(wsi, WSI_TOKEN_HTTP_CONTENT_LENGTH) > 0;
  Header host = HeaderOf(wsi, WSI_TOKEN_HOST);
  Header origin = HeaderOf(wsi, WSI_TOKEN_ORIGIN);
  request.is_whole = host.is_whole && origin.is_whole;
  request.host = std::move(host.value);
  if (origin.is_given) request.origin = std::move(origin.value);
  request.cookie_token = CookieOf(wsi, cookie_name_);
  request.query_token = QueryOf(wsi, "token=");
  const Header authorization = HeaderOf(wsi, WSI_TOKEN_HTTP_AUTHORIZATION);
  request.is_whole = request.is_whole && authorization.is_whole;
  constexpr std::string_view kScheme = "Bearer ";
  if (authorization.value.starts_with(kScheme))
    request.bearer_token = authorization.value.substr(kScheme.size());
  return request;
}

int WebService::AnswerRequest(lws* wsi, Download& download, std::string_view path) {
  const Verdict verdict = Judge(Read(wsi), {options_.token, options_.address.is_loopback});
  if (verdict == Verdict::kRememberToken) return RedirectWithCookie(wsi);
  if (verdict != Verdict::kAllowed) return Refuse(wsi, verdict);
  if (path == kMetricsPath && options_.metrics) {
    delete std::exchange(download.text, new std::string(options_.metrics()));
    download.asset = nullptr;
    download.sent = 0;
    return BeginDownload(wsi, WriteTextHeader(wsi, download.text->size(), buffer_));
  }
  const auto asset = std::find_if(assets_.begin(), assets_.end(),
                                  [path](const WebAsset& item) { return item.path == path; });
  if (asset == assets_.end()) return Refuse(wsi, Verdict::kNotFound);
  download = {&*asset, nullptr, 0};
  return BeginDownload(wsi, WriteHeader(wsi, *asset, buffer_));
}

int WebService::BeginDownload(lws* wsi, bool header_is_written) {
  if (!header_is_written) return -1;
  lws_set_timeout(wsi, PENDING_TIMEOUT_HTTP_CONTENT, kDownload_s);
  return lws_callback_on_writable(wsi) < 0 ? -1 : 0;
}

int WebService::ContinueDownload(lws* wsi, Download& download) {
  if (download.asset == nullptr && download.text == nullptr) return -1;
  const auto whole = download.asset != nullptr
                         ? download.asset->gzip
                         : std::span(reinterpret_cast<const std::uint8_t*>(download.text->data()),
                                     download.text->size());
  const auto left = whole.subspan(download.sent);
  const auto chunk = left.first(std::min(left.size(), Viewer::kChunkBytes));
  std::memcpy(buffer_.data() + LWS_PRE, chunk.data(), chunk.size());
  download.sent += chunk.size();
  const bool is_last = chunk.size() == left.size();
  if (lws_write(wsi, buffer_.data() + LWS_PRE, chunk.size(),
                is_last ? LWS_WRITE_HTTP_FINAL : LWS_WRITE_HTTP) < 0) {
    return -1;
  }
  if (!is_last) return lws_callback_on_writable(wsi) < 0 ? -1 : 0;
  download.asset = nullptr;
  delete std::exchange(download.text, nullptr);
  return lws_http_transaction_completed(wsi) != 0 ? -1 : 0;
}

int WebService::AnswerUpgrade(lws* wsi) {
  const Verdict verdict = Judge(Read(wsi), {options_.token, options_.address.is_loopback});
  Verdict answer = verdict == Verdict::kRememberToken ? Verdict::kAllowed : verdict;
  if (answer == Verdict::kAllowed) {
    const bool known = HeaderOf(wsi, WSI_TOKEN_GET_URI).value == WebServer::kSocketPath &&
                       HeaderOf(wsi, WSI_TOKEN_PROTOCOL).value == WebServer::kProtocol;
    if (!known) answer = Verdict::kNotFound;
    if (viewers_ >= options_.max_viewers) answer = Verdict::kBusy;
  }
  if (answer == Verdict::kAllowed) return 0;
  (void)Refuse(wsi, answer);
  return -1;
}

int WebService::RedirectWithCookie(lws* wsi) {
  const std::string cookie =
      cookie_name_ + "=" + options_.token + "; Path=/; HttpOnly; SameSite=Lax";
  (void)WriteRedirect(wsi, cookie, buffer_);
  return -1;
}

}  // namespace disflow::posix
