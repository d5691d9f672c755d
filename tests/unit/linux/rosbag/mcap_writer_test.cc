// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/posix/rosbag/mcap_writer.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <zlib.h>

#include <cstring>

#include "mcap_reader.h"
#include "scratch_dir.h"

namespace disflow::posix {
namespace {

namespace fs = std::filesystem;

const std::vector<McapChannel> kChannels = {{"/a", "std_msgs/msg/String", "string data\n"},
                                            {"/b", "std_msgs/msg/String", "string data\n"}};

std::vector<std::uint8_t> MessageOf(int number, std::size_t size) {
  std::vector<std::uint8_t> message(size, static_cast<std::uint8_t>(number));
  message.front() = 0;
  return message;
}

/// Messages of a topic until the end; faults end it too.
std::vector<std::vector<std::uint8_t>> ReadAll(const fs::path& file, const std::string& topic,
                                               std::string& note) {
  McapReader reader;
  const hal::Fault opened = reader.Open(file, topic);
  EXPECT_TRUE(opened.ok()) << opened.message;
  note = reader.note();
  std::vector<std::vector<std::uint8_t>> all;
  for (BagMessage message;;) {
    const hal::Fault fault = reader.Next(message);
    if (!fault.ok()) {
      EXPECT_EQ(fault.status, Status::kEndOfStream) << fault.message;
      return all;
    }
    EXPECT_EQ(message.type, "std_msgs/msg/String");
    all.emplace_back(message.data.begin(), message.data.end());
  }
}

class McapWriterTest : public testing::Test {
 protected:
  [[nodiscard]] fs::path file() const { return dir_.path() / "run.mcap"; }

  apps::ScratchDir dir_;
};

TEST_F(McapWriterTest, EveryMessage_ComesBackInOrder) {
  McapWriter writer;
  ASSERT_TRUE(writer.Open(file(), kChannels).ok());
  constexpr int kChunks = 50;
  for (int k = 0; k < kChunks; ++k) {
    writer.Add(0, 1000 + k, MessageOf(2 * k, 100));
    writer.Add(1, 1000 + k, MessageOf(2 * k + 1, 7));
    ASSERT_TRUE(writer.WriteChunk().ok());
  }
  ASSERT_TRUE(writer.Close().ok());
  std::string note;
  const auto a = ReadAll(file(), "/a", note);
  EXPECT_EQ(note, "");
  const auto b = ReadAll(file(), "/b", note);
  ASSERT_EQ(a.size(), std::size_t{kChunks});
  ASSERT_EQ(b.size(), std::size_t{kChunks});
  for (int k = 0; k < kChunks; ++k) {
    EXPECT_EQ(a[static_cast<std::size_t>(k)], MessageOf(2 * k, 100));
    EXPECT_EQ(b[static_cast<std::size_t>(k)], MessageOf(2 * k + 1, 7));
  }
}

TEST_F(McapWriterTest, ChunksWithoutAnEnd_ReadAllTheSame) {
  McapWriter writer;
  ASSERT_TRUE(writer.Open(file(), kChannels).ok());
  writer.Add(0, 1, MessageOf(3, 100));
  ASSERT_TRUE(writer.WriteChunk().ok());
  writer.Add(0, 2, MessageOf(4, 100));
  std::string note;
  EXPECT_EQ(ReadAll(file(), "/a", note).size(), 1U) << "what is handed over is there";
  EXPECT_NE(note, "");
}

/// So many that the index is written in several pieces.
TEST_F(McapWriterTest, SummaryOfManyChunks_HasTheRightChecksum) {
  McapWriter writer;
  ASSERT_TRUE(writer.Open(file(), kChannels).ok());
  for (int k = 0; k < 3000; ++k) {
    writer.Add(static_cast<std::size_t>(k % 2), k, MessageOf(k, 4));
    ASSERT_TRUE(writer.WriteChunk().ok());
  }
  ASSERT_TRUE(writer.Close().ok());
  std::ifstream stream(file(), std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(stream), {}};
  constexpr std::size_t kEnd = 8 + 4;  // the last bytes and the checksum
  std::uint64_t begin = 0;
  std::memcpy(&begin, bytes.data() + bytes.size() - kEnd - 16, sizeof(begin));
  std::uint32_t checksum = 0;
  std::memcpy(&checksum, bytes.data() + bytes.size() - kEnd, sizeof(checksum));
  ASSERT_LT(begin, bytes.size() - kEnd);
  EXPECT_GT(bytes.size() - begin, std::size_t{2} * 65536);
  EXPECT_EQ(checksum, ::crc32(0, reinterpret_cast<const Bytef*>(bytes.data() + begin),
                              static_cast<uInt>(bytes.size() - kEnd - begin)));
}

TEST_F(McapWriterTest, FileThatIsThere_IsRefusedAndUnchanged) {
  const fs::path there = dir_.Write("run.mcap", "precious");
  McapWriter writer;
  const hal::Fault fault = writer.Open(there, kChannels);
  EXPECT_EQ(fault.status, Status::kBusy) << fault.message;
  EXPECT_NE(std::string(fault.message).find("run.mcap"), std::string::npos);
  EXPECT_FALSE(writer.WriteChunk().ok());
  EXPECT_FALSE(writer.Close().ok());
  EXPECT_EQ(fs::file_size(there), 8U);
}

TEST_F(McapWriterTest, ChunkThatFindsNoRoom_IsTakenBackAndNothingFollows) {
  McapWriter writer;
  ASSERT_TRUE(writer.Open(file(), kChannels).ok());
  rlimit before{};
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
  const auto handler = ::signal(SIGXFSZ, SIG_IGN);
  rlimit limit = before;
  limit.rlim_cur = 50'000;
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &limit), 0);
  int written = 0;
  hal::Fault fault;
  while (fault.ok()) {
    writer.Add(0, written, MessageOf(written, 20'000));
    fault = writer.WriteChunk();
    if (fault.ok()) ++written;
  }
  const std::uintmax_t size = fs::file_size(file());
  writer.Add(0, written, MessageOf(1, 10));
  EXPECT_FALSE(writer.WriteChunk().ok()) << "even if it had room";
  EXPECT_FALSE(writer.Close().ok());
  (void)::setrlimit(RLIMIT_FSIZE, &before);
  (void)::signal(SIGXFSZ, handler);
  EXPECT_EQ(written, 2);
  EXPECT_EQ(fs::file_size(file()), size);
  std::string note;
  EXPECT_EQ(ReadAll(file(), "/a", note).size(), 2U);
}

}  // namespace
}  // namespace disflow::posix
