// SPDX-License-Identifier: BSD-3-Clause
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "disflow/posix/signing_key_file.h"
#include "disflow/posix/signing_time_file.h"

namespace disflow::posix {
namespace {

using hal::Fault;
using hal::mavlink::SigningKey;

class SigningFilesTest : public ::testing::Test {
 protected:
  SigningFilesTest() {
    std::string name = ::testing::TempDir() + "disflow_signing_XXXXXX";
    if (::mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary folder");
    folder_ = name;
    path_ = folder_ / "secret.key";
  }
  ~SigningFilesTest() override {
    std::error_code error;
    std::filesystem::remove_all(folder_, error);
  }
  void Write(std::string_view bytes, mode_t mode = 0600) const {
    std::filesystem::remove(path_);
    std::ofstream(path_, std::ios::binary)
        .write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    ASSERT_EQ(::chmod(path_.c_str(), mode), 0);
  }
  [[nodiscard]] Fault Read() { return ReadSigningKey(path_, key_); }
  /// Refused with words that name the file and hold `says`, but nothing of what is in it.
  void ExpectRefused(Status status, const std::string& says) {
    const Fault fault = Read();
    const std::string message = fault.message;
    EXPECT_EQ(fault.status, status) << message;
    EXPECT_NE(message.find(path_), std::string::npos) << message;
    EXPECT_NE(message.find(says), std::string::npos) << message;
    EXPECT_EQ(message.find("0123456789"), std::string::npos) << message;
    EXPECT_EQ(key_, SigningKey{});
  }

  std::filesystem::path folder_;
  std::string path_;
  SigningKey key_{};
};

/// 64 digits, which mean 01 23 45 … over and over.
std::string Hex() {
  std::string text;
  for (int i = 0; i < 4; ++i) text += "0123456789abcdEF";
  return text;
}
SigningKey Meaning() {
  constexpr std::array<unsigned, 8> kBytes{0x01, 0x23, 0x45, 0x67, 0x89, 0xab, 0xcd, 0xef};
  SigningKey key{};
  for (std::size_t i = 0; i < key.size(); ++i) key[i] = static_cast<std::byte>(kBytes[i % 8]);
  return key;
}

TEST_F(SigningFilesTest, KeyOf32Bytes_IsTakenAsItIs) {
  const SigningKey key = Meaning();
  Write({reinterpret_cast<const char*>(key.data()), key.size()});
  EXPECT_TRUE(Read().ok()) << Read().message;
  EXPECT_EQ(key_, key);
}

TEST_F(SigningFilesTest, KeyOf64HexDigits_MayEndInALinesEnd) {
  for (const char* const end : {"", "\n", "\r\n"}) {
    key_ = {};
    Write(Hex() + end, 0400);
    EXPECT_TRUE(Read().ok()) << Read().message;
    EXPECT_EQ(key_, Meaning());
  }
}

TEST_F(SigningFilesTest, KeyThatOthersMayAccess_IsRefusedWithTheRemedy) {
  for (const mode_t mode : {0640U, 0604U, 0644U, 0620U, 0602U, 0610U, 0601U}) {
    Write(Hex(), mode);
    ExpectRefused(Status::kPermissionDenied, "chmod 600");
  }
}

TEST_F(SigningFilesTest, WhatIsNoKey_IsRefusedByName) {
  std::string not_hex = Hex();
  not_hex[63] = 'g';
  for (const std::string& text :
       {std::string(), std::string(31, 'k'), std::string(33, 'k'), Hex().substr(1), Hex() + "0",
        Hex() + "\n\n", Hex() + " ", not_hex, std::string(1'000'000, '0')}) {
    Write(text);
    ExpectRefused(Status::kCorrupt, "32 bytes");
  }
  for (const std::string& text : {std::string(32, '\0'), std::string(64, '0')}) {
    Write(text);
    ExpectRefused(Status::kCorrupt, "zero");
  }
}

TEST_F(SigningFilesTest, NoFile_IsRefusedByName) {
  ExpectRefused(Status::kNotFound, "signing key");
}

TEST_F(SigningFilesTest, FolderOrPipe_IsRefusedAtOnce) {
  ASSERT_EQ(::mkfifo(path_.c_str(), 0600), 0);
  ExpectRefused(Status::kUnsupported, "ordinary file");
  std::filesystem::remove(path_);
  std::filesystem::create_directory(path_);
  ExpectRefused(Status::kUnsupported, "ordinary file");
}

TEST_F(SigningFilesTest, KeptTime_IsThereAfterARestart) {
  for (const std::uint64_t time : {5U, 7U, 8U, 1000U}) {
    SigningTimeFile file;
    ASSERT_TRUE(file.Open(path_).ok());
    EXPECT_TRUE(file.Save(time));
    SigningTimeFile again;
    ASSERT_TRUE(again.Open(path_).ok());
    EXPECT_EQ(again.Load(), time);
  }
  struct stat info {};
  ASSERT_EQ(::stat(path_.c_str(), &info), 0);
  EXPECT_EQ(info.st_mode & 0777, 0600U);
  EXPECT_EQ(info.st_size, 32) << "the file must not grow";
}

TEST_F(SigningFilesTest, WriteThatACrashCutAnywhere_CostsTheLastTimeOnly) {
  // The complement's last three bytes never change.
  for (off_t cut = 0; cut < 13; ++cut) {
    std::filesystem::remove(path_);
    SigningTimeFile file;
    ASSERT_TRUE(file.Open(path_).ok());
    ASSERT_TRUE(file.Save(0x0102030405));
    ASSERT_TRUE(file.Save(0x1112131415));
    const int fd = ::open(path_.c_str(), O_RDWR | O_CLOEXEC);
    // The third overwrites the first; its bytes from `cut` on never arrive.
    std::array<char, 16> old{};
    ASSERT_EQ(::pread(fd, old.data(), old.size(), 0), 16);
    ASSERT_TRUE(file.Save(0x2122232425));
    ASSERT_EQ(::pwrite(fd, old.data() + cut, old.size() - static_cast<std::size_t>(cut), cut),
              16 - cut);
    ::close(fd);
    SigningTimeFile again;
    ASSERT_TRUE(again.Open(path_).ok());
    EXPECT_EQ(again.Load(), 0x1112131415U) << cut;
    ASSERT_TRUE(again.Save(0x3132333435)) << "the whole copy must stay";
    EXPECT_EQ(again.Load(), 0x3132333435U);
  }
}

TEST_F(SigningFilesTest, TimeFileWithGarbageOrNone_SaysNothing) {
  SigningTimeFile none;
  EXPECT_EQ(none.Load(), 0U);
  EXPECT_FALSE(none.Save(1));
  Write(std::string(100, 'x'));
  SigningTimeFile garbage;
  ASSERT_TRUE(garbage.Open(path_).ok());
  EXPECT_EQ(garbage.Load(), 0U);
  Write("short");
  ASSERT_TRUE(garbage.Open(path_).ok());
  EXPECT_EQ(garbage.Load(), 0U);
}

TEST_F(SigningFilesTest, TimeFileThatCannotBeMade_IsSaidByName) {
  SigningTimeFile file;
  const Fault fault = file.Open((folder_ / "none" / "time").string());
  EXPECT_FALSE(fault.ok());
  EXPECT_NE(std::string(fault.message).find("none/time"), std::string::npos) << fault.message;
}

}  // namespace
}  // namespace disflow::posix
