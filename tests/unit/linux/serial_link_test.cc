// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/posix/serial_link.h"

#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>

#include "byte_text.h"
#include "disflow/hal/mavlink/frame_decoder.h"
#include "pty.h"

namespace disflow::posix::testing {
namespace {

hal::LinkAddress AddressOf(const std::string& device, std::uint32_t baud = 115200) {
  hal::LinkAddress address;
  const hal::Fault fault =
      hal::ParseLinkAddress("serial://" + device + "?baud=" + std::to_string(baud), address);
  EXPECT_TRUE(fault.ok()) << fault.message;
  return address;
}

std::string AllByteValues() {
  std::string text(256, '\0');
  for (std::size_t i = 0; i < text.size(); ++i) text[i] = static_cast<char>(i);
  return text;
}

class OpenSerialLink : public ::testing::Test {
 protected:
  void SetUp() override {
    const hal::Fault fault = link.Open();
    ASSERT_TRUE(fault.ok()) << fault.message;
  }

  Pty pty;
  SerialLink link{AddressOf(pty.device())};
};

TEST_F(OpenSerialLink, Send_PassesEveryByteValueUnchanged) {
  ASSERT_TRUE(link.Send(BytesOf(AllByteValues())).ok());
  EXPECT_EQ(pty.ReadExactly(256), AllByteValues());
  EXPECT_EQ(link.counters().sent_messages, 1U);
  EXPECT_EQ(link.counters().sent_bytes, 256U);
}

TEST_F(OpenSerialLink, Receive_PassesEveryByteValueUnchanged) {
  ASSERT_TRUE(pty.Write(AllByteValues()));
  EXPECT_EQ(ReceivedText(link), AllByteValues());
  EXPECT_EQ(link.counters().received_bytes, 256U);
}

TEST_F(OpenSerialLink, ReceiveWithNothingThere_ReturnsAtOnceWithNothing) {
  std::array<std::byte, 8> buffer{};
  const auto size = link.Receive(buffer);
  EXPECT_TRUE(size.ok());
  EXPECT_EQ(size.value, 0U);
}

TEST_F(OpenSerialLink, Open_IsIdempotent) {
  EXPECT_TRUE(link.Open().ok());
  ASSERT_TRUE(link.Send(BytesOf("x")).ok());
  EXPECT_EQ(pty.Read(), "x");
}

TEST_F(OpenSerialLink, SecondUser_IsToldThatThePortIsBusy) {
  SerialLink second(AddressOf(pty.device()));
  const hal::Fault fault = second.Open();
  EXPECT_EQ(fault.status, Status::kBusy);
  EXPECT_NE(std::strstr(fault.message, pty.device().c_str()), nullptr) << fault.message;
  link.Close();
  EXPECT_TRUE(second.Open().ok());
}

TEST_F(OpenSerialLink, MessageBeyondTheLimit_IsRefusedAsAWhole) {
  EXPECT_EQ(link.Send(BytesOf(std::string(SerialLink::kMaxMessageSize + 1, 'x'))).status,
            Status::kIoError);
  ASSERT_TRUE(link.Send(BytesOf(std::string(SerialLink::kMaxMessageSize, 'y'))).ok());
  EXPECT_EQ(pty.ReadExactly(SerialLink::kMaxMessageSize),
            std::string(SerialLink::kMaxMessageSize, 'y'));
  EXPECT_EQ(link.counters().dropped_messages, 1U);
}

TEST_F(OpenSerialLink, SlowLine_DropsWholeMessagesOnly) {
  using namespace hal::mavlink;
  FrameDecoder decoder;
  FrameView frame;
  std::uint32_t would_block = 0;
  const auto decode = [&](const std::string& text) {
    auto bytes = BytesOf(text);
    while (!bytes.empty()) {
      bytes = bytes.subspan(decoder.Feed(bytes));
      while (decoder.Next(frame)) {
      }
    }
  };
  Odometry odometry;
  odometry.quality = 50;
  std::array<std::byte, kMaxFrameSize> buffer{};
  for (int i = 0; i < 3000; ++i) {
    odometry.time_usec = static_cast<std::uint64_t>(i + 1);
    const auto size = EncodeFrame(odometry, {}, buffer);
    const hal::Fault fault = link.Send(std::span(buffer).first(size.value));
    if (!fault.ok()) {
      ASSERT_EQ(fault.status, Status::kWouldBlock) << fault.message;
      ++would_block;
    }
    // The far end takes less than is sent, in pieces that fit no message.
    if (i % 7 == 0) decode(pty.ReadNow(101));
  }
  EXPECT_GT(would_block, 100U);
  EXPECT_EQ(link.counters().dropped_messages, would_block);
  const std::uint32_t accepted = 3000 - would_block;
  // Everything that Send() accepted comes out whole, the last message by the flush of a later Send.
  for (int i = 0; i < 100 && decoder.counters().frames < accepted; ++i) {
    decode(pty.ReadNow());
    (void)link.Send({});
  }
  EXPECT_EQ(decoder.counters().frames, accepted);
  EXPECT_EQ(decoder.counters().skipped_bytes, 0U);
}

TEST_F(OpenSerialLink, DeviceThatVanishesWhileSending_IsReportedByNameAndNeverCrashes) {
  ASSERT_TRUE(link.Send(BytesOf("before")).ok());
  pty.Vanish();
  const hal::Fault fault = link.Send(BytesOf("after"));
  EXPECT_EQ(fault.status, Status::kDeviceLost);
  EXPECT_NE(std::strstr(fault.message, pty.device().c_str()), nullptr) << fault.message;
  EXPECT_EQ(link.Send(BytesOf("later")).status, Status::kNotOpen);
  EXPECT_EQ(link.Open().status, Status::kNotFound);
  EXPECT_EQ(link.counters().sent_messages, 1U);
  EXPECT_EQ(link.counters().dropped_messages, 1U);
}

TEST_F(OpenSerialLink, DeviceThatVanishesWhileReceiving_IsReported) {
  pty.Vanish();
  std::array<std::byte, 8> buffer{};
  EXPECT_EQ(link.Receive(buffer).status, Status::kDeviceLost);
  EXPECT_EQ(link.Receive(buffer).status, Status::kNotOpen);
}

TEST_F(OpenSerialLink, ClosedLink_RefusesWork) {
  link.Close();
  link.Close();
  std::array<std::byte, 8> buffer{};
  EXPECT_EQ(link.Send(BytesOf("x")).status, Status::kNotOpen);
  EXPECT_EQ(link.Receive(buffer).status, Status::kNotOpen);
}

struct Rate {
  std::uint32_t baud;
  speed_t constant;

  friend void PrintTo(const Rate& rate, std::ostream* out) { *out << rate.baud; }
};

class SerialRate : public ::testing::TestWithParam<Rate> {};

/// False under QEMU's user-mode emulation, whose terminal calls do not know the fast rates.
bool SystemKnowsRate(speed_t constant) {
  const Pty pty;
  termios settings = pty.settings();
  (void)::cfsetspeed(&settings, constant);
  (void)::tcsetattr(pty.master(), TCSANOW, &settings);
  const termios actual = pty.settings();
  return ::cfgetospeed(&actual) == constant;
}

TEST_P(SerialRate, Open_SetsItAndCloseGivesBackTheOldSettings) {
  if (!SystemKnowsRate(GetParam().constant)) GTEST_SKIP() << "the system does not know this rate";
  const Pty pty;
  const termios before = pty.settings();
  SerialLink link(AddressOf(pty.device(), GetParam().baud));
  ASSERT_TRUE(link.Open().ok());
  const termios raw = pty.settings();
  EXPECT_EQ(::cfgetospeed(&raw), GetParam().constant);
  EXPECT_EQ(::cfgetispeed(&raw), GetParam().constant);
  EXPECT_EQ(raw.c_lflag & static_cast<tcflag_t>(ICANON | ECHO | ISIG), 0U);
  EXPECT_EQ(raw.c_oflag & static_cast<tcflag_t>(OPOST), 0U);
  link.Close();
  const termios after = pty.settings();
  EXPECT_EQ(::cfgetospeed(&after), ::cfgetospeed(&before));
  EXPECT_EQ(after.c_lflag, before.c_lflag);
  EXPECT_EQ(after.c_iflag, before.c_iflag);
  EXPECT_EQ(after.c_oflag, before.c_oflag);
  EXPECT_EQ(after.c_cflag, before.c_cflag);
}

INSTANTIATE_TEST_SUITE_P(SerialLink, SerialRate,
                         ::testing::Values(Rate{9600, B9600}, Rate{115200, B115200},
                                           Rate{460800, B460800}, Rate{921600, B921600},
                                           Rate{4000000, B4000000}),
                         [](const auto& rate) { return std::to_string(rate.param.baud); });

TEST(SerialLink, RateThatTheDriverDoesNotKeep_IsNamed) {
  if (SystemKnowsRate(B4000000)) GTEST_SKIP() << "this system keeps every rate";
  const Pty pty;
  SerialLink link(AddressOf(pty.device(), 4000000));
  const hal::Fault fault = link.Open();
  EXPECT_EQ(fault.status, Status::kUnsupported);
  EXPECT_NE(std::strstr(fault.message, "4000000"), nullptr) << fault.message;
}

TEST(SerialLink, RateThatIsNoStandardOne_IsNamed) {
  const Pty pty;
  SerialLink link(AddressOf(pty.device(), 123456));
  const hal::Fault fault = link.Open();
  EXPECT_EQ(fault.status, Status::kUnsupported);
  EXPECT_NE(std::strstr(fault.message, "123456"), nullptr) << fault.message;
}

TEST(SerialLink, MissingDevice_IsNotFound) {
  SerialLink link(AddressOf("/dev/disflow-no-such-port"));
  const hal::Fault fault = link.Open();
  EXPECT_EQ(fault.status, Status::kNotFound);
  EXPECT_NE(std::strstr(fault.message, "/dev/disflow-no-such-port"), nullptr) << fault.message;
}

TEST(SerialLink, FileThatIsNoTerminal_IsUnsupported) {
  SerialLink link(AddressOf("/dev/null"));
  EXPECT_EQ(link.Open().status, Status::kUnsupported);
}

TEST(SerialLink, DeviceThatComesBack_IsOpenedAgainAndCounted) {
  namespace fs = std::filesystem;
  // A name that stays while the device behind it changes, as udev's /dev/serial/by-id does.
  const fs::path name = fs::path(::testing::TempDir()) / ("tty" + std::to_string(::getpid()));
  fs::remove(name);
  Pty first;
  fs::create_symlink(first.device(), name);
  SerialLink link(AddressOf(name));
  ASSERT_TRUE(link.Open().ok());
  // Made before the first one goes, so that it gets a number of its own.
  const Pty second;
  first.Vanish();
  EXPECT_EQ(link.Send(BytesOf("x")).status, Status::kDeviceLost);
  EXPECT_FALSE(link.Open().ok());
  fs::remove(name);
  fs::create_symlink(second.device(), name);
  ASSERT_TRUE(link.Open().ok());
  EXPECT_TRUE(link.Send(BytesOf("back")).ok());
  EXPECT_EQ(second.Read(), "back");
  EXPECT_EQ(link.counters().reconnects, 1U);
  fs::remove(name);
}

}  // namespace
}  // namespace disflow::posix::testing
