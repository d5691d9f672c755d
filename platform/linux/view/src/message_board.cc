// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/posix/view/message_board.h"

#include <algorithm>
#include <utility>

namespace disflow::posix {

MessageBoard::MessageBoard(std::size_t topics, std::size_t log_capacity)
    : log_capacity_(log_capacity), topics_(topics) {}

void MessageBoard::Put(std::size_t topic, Bytes bytes) {
  auto message = std::make_shared<const Bytes>(std::move(bytes));
  const std::lock_guard lock(mutex_);
  ++topics_.at(topic).version;
  // What was there is freed by whoever lets go of it last, here after the lock.
  topics_[topic].message.swap(message);
}

void MessageBoard::Append(Bytes bytes) {
  auto message = std::make_shared<const Bytes>(std::move(bytes));
  const std::lock_guard lock(mutex_);
  log_.push_back(std::move(message));
  if (log_.size() > log_capacity_) log_.pop_front();
  ++appended_;
}

MessageBoard::Message MessageBoard::NextOf(std::size_t topic, Cursor& cursor) const {
  if (cursor.versions[topic] == topics_[topic].version) return nullptr;
  cursor.versions[topic] = topics_[topic].version;
  return topics_[topic].message;
}

MessageBoard::Message MessageBoard::Next(Cursor& cursor) const {
  const std::lock_guard lock(mutex_);
  cursor.versions.resize(topics_.size());
  if (Message message = NextOf(0, cursor)) return message;
  if (cursor.logged < appended_) {
    const std::uint64_t oldest = appended_ - log_.size();
    cursor.logged = std::max(cursor.logged, oldest);
    return log_[static_cast<std::size_t>(cursor.logged++ - oldest)];
  }
  for (std::size_t i = 0; i < topics_.size(); ++i) {
    cursor.turn = (cursor.turn + 1) % topics_.size();
    if (Message message = NextOf(cursor.turn, cursor)) return message;
  }
  return nullptr;
}

}  // namespace disflow::posix
