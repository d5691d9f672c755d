// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/hal/mavlink/command_input.h"

#include <gtest/gtest.h>

#include <vector>

#include "message_line.h"

namespace disflow::hal::mavlink {
namespace {

std::vector<std::byte> Encoded(const CommandLong& command) {
  std::vector<std::byte> bytes(kMaxFrameSize);
  const auto size =
      EncodeFrame(command, {.sequence = 1, .system_id = 255, .component_id = 7}, bytes);
  EXPECT_TRUE(size.ok());
  bytes.resize(size.value);
  return bytes;
}

CommandLong ToUs(std::uint16_t id) {
  CommandLong command;
  command.param = {0.25F, 0.5F, 0.75F, 1.0F, 1.25F, 1.5F, 1.75F};
  command.command = id;
  command.target_system = 190;
  command.target_component = 26;
  command.confirmation = 2;
  return command;
}

TEST(CommandInput, Commands_WaitInOrderWithTheirSender) {
  CommandInput input;
  test::MessageLine line(input);
  line.Deliver(Encoded(ToUs(2004)));
  line.Deliver(Encoded(ToUs(2005)));
  ASSERT_EQ(input.waiting().size(), 2);
  EXPECT_EQ(input.waiting()[0].command.command, 2004);
  EXPECT_EQ(input.waiting()[1].command.command, 2005);
  const ReceivedCommand& first = input.waiting()[0];
  EXPECT_EQ(first.command.param, ToUs(0).param);
  EXPECT_EQ(first.command.target_component, 26);
  EXPECT_EQ(first.sender_system, 255);
  EXPECT_EQ(first.sender_component, 7);
}

TEST(CommandInput, CommandsToOthersAndToAll_AreNotOurs) {
  CommandInput input;
  test::MessageLine line(input);
  for (const int other : {0, 1, 189, 191, 255}) {
    CommandLong command = ToUs(2004);
    command.target_system = static_cast<std::uint8_t>(other);
    line.Deliver(Encoded(command));
  }
  EXPECT_TRUE(input.waiting().empty());
  EXPECT_EQ(input.dropped(), 0U);
}

TEST(CommandInput, MoreThanFit_AreDroppedAndCounted) {
  CommandInput input;
  test::MessageLine line(input);
  for (int i = 0; i < 10; ++i) line.Deliver(Encoded(ToUs(2004)));
  EXPECT_EQ(input.waiting().size(), CommandInput::kMaxWaiting);
  EXPECT_EQ(input.dropped(), 10U - CommandInput::kMaxWaiting);
  input.Clear();
  line.Deliver(Encoded(ToUs(2005)));
  ASSERT_EQ(input.waiting().size(), 1);
}

TEST(CommandInput, Answer_GoesToWhoGaveTheCommand) {
  const CommandAck ack = AnswerTo({ToUs(2004), 255, 7}, CommandAck::kDenied);
  EXPECT_EQ(ack.command, 2004);
  EXPECT_EQ(ack.result, CommandAck::kDenied);
  EXPECT_EQ(ack.target_system, 255);
  EXPECT_EQ(ack.target_component, 7);
}

}  // namespace
}  // namespace disflow::hal::mavlink
