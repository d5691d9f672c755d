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

/// For what the user asked for and cannot have.
/// @param where What it stands in, with a colon and a space; may be empty.
[[noreturn]] inline void Refuse(const std::string& where, const std::string& text) {
  throw Failure(kWrongUsage, where + text);
}

/// @throws Failure with that status and the fault's words, unless there is no fault.
inline void Require(const hal::Fault& fault, ExitStatus status = kOutputFailed) {
  if (!fault.ok()) throw Failure(status, fault.message);
}

}  // namespace disflow::apps
