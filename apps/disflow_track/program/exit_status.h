// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <stdexcept>
#include <string>

#include "disflow/hal/fault.h"

namespace disflow::apps {

enum ExitStatus : int { kDone = 0, kWrongUsage = 2, kInputFailed = 3, kOutputFailed = 4 };

/// Ends the program with a message for a person and an exit status.
class Failure : public std::runtime_error {
 public:
  Failure(ExitStatus status, const std::string& message)
      : std::runtime_error(message), status_(status) {}
  [[nodiscard]] ExitStatus status() const noexcept { return status_; }

 private:
  ExitStatus status_;
};

/// @throws Failure with the fault's words, if there is one.
inline void Require(const hal::Fault& fault, ExitStatus status = kOutputFailed) {
  if (!fault.ok()) throw Failure(status, fault.message);
}

}  // namespace disflow::apps
