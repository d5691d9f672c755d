// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What arrives at the live view's web server over a real socket: HTTP, or frames of a WebSocket.
/// Whatever it is, the server goes on serving others, and nobody without the token gets the page or
/// gives a command.

#include <array>
#include <atomic>
#include <cstdint>
#include <string>
#include <string_view>

#include "disflow/posix/view/web_server.h"
#include "file_in_memory.h"
#include "raw_client.h"

namespace {

using namespace disflow;
using fuzz::Require;

constexpr std::string_view kToken = "0123456789abcdef";
constexpr std::string_view kPage = "the page";
constexpr std::string_view kHello = "the board";

std::span<const std::uint8_t> Bytes(std::string_view text) {
  return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
}

/// The server under test; one for all inputs, as in a run of days.
class Server {
 public:
  Server() {
    board_.Put(0, {kHello.begin(), kHello.end()});
    posix::WebServerOptions options;
    options.token = kToken;
    options.request_timeout_s = 1;
    options.connection_timeout_s = 2;
    server_ =
        std::make_unique<posix::WebServer>(options, assets_, board_, [this](auto) { ++commands_; });
    Require(server_->Start().ok());
  }

  [[nodiscard]] int port() const { return server_->port(); }
  [[nodiscard]] int commands() const { return commands_; }
  [[nodiscard]] std::string Cookie() const {
    return "Cookie: disflow_" + std::to_string(port()) + "=" + std::string(kToken) + "\r\n";
  }
  [[nodiscard]] bool Serves() const {
    const std::string answer = Get(port(), "/", Cookie());
    return StatusOf(answer) == 200 && answer.find(kPage) != std::string::npos;
  }

 private:
  std::array<posix::WebAsset, 1> assets_ = {
      posix::WebAsset{"/", "text/html; charset=utf-8", Bytes(kPage)}};
  posix::MessageBoard board_{1, 4};
  std::atomic<int> commands_ = 0;
  std::unique_ptr<posix::WebServer> server_;
};

/// Sends in two pieces, so that the server has to put requests and frames together.
void SendInPieces(RawClient& client, std::string_view bytes, std::size_t first) {
  client.Send(bytes.substr(0, first));
  client.Send(bytes.substr(std::min(first, bytes.size())));
}

}  // namespace

/// The first byte chooses: HTTP, frames of a stranger, or frames of a viewer. The second is the
/// length of the first piece.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size < 2) return 0;
  static Server server;
  const std::string_view rest(reinterpret_cast<const char*>(data) + 2, size - 2);
  const int commands_before = server.commands();
  const bool is_viewer = data[0] % 3 == 2;
  {
    RawClient client(server.port());
    if (data[0] % 3 == 1) client.Send(Upgrade(server.port()));
    if (is_viewer) {
      client.Send(Upgrade(server.port(), server.Cookie()));
      Require(client.ReadUntil(kHello).find(kHello) != std::string::npos);
    }
    SendInPieces(client, rest, data[1]);
    client.EndSending();
    const std::string answer = client.ReadUntil("no answer has this");
    const bool knows_token = is_viewer || rest.find(kToken) != std::string_view::npos;
    if (!knows_token) {
      Require(answer.find(kPage) == std::string::npos && answer.find(kHello) == std::string::npos);
      Require(server.commands() == commands_before);
    }
  }
  static unsigned inputs = 0;
  if (++inputs % 64 == 0) Require(server.Serves());
  return 0;
}
