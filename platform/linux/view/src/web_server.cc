// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/posix/view/web_server.h"

#include <atomic>
#include <thread>
#include <utility>

#include "disflow/posix/quiet_thread.h"
#include "web_service.h"

namespace disflow::posix {

class WebServer::Service {
 public:
  Service(WebServerOptions options, std::span<const WebAsset> assets, const MessageBoard& board,
          CommandHandler on_command)
      : web_(std::move(options), assets, board, std::move(on_command)) {}
  Service(const Service&) = delete;
  Service& operator=(const Service&) = delete;
  ~Service() {
    if (!thread_.joinable()) return;
    stop_ = true;
    web_.Wake();
    thread_.join();
  }

  [[nodiscard]] hal::Fault Start() {
    const hal::Fault fault = web_.Open();
    if (!fault.ok()) return fault;
    thread_ = StartQuietThread([this] {
      while (!stop_) web_.Turn();
    });
    return {};
  }

  [[nodiscard]] WebService& web() noexcept { return web_; }

 private:
  WebService web_;
  std::atomic<bool> stop_ = false;
  std::thread thread_;
};

WebServer::WebServer(WebServerOptions options, std::span<const WebAsset> assets,
                     const MessageBoard& board, CommandHandler on_command)
    : service_(
          std::make_unique<Service>(std::move(options), assets, board, std::move(on_command))) {}
WebServer::~WebServer() = default;

hal::Fault WebServer::Start() { return service_->Start(); }
void WebServer::Notify() noexcept { service_->web().Wake(); }
int WebServer::port() const noexcept { return service_->web().port(); }
int WebServer::viewers() const noexcept { return service_->web().viewers(); }

}  // namespace disflow::posix
