// SPDX-License-Identifier: BSD-3-Clause
#include "client_frames.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace disflow::posix {
namespace {

constexpr unsigned char kBinary = 0x82;
constexpr std::string_view kMask = "\x11\xA5\x7F\xE0";

std::string Masked(unsigned char first, std::string_view payload) {
  std::string frame = {static_cast<char>(first), static_cast<char>(0x80U | payload.size())};
  frame += kMask;
  for (std::size_t i = 0; i < payload.size(); ++i)
    frame += static_cast<char>(payload[i] ^ kMask[i % 4]);
  return frame;
}
std::string Unmasked(unsigned char first, std::string_view payload) {
  return std::string{static_cast<char>(first), static_cast<char>(payload.size())} +
         std::string(payload);
}

struct Taken {
  ClientFrame frame;
  std::string payload;
  bool operator==(const Taken&) const = default;
};

/// All that is in `bytes`, which arrive so many at a time.
std::vector<Taken> TakeAll(std::string_view bytes, std::size_t at_a_time = 1000) {
  ClientFrames frames;
  std::vector<Taken> all;
  for (; !bytes.empty(); bytes.remove_prefix(std::min(at_a_time, bytes.size()))) {
    const std::string_view piece = bytes.substr(0, at_a_time);
    std::span<const std::uint8_t> rest(reinterpret_cast<const std::uint8_t*>(piece.data()),
                                       piece.size());
    while (const auto frame = frames.Take(rest))
      all.push_back({*frame, {frames.payload().begin(), frames.payload().end()}});
  }
  return all;
}

ClientFrame First(std::string_view bytes) {
  const std::vector<Taken> all = TakeAll(bytes);
  EXPECT_FALSE(all.empty());
  return all.empty() ? ClientFrame::kMessage : all.front().frame;
}

TEST(ClientFrames, MaskedFrames_AreReadHoweverTheyArrive) {
  const std::string longest(125, 'x');
  const std::string bytes = Masked(kBinary, "four") + Masked(0x89, "") + Masked(0x8A, longest) +
                            Masked(kBinary, "fourteen bytes") + Masked(0x88, "\x03\xE8");
  const std::vector<Taken> expected{{ClientFrame::kMessage, "four"},
                                    {ClientFrame::kPing, ""},
                                    {ClientFrame::kPong, longest},
                                    {ClientFrame::kMessage, "fourteen bytes"},
                                    {ClientFrame::kClose, "\x03\xE8"}};
  for (std::size_t at_a_time = 1; at_a_time <= bytes.size(); ++at_a_time)
    EXPECT_EQ(TakeAll(bytes, at_a_time), expected) << at_a_time;
}

TEST(ClientFrames, UnmaskedFrames_AreMalformedWhateverTheyAre) {
  for (unsigned first = 0; first < 256; ++first) {
    for (const std::string_view payload : {"", "four", "fourteen bytes"}) {
      EXPECT_EQ(First(Unmasked(static_cast<unsigned char>(first), payload)),
                ClientFrame::kMalformed)
          << first;
    }
  }
}

TEST(ClientFrames, UnmaskedFrameBehindMaskedOnes_IsMalformed) {
  EXPECT_EQ(TakeAll(Masked(kBinary, "four") + Unmasked(kBinary, "f"))[1].frame,
            ClientFrame::kMalformed);
}

TEST(ClientFrames, ReservedBitsOpcodesAndBrokenControlFrames_AreMalformed) {
  for (const int first : {0xC2, 0xA2, 0x92, 0x83, 0x87, 0x8B, 0x8F, 0x09, 0x08})
    EXPECT_EQ(First(Masked(static_cast<unsigned char>(first), "four")), ClientFrame::kMalformed)
        << first;
  EXPECT_EQ(First("\x89\xFE\x01"), ClientFrame::kMalformed);
}

TEST(ClientFrames, TextPiecesAndLongMessages_AreNotAllowed) {
  for (const int first : {0x81, 0x01, 0x02, 0x80})
    EXPECT_EQ(First(Masked(static_cast<unsigned char>(first), "four")), ClientFrame::kNotAllowed)
        << first;
  EXPECT_EQ(First("\x82\xFE\x01"), ClientFrame::kNotAllowed);
  EXPECT_EQ(First("\x82\xFF\x01"), ClientFrame::kNotAllowed);
}

}  // namespace
}  // namespace disflow::posix
