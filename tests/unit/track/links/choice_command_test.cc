// SPDX-License-Identifier: BSD-3-Clause
#include "links/choice_command.h"

#include <gtest/gtest.h>

#include <limits>

namespace disflow::apps {
namespace {

using hal::mavlink::CommandLong;
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

CommandLong Command(std::uint16_t id, std::array<float, 4> parameters) {
  CommandLong command;
  command.param = {parameters[0], parameters[1], parameters[2], parameters[3], kNan, kNan, kNan};
  command.command = id;
  return command;
}

TEST(ChoiceCommand, Point_IsAPlaceAndItsReach) {
  const CommandLong command = Command(CommandLong::kCameraTrackPoint, {0.25F, 0.75F, 0.05F, kNan});
  EXPECT_TRUE(IsChoiceCommand(command));
  const auto choice = ChoiceOf(command);
  ASSERT_TRUE(choice.has_value());
  EXPECT_EQ(choice->kind, ObjectChoice::Kind::kPixel);
  EXPECT_EQ(choice->u, 0.25F);
  EXPECT_EQ(choice->v, 0.75F);
  EXPECT_EQ(choice->reach, 0.05F);
}

TEST(ChoiceCommand, RadiusThatIsNotSaid_IsNone) {
  const auto choice = ChoiceOf(Command(CommandLong::kCameraTrackPoint, {0.5F, 0.5F, kNan, kNan}));
  ASSERT_TRUE(choice.has_value());
  EXPECT_EQ(choice->reach, 0.0F);
}

TEST(ChoiceCommand, Rectangle_IsTheBoxBetweenItsCorners) {
  const auto choice =
      ChoiceOf(Command(CommandLong::kCameraTrackRectangle, {0.25F, 0.125F, 0.75F, 0.625F}));
  ASSERT_TRUE(choice.has_value());
  EXPECT_EQ(choice->kind, ObjectChoice::Kind::kBox);
  EXPECT_EQ(choice->u, 0.25F);
  EXPECT_EQ(choice->v, 0.125F);
  EXPECT_EQ(choice->width, 0.5F);
  EXPECT_EQ(choice->height, 0.5F);
}

TEST(ChoiceCommand, PlacesOutsideOfTheImage_AreNone) {
  for (const float wrong : {-0.1F, 1.1F, std::numeric_limits<float>::infinity(), kNan}) {
    EXPECT_FALSE(ChoiceOf(Command(CommandLong::kCameraTrackPoint, {wrong, 0.5F, 0.0F, 0.0F})));
    EXPECT_FALSE(ChoiceOf(Command(CommandLong::kCameraTrackPoint, {0.5F, wrong, 0.0F, 0.0F})));
    EXPECT_FALSE(ChoiceOf(Command(CommandLong::kCameraTrackRectangle, {0.1F, 0.1F, wrong, 0.5F})));
  }
  EXPECT_FALSE(ChoiceOf(Command(CommandLong::kCameraTrackPoint, {0.5F, 0.5F, 1.1F, 0.0F})));
  EXPECT_FALSE(ChoiceOf(Command(CommandLong::kCameraTrackRectangle, {0.5F, 0.5F, 0.5F, 0.9F})));
  EXPECT_FALSE(ChoiceOf(Command(CommandLong::kCameraTrackRectangle, {0.5F, 0.5F, 0.9F, 0.1F})));
}

TEST(ChoiceCommand, OtherCommands_ChooseNothing) {
  for (const std::uint16_t id : std::initializer_list<std::uint16_t>{0, 400, 2003, 2010})
    EXPECT_FALSE(IsChoiceCommand(Command(id, {0.5F, 0.5F, 0.0F, 0.0F})));
}

}  // namespace
}  // namespace disflow::apps
