// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// The far end of a link, which writes what arrives into a file.
///   far_end udp PORT OUTPUT    until a signal ends it
///   far_end line LINK OUTPUT   makes LINK point to the near end of a serial line, takes nothing
///                              until SIGUSR1, then everything until the near end is closed

#include <arpa/inet.h>
#include <fcntl.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <string_view>

namespace {

volatile std::sig_atomic_t awake = 0;

int OpenPort(const char* port) {
  const int socket = ::socket(AF_INET, SOCK_DGRAM, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(static_cast<std::uint16_t>(std::atoi(port)));
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  const bool bound =
      ::bind(socket, reinterpret_cast<const sockaddr*>(&address), sizeof(address)) == 0;
  return bound ? socket : -1;
}

int OpenLine(const char* link) {
  const int line = ::posix_openpt(O_RDWR | O_NOCTTY);
  if (line < 0 || ::grantpt(line) != 0 || ::unlockpt(line) != 0) return -1;
  (void)std::signal(SIGUSR1, [](int) { awake = 1; });
  if (::symlink(::ptsname(line), link) != 0) return -1;
  constexpr int kNap_us = 10'000;
  while (awake == 0) (void)::usleep(kNap_us);
  return line;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 4) return 2;
  const int source = std::string_view(argv[1]) == "udp" ? OpenPort(argv[2]) : OpenLine(argv[2]);
  const int output = ::open(argv[3], O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
  if (source < 0 || output < 0) {
    std::perror("far_end");
    return 1;
  }
  std::array<char, 4096> buffer{};
  for (;;) {
    const ssize_t count = ::read(source, buffer.data(), buffer.size());
    if (count <= 0) return 0;
    if (::write(output, buffer.data(), static_cast<std::size_t>(count)) != count) return 1;
  }
}
