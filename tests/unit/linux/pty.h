// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <fcntl.h>
#include <poll.h>
#include <stdlib.h>
#include <termios.h>

#include <string>
#include <string_view>

#include "disflow/posix/file_descriptor.h"
#include "eventually.h"

namespace disflow::posix::testing {

/// The far end of a serial line: a pseudo-terminal whose near end, device(), a SerialLink opens.
class Pty {
 public:
  Pty() : master_(::posix_openpt(O_RDWR | O_NOCTTY | O_NONBLOCK)) {
    char name[64] = {};
    if (::grantpt(master_.get()) == 0 && ::unlockpt(master_.get()) == 0 &&
        ::ptsname_r(master_.get(), name, sizeof(name)) == 0) {
      device_ = name;
    }
  }

  [[nodiscard]] const std::string& device() const { return device_; }

  [[nodiscard]] int master() const { return master_.get(); }

  /// The near end's settings, seen from here.
  [[nodiscard]] termios settings() const {
    termios result{};
    (void)::tcgetattr(master_.get(), &result);
    return result;
  }

  /// Bytes that have arrived, at most `max`; empty if none arrive.
  [[nodiscard]] std::string Read(std::size_t max = 1 << 16) const {
    pollfd waiting{master_.get(), POLLIN, 0};
    if (::poll(&waiting, 1, test::kPatience_ms) != 1) return {};
    return ReadNow(max);
  }
  /// Bytes that have arrived by now.
  [[nodiscard]] std::string ReadNow(std::size_t max = 1 << 16) const {
    std::string text(max, '\0');
    const ssize_t size = ::read(master_.get(), text.data(), text.size());
    text.resize(size > 0 ? static_cast<std::size_t>(size) : 0);
    return text;
  }
  /// Reads until `size` bytes are there or no more come.
  [[nodiscard]] std::string ReadExactly(std::size_t size) const {
    std::string text;
    while (text.size() < size) {
      const std::string more = Read(size - text.size());
      if (more.empty()) break;
      text += more;
    }
    return text;
  }
  [[nodiscard]] bool Write(std::string_view text) const {
    return ::write(master_.get(), text.data(), text.size()) == static_cast<ssize_t>(text.size());
  }

  /// As if the cable of a USB adapter were pulled.
  void Vanish() { master_.Reset(); }

 private:
  FileDescriptor master_;
  std::string device_;
};

}  // namespace disflow::posix::testing
