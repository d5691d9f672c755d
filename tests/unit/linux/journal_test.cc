// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/posix/journal.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cerrno>
#include <cstdlib>
#include <string>

#include "journal_reader.h"
#include "named_datagrams.h"

namespace disflow::posix {
namespace {

using test::ReadJournalEntry;

TEST(JournalEntry, TextsNumbersAndLineBreaks_AreReadAsTheyWere) {
  JournalEntry entry;
  entry.Add("MESSAGE", "two\nlines").Add("PRIORITY", 3).Add("DISFLOW_OBJECT", "a=b\xff");
  const auto fields = ReadJournalEntry(entry.bytes());
  ASSERT_TRUE(fields.has_value());
  EXPECT_EQ(fields->at("MESSAGE"), "two\nlines");
  EXPECT_EQ(fields->at("PRIORITY"), "3");
  EXPECT_EQ(fields->at("DISFLOW_OBJECT"), "a=b\xff");
}

TEST(JournalEntry, ValuesOfAnyLength_NeverBreakTheForm) {
  for (const char filling : {'x', '\n'}) {
    for (std::size_t length = 0; length < 2200; length += 7) {
      JournalEntry entry;
      entry.Add("PRIORITY", 6).Add("MESSAGE", std::string(length, filling)).Add("LAST", "z");
      const auto fields = ReadJournalEntry(entry.bytes());
      ASSERT_TRUE(fields.has_value()) << length;
      EXPECT_EQ(fields->at("PRIORITY"), "6");
      if (length < 1900) {
        EXPECT_EQ(fields->at("MESSAGE").size(), length);
        EXPECT_EQ(fields->at("LAST"), "z");
      }
    }
  }
}

TEST(UnixDatagrams, SocketThatIsNotRead_IsNotWaitedFor) {
  const std::string name = "@disflow-journal-" + std::to_string(::getpid());
  const test::NamedDatagrams reader(name);
  UnixDatagrams sender(name);
  ASSERT_TRUE(sender.is_open());
  int error = 0;
  for (int i = 0; i < 100'000 && error == 0; ++i) error = sender.Send("MESSAGE=x\n");
  EXPECT_EQ(error, EAGAIN);
  EXPECT_FALSE(reader.Received().empty());
  EXPECT_EQ(sender.Send("MESSAGE=y\n"), 0);
}

TEST(UnixDatagrams, NamesThatAreNone_GiveNobodyToSendTo) {
  for (const std::string& name : {std::string(), std::string("x"), std::string("relative/path"),
                                  std::string("@"), "/" + std::string(500, 'x')})
    EXPECT_FALSE(UnixDatagrams(name).is_open()) << name;
}

TEST(StandardErrorIsJournal, OnlyTheStreamThatIsNamed_IsIt) {
  struct stat info {};
  ASSERT_EQ(::fstat(STDERR_FILENO, &info), 0);
  const std::string own = std::to_string(info.st_dev) + ":" + std::to_string(info.st_ino);
  ::setenv("JOURNAL_STREAM", own.c_str(), 1);
  EXPECT_TRUE(StandardErrorIsJournal());
  for (const std::string& other :
       {std::string(), std::string(":"), std::string("1"), std::string("1:"), own + "1", own + " ",
        "9" + own, std::string("99999999999999999999999:1"), std::string("-1:2")}) {
    ::setenv("JOURNAL_STREAM", other.c_str(), 1);
    EXPECT_FALSE(StandardErrorIsJournal()) << other;
  }
  ::unsetenv("JOURNAL_STREAM");
  EXPECT_FALSE(StandardErrorIsJournal());
}

}  // namespace
}  // namespace disflow::posix
