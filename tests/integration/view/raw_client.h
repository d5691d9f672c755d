// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

#include "disflow/posix/file_descriptor.h"

namespace disflow {

/// A TCP connection over which a test sends what no browser would.
class RawClient {
 public:
  explicit RawClient(int port);

  /// @return false if the other end has closed already.
  bool Send(std::string_view bytes);
  /// Says that nothing more will be sent; what comes can still be read.
  void EndSending();
  /// Reads until `end` stands in what came, or the connection is closed, or nothing came for long.
  /// @return All that has come since the last call.
  std::string ReadUntil(std::string_view end);
  /// @return false if the other end keeps the connection open for long.
  bool IsClosedByServer();
  /// As IsClosedByServer(), of a WebSocket: a close frame will do.
  bool IsHungUpOn();

  /// Appends what comes next. @return false: closed, or nothing came for long.
  bool Receive(std::string& text);

 private:
  posix::FileDescriptor socket_;
  bool closed_ = false;
};

/// One request on a connection of its own. @return The whole answer, empty if there was none.
std::string Ask(int port, std::string_view request);
std::string Get(int port, const std::string& path, const std::string& headers = "");
/// @return The answer's status, 0 if there is none.
int StatusOf(std::string_view answer);

/// The request that opens a WebSocket.
std::string Upgrade(int port, const std::string& headers = "", const std::string& path = "/live",
                    const std::string& protocol = "disflow.v1");
/// A frame as a browser sends it: masked.
std::string Frame(unsigned char first_byte, std::string_view payload);
/// As no browser sends it.
std::string UnmaskedFrame(unsigned char first_byte, std::string_view payload);

}  // namespace disflow
