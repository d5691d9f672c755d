// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/posix/service_notifier.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdlib>
#include <cstring>

namespace disflow::posix {
namespace {

constexpr std::size_t kMaxStatus = 200;
constexpr std::int64_t kBeatsPerPeriod = 4;

std::string_view Environment(const char* name) noexcept {
  const char* const value = std::getenv(name);
  return value != nullptr ? std::string_view(value) : std::string_view();
}

std::int64_t Number(std::string_view text) noexcept {
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc{} && end == text.data() + text.size() && value > 0 ? value : 0;
}

}  // namespace

ServiceNotifier::ServiceNotifier() noexcept : manager_(Environment("NOTIFY_SOCKET")) {
  if (!active()) return;
  const std::int64_t pid = Number(Environment("WATCHDOG_PID"));
  if (pid == 0 || pid == ::getpid()) {
    constexpr std::int64_t kLongest_us = 86'400'000'000;
    watchdog_ns_ = std::min(Number(Environment("WATCHDOG_USEC")), kLongest_us) * 1000;
  }
}

void ServiceNotifier::Status(std::string_view text) noexcept {
  constexpr std::string_view kKey = "STATUS=";
  std::array<char, kKey.size() + kMaxStatus> message{};
  const std::size_t length = std::min(text.size(), kMaxStatus);
  std::memcpy(message.data(), kKey.data(), kKey.size());
  std::memcpy(message.data() + kKey.size(), text.data(), length);
  Send({message.data(), kKey.size() + length});
}

void ServiceNotifier::Beat(std::int64_t now_ns) noexcept {
  if (watchdog_ns_ == 0) return;
  if (beaten_ && now_ns - beat_ns_ < watchdog_ns_ / kBeatsPerPeriod) return;
  beaten_ = true;
  beat_ns_ = now_ns;
  Send("WATCHDOG=1");
}

void ServiceNotifier::Send(std::string_view message) noexcept {
  // If the manager does not read, the message is lost; the next one says the same again.
  if (active()) (void)manager_.Send(message);
}

}  // namespace disflow::posix
