// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/posix/view/message_board.h"

#include <gtest/gtest.h>

#include <string>

namespace disflow::posix {
namespace {

std::string Next(const MessageBoard& board, MessageBoard::Cursor& cursor) {
  const MessageBoard::Message message = board.Next(cursor);
  return message == nullptr ? "" : std::string(message->begin(), message->end());
}

TEST(MessageBoard, NewReader_GetsGreetingThenLogThenTopics) {
  MessageBoard board(3, 4);
  board.Put(2, {'t'});
  board.Append({'a'});
  board.Append({'b'});
  board.Put(0, {'h'});
  MessageBoard::Cursor cursor;
  EXPECT_EQ(Next(board, cursor), "h");
  EXPECT_EQ(Next(board, cursor), "a");
  EXPECT_EQ(Next(board, cursor), "b");
  EXPECT_EQ(Next(board, cursor), "t");
  EXPECT_EQ(Next(board, cursor), "");
}

TEST(MessageBoard, SlowReader_GetsTheNewestOfATopicAndTheLastOfTheLog) {
  MessageBoard board(2, 2);
  MessageBoard::Cursor cursor;
  for (const char name : {'a', 'b', 'c', 'd'}) {
    board.Append({static_cast<std::uint8_t>(name)});
    board.Put(1, {static_cast<std::uint8_t>(name - 'a' + 'A')});
  }
  EXPECT_EQ(Next(board, cursor), "c");
  EXPECT_EQ(Next(board, cursor), "d");
  EXPECT_EQ(Next(board, cursor), "D");
  EXPECT_EQ(Next(board, cursor), "");
}

TEST(MessageBoard, TopicsThatAllHaveNews_TakeTurns) {
  MessageBoard board(3, 1);
  MessageBoard::Cursor cursor;
  std::string seen;
  for (int i = 0; i < 4; ++i) {
    board.Put(1, {'x'});
    board.Put(2, {'y'});
    seen += Next(board, cursor);
  }
  EXPECT_EQ(seen, "xyxy");
}

TEST(MessageBoard, MessageThatIsBeingRead_OutlivesItsReplacement) {
  MessageBoard board(1, 1);
  MessageBoard::Cursor cursor;
  board.Put(0, {'o', 'l', 'd'});
  const MessageBoard::Message held = board.Next(cursor);
  board.Put(0, {'n', 'e', 'w'});
  EXPECT_EQ(std::string(held->begin(), held->end()), "old");
}

}  // namespace
}  // namespace disflow::posix
