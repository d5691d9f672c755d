// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <utility>

#include "topic_stream.h"

namespace disflow::posix {

/// What goes with frames and comes on a topic of its own: of its values the newest that is not
/// younger than a frame.
template <class Value>
class FollowedTopic {
 public:
  TopicStream stream;

  /// Forgets all: the stream was opened anew.
  void Restart() {
    current_ = {};
    next_ = {};
    has_next_ = false;
    over_ = false;
    damage_ = {};
  }

  /// Goes on to the newest value of which `stamp_ns` is not older.
  /// @param read `Fault(const BagMessage&, StampNs& stamp_ns, Value&)`
  /// @return What reading says; the next call goes on behind that message. What is damaged in the
  /// file itself is passed over: whoever reads the frames says it.
  template <class Read>
  [[nodiscard]] hal::Fault FollowTo(StampNs stamp_ns, Read&& read) {
    for (;;) {
      if (const hal::Fault fault = Fetch(read); !fault.ok()) return fault;
      if (!has_next_ || next_.stamp_ns > stamp_ns) return {};
      std::swap(current_, next_);
      has_next_ = false;
    }
  }

  /// Makes the first value that of all frames before it.
  /// @return kNotFound if there is none, or kCorrupt for the damage that may have held it; else as
  /// FollowTo().
  template <class Read>
  [[nodiscard]] hal::Fault BeginWithFirst(Read&& read) {
    if (const hal::Fault fault = Fetch(read); !fault.ok()) return fault;
    current_ = next_;
    if (has_next_) return {};
    return damage_.ok() ? stream.Missing() : damage_;
  }

  [[nodiscard]] const Value& current() const noexcept { return current_.value; }

 private:
  struct Stamped {
    StampNs stamp_ns = 0;
    Value value;
  };

  template <class Read>
  [[nodiscard]] hal::Fault Fetch(Read&& read) {
    while (!has_next_ && !over_) {
      BagMessage message;
      hal::Fault fault = stream.Next(message);
      if (fault.status == Status::kCorrupt) {
        if (damage_.ok()) damage_ = fault;
        continue;
      }
      over_ = fault.status == Status::kEndOfStream;
      if (over_) break;
      if (fault.ok()) fault = read(message, next_.stamp_ns, next_.value);
      if (!fault.ok()) {
        return hal::MakeFault(fault.status, "%s: %s", stream.topic().c_str(), fault.message);
      }
      has_next_ = true;
    }
    return {};
  }

  Stamped current_;
  Stamped next_;
  bool has_next_ = false;
  bool over_ = false;
  hal::Fault damage_;  ///< The first.
};

}  // namespace disflow::posix
