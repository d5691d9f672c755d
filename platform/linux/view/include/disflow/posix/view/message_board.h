// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <vector>

namespace disflow::posix {

/// Messages from one writer to any number of readers, each at its own pace, in bounded memory.
/// Topics hold their newest message only; the log holds the last few of all that were appended. A
/// slow reader misses messages, nobody waits for it. All calls are thread-safe.
class MessageBoard {
 public:
  using Bytes = std::vector<std::uint8_t>;
  using Message = std::shared_ptr<const Bytes>;

  /// What a reader has got already. A new one gets all that is there.
  struct Cursor {
    std::uint64_t logged = 0;
    std::vector<std::uint64_t> versions;  ///< Per topic.
    std::size_t turn = 0;                 ///< Topic to be looked at first.
  };

  MessageBoard(std::size_t topics, std::size_t log_capacity);

  void Put(std::size_t topic, Bytes bytes);
  void Append(Bytes bytes);

  /// @return What the reader should get next, null if it is up to date. Topic 0 comes before the
  /// log, the log before the other topics, those in turn.
  [[nodiscard]] Message Next(Cursor& cursor) const;

 private:
  struct Topic {
    std::uint64_t version = 0;
    Message message;
  };

  [[nodiscard]] Message NextOf(std::size_t topic, Cursor& cursor) const;

  const std::size_t log_capacity_;
  mutable std::mutex mutex_;
  std::vector<Topic> topics_;
  std::deque<Message> log_;
  std::uint64_t appended_ = 0;
};

}  // namespace disflow::posix
