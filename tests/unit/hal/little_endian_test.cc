// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/hal/little_endian.h"

#include <gtest/gtest.h>

#include <array>
#include <limits>

namespace disflow::hal {
namespace {

using Bytes = std::array<std::byte, 8>;

constexpr Bytes kBytes{std::byte{0x01}, std::byte{0x23}, std::byte{0x45}, std::byte{0x67},
                       std::byte{0x89}, std::byte{0xAB}, std::byte{0xCD}, std::byte{0xEF}};

TEST(LittleEndian, Load_TakesTheLowByteFirst) {
  EXPECT_EQ(LoadLittleEndian<std::uint8_t>(kBytes), 0x01);
  EXPECT_EQ(LoadLittleEndian<std::uint16_t>(kBytes), 0x2301);
  EXPECT_EQ(LoadLittleEndian<std::uint32_t>(kBytes), 0x67452301U);
  EXPECT_EQ(LoadLittleEndian<std::uint64_t>(kBytes), 0xEFCDAB8967452301U);
  EXPECT_EQ(LoadLittleEndian<std::int64_t>(kBytes), -0x1032547698BADCFF);
}

TEST(LittleEndian, MissingBytes_AreZeros) {
  const std::span<const std::byte> bytes(kBytes);
  EXPECT_EQ(LoadLittleEndian<std::uint32_t>(bytes.first(3)), 0x00452301U);
  EXPECT_EQ(LoadLittleEndian<float>(bytes.first(0)), 0.0F);
}

template <class Number>
void ExpectRoundTrip(Number value) {
  Bytes bytes{};
  // At an address that is no multiple of anything.
  StoreLittleEndian(value, std::span(bytes).subspan(sizeof(Number) < 8 ? 1 : 0));
  const auto back = LoadLittleEndian<Number>(
      std::span<const std::byte>(bytes).subspan(sizeof(Number) < 8 ? 1 : 0));
  EXPECT_EQ(back, value);
}

TEST(LittleEndian, StoreAndLoad_KeepTheNumber) {
  ExpectRoundTrip(std::numeric_limits<std::int8_t>::min());
  ExpectRoundTrip(std::uint16_t{0xFEDC});
  ExpectRoundTrip(-1.5F);
  ExpectRoundTrip(std::numeric_limits<float>::denorm_min());
  ExpectRoundTrip(std::numeric_limits<std::int64_t>::min());
}

}  // namespace
}  // namespace disflow::hal
