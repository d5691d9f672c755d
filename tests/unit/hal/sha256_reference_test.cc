// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <openssl/evp.h>

#include <algorithm>

#include "disflow/hal/sha256.h"
#include "hex_bytes.h"
#include "wire_samples.h"

namespace disflow::hal {
namespace {

std::string ReferenceOf(std::span<const std::byte> bytes) {
  Sha256::Digest digest{};
  unsigned size = 0;
  EXPECT_EQ(EVP_Digest(bytes.data(), bytes.size(), reinterpret_cast<unsigned char*>(digest.data()),
                       &size, EVP_sha256(), nullptr),
            1);
  EXPECT_EQ(size, digest.size());
  return testing::HexOf(digest);
}

TEST(Sha256, AnyBytesOfAnyLengthInAnyPieces_AgreeWithOpenSsl) {
  for (std::uint32_t size = 0; size < 700; ++size) {
    const auto bytes = mavlink::testing::RandomBytes(size, size);
    Sha256 sha256;
    std::mt19937 random(size);
    for (std::span<const std::byte> rest(bytes); !rest.empty();) {
      const std::size_t piece = std::min<std::size_t>(rest.size(), random() % 100);
      sha256.Add(rest.first(piece));
      rest = rest.subspan(piece);
    }
    ASSERT_EQ(testing::HexOf(sha256.Finish()), ReferenceOf(bytes)) << size << " bytes";
  }
}

}  // namespace
}  // namespace disflow::hal
