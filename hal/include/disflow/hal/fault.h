// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdarg>
#include <cstdio>

#include "disflow/status.h"

namespace disflow::hal {

/// A Status with the words that a person needs: which file, field or device, what was wrong, what
/// to do. Fixed size, no heap; text beyond the capacity is cut.
struct Fault {
  static constexpr int kCapacity = 256;
  Status status = Status::kOk;
  char message[kCapacity] = {};

  [[nodiscard]] bool ok() const noexcept { return status == Status::kOk; }
};

/// Makes a Fault from a printf-style message.
[[gnu::format(printf, 2, 3)]] inline Fault MakeFault(Status status, const char* format,
                                                     ...) noexcept {
  Fault fault;
  fault.status = status;
  va_list arguments;
  va_start(arguments, format);
  // A cut message is acceptable, so the length that vsnprintf returns is not needed.
  (void)std::vsnprintf(fault.message, sizeof(fault.message), format, arguments);
  va_end(arguments);
  return fault;
}

}  // namespace disflow::hal
