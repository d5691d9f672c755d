// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <map>
#include <string>
#include <thread>
#include <vector>

#include "program/console.h"
#include "program/exit_status.h"
#include "program/log_writer.h"
#include "program/status_token.h"

namespace disflow::apps {
namespace {

TEST(StatusToken, EveryStatus_HasAWordOfItsOwn) {
  std::map<std::string, int> seen;
  const std::string no_description = Describe(static_cast<Status>(255));
  for (int value = 0; value < 256; ++value) {
    const auto status = static_cast<Status>(value);
    const std::string token = StatusToken(status);
    EXPECT_EQ(token == "unknown", Describe(status) == no_description) << value;
    if (token == "unknown") continue;
    EXPECT_EQ(token.find_first_not_of("abcdefghijklmnopqrstuvwxyz_"), std::string::npos) << token;
    EXPECT_TRUE(seen.emplace(token, value).second) << token << " is also " << seen[token];
  }
  EXPECT_STREQ(StatusToken(Status::kOk), "ok");
}

/// Standard error as a pipe that the test reads when it likes.
class StandardErrorPipe {
 public:
  StandardErrorPipe() {
    int ends[2] = {-1, -1};
    EXPECT_EQ(::pipe(ends), 0);
    reader_ = ends[0];
    saved_ = ::dup(STDERR_FILENO);
    ::dup2(ends[1], STDERR_FILENO);
    ::close(ends[1]);
  }
  ~StandardErrorPipe() {
    Restore();
    ::close(reader_);
  }
  /// The writing end is closed.
  void Restore() {
    if (saved_ < 0) return;
    ::dup2(saved_, STDERR_FILENO);
    ::close(saved_);
    saved_ = -1;
  }
  /// All there is, until the writing end is closed.
  [[nodiscard]] std::string ReadAll() const {
    std::string text;
    char piece[4096];
    for (ssize_t size = 0; (size = ::read(reader_, piece, sizeof(piece))) > 0;) {
      text.append(piece, static_cast<std::size_t>(size));
    }
    return text;
  }

 private:
  int reader_ = -1;
  int saved_ = -1;
};

TEST(LogWriter, EndOfTheProgram_LosesNothingThatWasTaken) {
  std::string text;
  {
    StandardErrorPipe pipe;
    {
      LogTarget target("text");
      LogWriter writer(target);
      for (int i = 0; i < 50; ++i) writer.Push("line " + std::to_string(i) + "\n");
    }
    pipe.Restore();
    text = pipe.ReadAll();
  }
  std::string expected;
  for (int i = 0; i < 50; ++i) expected += "line " + std::to_string(i) + "\n";
  EXPECT_EQ(text, expected);
}

TEST(LogWriter, ReaderThatDoesNotRead_HoldsUpNobodyAndEveryLossIsCounted) {
  constexpr int kPushed = 1000;  // of 1 kB: far more than a pipe holds and the writer keeps
  StandardErrorPipe pipe;
  std::string text;
  std::thread reader;
  {
    LogTarget target("text");
    LogWriter writer(target);
    for (int i = 0; i < kPushed; ++i) writer.Push(std::string(1000, 'x') + "\n");
    // Had Push() waited, this would not be reached.
    reader = std::thread([&] { text = pipe.ReadAll(); });
  }
  pipe.Restore();
  reader.join();
  std::uint64_t lines = 0;
  std::uint64_t lost = 0;
  for (std::size_t begin = 0; begin < text.size(); begin = text.find('\n', begin) + 1) {
    constexpr const char* kLoss = "disflow_track: ";
    if (text.compare(begin, 15, kLoss) == 0) {
      lost += std::stoull(text.substr(begin + 15));
    } else {
      ++lines;
    }
  }
  EXPECT_GT(lost, 0U);
  EXPECT_EQ(lines + lost, kPushed);
}

TEST(LogWriter, TextTooLong_IsCutAndStaysALine) {
  StandardErrorPipe pipe;
  {
    LogTarget target("text");
    LogWriter writer(target);
    writer.Push(std::string(5000, 'x') + "\n");
    writer.Push("next\n");
  }
  pipe.Restore();
  const std::string text = pipe.ReadAll();
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 2);
  EXPECT_EQ(text.substr(text.size() - 6), "\nnext\n");
}

TEST(Console, MessageOfAnyLength_IsSaidWholeOnOneLine) {
  for (const std::size_t length :
       std::vector<std::size_t>{0, 1, 1000, 1007, 1008, 1009, 1010, 1024, 5000}) {
    const std::string message(length, 'x');
    testing::internal::CaptureStderr();
    Console(false).Say(message);
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "disflow_track: " + message + "\n") << length;
  }
}

TEST(Console, PercentSigns_AreNoFormat) {
  testing::internal::CaptureStderr();
  Console(false).Say("%s%n 100 %");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "disflow_track: %s%n 100 %\n");
}

TEST(Console, ManyThreads_DoNotMixTheirLines) {
  constexpr int kThreads = 4;
  constexpr int kLines = 200;
  testing::internal::CaptureStderr();
  {
    Console console(false);
    std::vector<std::thread> threads;
    for (int i = 0; i < kThreads; ++i) {
      threads.emplace_back([&console, i] {
        for (int line = 0; line < kLines; ++line)
          console.Say(std::string(200, static_cast<char>('a' + i)));
      });
    }
    for (std::thread& thread : threads) thread.join();
  }
  const std::string text = testing::internal::GetCapturedStderr();
  int lines = 0;
  for (std::size_t begin = 0; begin < text.size(); ++lines) {
    const std::size_t end = text.find('\n', begin);
    const std::string line = text.substr(begin, end - begin);
    ASSERT_EQ(line, "disflow_track: " + std::string(200, line.back()));
    begin = end + 1;
  }
  EXPECT_EQ(lines, kThreads * kLines);
}

TEST(Console, NoTerminal_ShowsNoLiveLine) {
  testing::internal::CaptureStderr();
  {
    Console console(true);
    std::array<FrameResult, 1> results;
    for (std::int64_t now_ns = 1; now_ns < 2'000'000'000; now_ns += 50'000'000)
      console.Show(results, now_ns);
  }
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST(Failure, CarriesItsStatusAndItsWords) {
  try {
    throw Failure(kOutputFailed, "disk full");
  } catch (const std::exception& error) {
    EXPECT_STREQ(error.what(), "disk full");
    EXPECT_EQ(dynamic_cast<const Failure&>(error).status(), 4);
  }
}

}  // namespace
}  // namespace disflow::apps
