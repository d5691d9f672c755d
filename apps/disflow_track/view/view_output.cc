// SPDX-License-Identifier: BSD-3-Clause
#include "view/view_output.h"

#include "program/exit_status.h"
#include "program/stop_signal.h"
#ifdef DISFLOW_HAS_VIEW
#include <sys/random.h>

#include <array>
#include <chrono>
#include <thread>

#include "view/live_view.h"
#include "view_page.h"
#endif

namespace disflow::apps {

#ifdef DISFLOW_HAS_VIEW
namespace {

constexpr std::size_t kShortestToken = 12;

std::string NewToken() {
  std::array<unsigned char, 16> bytes{};
  if (getrandom(bytes.data(), bytes.size(), 0) != static_cast<ssize_t>(bytes.size())) {
    throw Failure(kOutputFailed, "--view: the system gives no random numbers; use --view-token");
  }
  std::string token;
  for (const unsigned char byte : bytes) {
    constexpr const char* kDigits = "0123456789abcdef";
    token += kDigits[byte >> 4U];
    token += kDigits[byte & 15U];
  }
  return token;
}

/// It has to stand in a cookie and in an address as it is.
void CheckToken(const std::string& token) {
  const bool plain = token.find_first_not_of(
                         "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ"
                         "0123456789-_") == std::string::npos;
  if (plain && token.size() >= kShortestToken && token.size() <= 10 * kShortestToken) return;
  throw Failure(kWrongUsage, "--view-token: " + std::to_string(kShortestToken) + " to " +
                                 std::to_string(10 * kShortestToken) +
                                 " letters, digits, - and _ are wanted");
}

posix::WebServerOptions ServerOptions(const ViewOptions& options) {
  posix::WebServerOptions server;
  const hal::Fault fault = posix::ParseWebAddress(options.address, server.address);
  if (!fault.ok()) throw Failure(kWrongUsage, std::string("--view ") + fault.message);
  if (!options.token.empty()) CheckToken(options.token);
  server.token = options.token;
  if (server.address.without_token && !server.token.empty()) {
    throw Failure(kWrongUsage,
                  "--view ...?token=none and a token (--view-token or DISFLOW_VIEW_TOKEN) "
                  "contradict each other; leave one out");
  }
  // On loopback too: other users of the machine reach it.
  if (server.token.empty() && !server.address.without_token) server.token = NewToken();
  return server;
}

}  // namespace

ViewOutput::ViewOutput(const ViewOptions& options, std::span<ObjectChannel* const> channels,
                       Console& console)
    : hold_(options.hold), console_(console) {
  if (options.address.empty()) return;
  const posix::WebServerOptions server = ServerOptions(options);
  view_ = std::make_unique<LiveView>(server, ViewPage(), channels, DISFLOW_VERSION);
  const hal::Fault fault = view_->Start();
  if (!fault.ok()) throw Failure(kOutputFailed, std::string("--view ") + fault.message);
  std::string url = server.address.Url(view_->port());
  // One that was given is known to who gave it, and does not belong into a log.
  if (!server.token.empty()) url += "?token=" + (options.token.empty() ? server.token : "...");
  console_.Say("live view: " + url);
}

void ViewOutput::EndOfInput() {
  if (view_ == nullptr) return;
  view_->EndOfInput();
  if (!hold_ || StopRequested()) return;
  console_.Say("the input has ended; the live view stays until Ctrl-C");
  while (!StopRequested()) std::this_thread::sleep_for(std::chrono::milliseconds(100));
}

#else

class LiveView {};

ViewOutput::ViewOutput(const ViewOptions& options, std::span<ObjectChannel* const> /*channels*/,
                       Console& console)
    : hold_(options.hold), console_(console) {
  if (options.address.empty()) return;
  throw Failure(kWrongUsage,
                "--view: this program was built without the live view (DISFLOW_WITH_VIEW=OFF)");
}

void ViewOutput::EndOfInput() {}

#endif

ViewOutput::~ViewOutput() = default;

}  // namespace disflow::apps
