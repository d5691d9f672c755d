// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/late_stamps.h"

namespace disflow {
namespace {

// A clock that is put right again costs the frames between: an object is found again within 2 s.
constexpr StampNs kPatience_ns = 2'000'000'000;
// Single wrong stamps are no clock.
constexpr std::uint8_t kFewest = 10;

}  // namespace

bool LateStamps::GoOn(StampNs stamp_ns) noexcept {
  if (frames_ == 0 || stamp_ns <= latest_ns_) {
    frames_ = 0;
    first_ns_ = stamp_ns;
  }
  latest_ns_ = stamp_ns;
  if (frames_ < kFewest) ++frames_;
  return frames_ == kFewest && SpanNs(first_ns_, stamp_ns) > kPatience_ns;
}

}  // namespace disflow
