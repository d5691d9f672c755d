// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "disflow/hal/fault.h"
#include "disflow/hal/mavlink/signing_session.h"
#include "disflow/posix/file_descriptor.h"

namespace disflow::posix {

/// Keeps the signing time over restarts, for machines whose clock starts in the past. Holds two
/// copies and always overwrites the earlier one, so that a crash leaves a whole one behind. Does
/// not wait until the disk has it: after a loss of power the time may be that of half a minute ago.
class SigningTimeFile {
 public:
  /// @return As ErrnoFault(); the file is made if need be.
  [[nodiscard]] hal::Fault Open(const std::string& path);
  /// @return The later copy that is whole, 0 if there is none.
  [[nodiscard]] hal::mavlink::SigningTime Load() const noexcept;
  /// @return false if the disk did not take it.
  [[nodiscard]] bool Save(hal::mavlink::SigningTime time) noexcept;

 private:
  FileDescriptor file_;
  int next_copy_ = 0;  ///< Which one is the earlier.
};

/// CLOCK_REALTIME as signing counts it.
[[nodiscard]] hal::mavlink::SigningTime SigningTimeNow() noexcept;

}  // namespace disflow::posix
