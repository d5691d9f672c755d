// SPDX-License-Identifier: BSD-3-Clause
#include "stamp_text.h"

#include <charconv>
#include <system_error>

#include "disflow/types.h"

namespace disflow::host {

bool ParseStamp(std::string_view text, StampNs& stamp_ns) {
  const char* const end = text.data() + text.size();
  std::int64_t seconds = 0;
  auto [next, error] = std::from_chars(text.data(), end, seconds);
  constexpr std::int64_t kMaxSeconds = 9'000'000'000;
  if (error != std::errc{} || seconds < 0 || seconds > kMaxSeconds) return false;
  stamp_ns = seconds * kSecond_ns;
  if (next == end) return true;
  if (*next != '.') return false;
  StampNs unit_ns = kSecond_ns;
  for (++next; next != end; ++next) {
    if (*next < '0' || *next > '9') return false;
    unit_ns /= 10;
    stamp_ns += unit_ns * (*next - '0');
  }
  return true;
}

}  // namespace disflow::host
