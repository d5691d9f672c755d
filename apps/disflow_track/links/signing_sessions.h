// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <deque>
#include <string>

#include "disflow/hal/mavlink/signing_session.h"
#include "disflow/posix/signing_time_file.h"
#include "program/console.h"

namespace disflow::apps {

/// The keys of a run. Links with the same key share a session, so that nothing can be replayed from
/// one to the other. The time signed last is kept beside the key, in FILE.time: machines without a
/// battery for their clock start in the past.
class SigningSessions {
 public:
  /// @param own_system_id See hal::mavlink::SigningSession.
  SigningSessions(std::uint8_t own_system_id, Console& console)
      : own_system_id_(own_system_id), console_(console) {}
  SigningSessions(const SigningSessions&) = delete;
  SigningSessions& operator=(const SigningSessions&) = delete;
  ~SigningSessions();

  /// @return The session of the key in that file; valid as long as this object.
  /// @throws Failure kWrongUsage for a file that cannot be read, that others may read or that holds
  /// no key.
  [[nodiscard]] hal::mavlink::SigningSession& Open(const std::string& key_file);
  /// Before messages are sent or received: takes the system's clock, and now and then keeps the
  /// time.
  void Advance() noexcept;

 private:
  struct Entry {
    Entry(const hal::mavlink::SigningKey& key, hal::mavlink::SigningTime start,
          std::uint8_t own_system_id)
        : session(key, start, own_system_id), kept(start) {}
    hal::mavlink::SigningSession session;
    std::string time_path;
    posix::SigningTimeFile time_file;
    hal::mavlink::SigningTime kept;  ///< The time that was written last.
    bool is_kept = true;             ///< false: it cannot be written, which was said.
  };

  [[nodiscard]] Entry& Add(const hal::mavlink::SigningKey& key, const std::string& key_file);
  void Keep(Entry& entry) noexcept;

  std::uint8_t own_system_id_;
  Console& console_;
  std::deque<Entry> entries_;
};

}  // namespace disflow::apps
