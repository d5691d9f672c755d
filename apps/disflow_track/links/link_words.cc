// SPDX-License-Identifier: BSD-3-Clause
#include "links/link_words.h"

#include <array>
#include <cstdio>

namespace disflow::apps {

std::string NotAuthentic(const hal::mavlink::DecoderCounters& counters) {
  std::string text;
  const auto add = [&text](std::uint32_t count, const char* what) {
    if (count != 0) text += ", " + std::to_string(count) + " received " + what;
  };
  add(counters.without_signature, "unsigned");
  add(counters.wrong_signature, "with a wrong signature");
  add(counters.replayed, "replayed");
  add(counters.outdated, "more than a minute old");
  add(counters.streams_refused, "of too many senders");
  return text;
}

std::string LeftOut(std::uint64_t bytes) {
  return bytes == 0 ? "" : ", " + std::to_string(bytes) + " received bytes left out as too many";
}

std::string NotSigned(std::uint32_t messages) {
  return messages == 0 ? "" : ", " + std::to_string(messages) + " not signed and not sent";
}

std::string ClockWords(const Expected<hal::mavlink::ClockOffset>& offset, std::uint32_t restarts) {
  if (!offset.ok()) return ", the autopilot's clock is not known: does it answer TIMESYNC?";
  std::array<char, 96> text{};
  (void)std::snprintf(text.data(), text.size(),
                      ", the autopilot's clock is %+.3f s from this one, to %.3f ms",
                      1e-9 * static_cast<double>(offset.value.offset_ns),
                      1e-6 * static_cast<double>(offset.value.uncertainty_ns));
  std::string words = text.data();
  if (restarts > 0) words += ", and was set anew " + std::to_string(restarts) + " times";
  return words;
}

}  // namespace disflow::apps
