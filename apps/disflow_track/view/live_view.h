// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <thread>

#include "disflow/hal/fault.h"
#include "disflow/posix/view/web_server.h"
#include "objects/object_channel.h"
#include "view/object_view.h"
#include "view/run_metrics.h"

namespace disflow::apps {

/// A page on which browsers see the tracked objects live. Works in threads of its own: one draws,
/// at most ten times a second, one talks to the browsers.
class LiveView {
 public:
  /// @param channels Outlive the view. Before the run starts.
  /// @param version Of the program.
  LiveView(posix::WebServerOptions options, std::span<const posix::WebAsset> page,
           std::span<ObjectChannel* const> channels, const std::string& version);
  LiveView(const LiveView&) = delete;
  LiveView& operator=(const LiveView&) = delete;
  ~LiveView();

  [[nodiscard]] hal::Fault Start();
  /// The page says that no more frames will come.
  void EndOfInput() noexcept { ended_ = true; }
  [[nodiscard]] int port() const noexcept { return server_.port(); }

 private:
  void Work();
  void Obey(std::span<const std::uint8_t> command);

  NewsSignal signal_;
  posix::MessageBoard board_;
  RunMetrics metrics_;
  std::vector<std::unique_ptr<ObjectView>> objects_;
  posix::WebServer server_;
  std::atomic<bool> ended_ = false;
  std::atomic<bool> stop_ = false;
  std::thread thread_;
};

}  // namespace disflow::apps
