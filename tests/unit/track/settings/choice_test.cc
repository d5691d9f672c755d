// SPDX-License-Identifier: BSD-3-Clause
#include "settings/choice.h"

#include <gtest/gtest.h>

namespace disflow::apps {
namespace {

enum class Colour : std::uint8_t { kRed = 3, kBlue = 200 };
const std::map<std::string, Colour> kColours = {{"red", Colour::kRed}, {"blue", Colour::kBlue}};

class ChoiceTest : public ::testing::Test {
 protected:
  /// What is said of `--colour WORD`; empty if it is taken.
  std::string Parse(const std::string& word) {
    CLI::App app;
    app.add_option("--colour", colour_)->transform(Choice(kColours));
    try {
      app.parse("--colour " + word);
    } catch (const CLI::ParseError& error) {
      return error.what();
    }
    return {};
  }
  Colour colour_ = Colour::kRed;
};

TEST_F(ChoiceTest, EachWord_IsTaken) {
  EXPECT_EQ(Parse("blue"), "");
  EXPECT_EQ(colour_, Colour::kBlue);
  EXPECT_EQ(Parse("red"), "");
  EXPECT_EQ(colour_, Colour::kRed);
}

TEST_F(ChoiceTest, AnythingElse_IsRefusedWithTheWordsThereAre) {
  for (const char* word : {"Red", "green", "3", "0"})
    EXPECT_EQ(Parse(word), std::string("--colour: '") + word + "' is none of blue, red");
}

}  // namespace
}  // namespace disflow::apps
