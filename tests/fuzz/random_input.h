// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <random>
#include <span>
#include <vector>

namespace disflow::test {

using Bytes = std::vector<std::uint8_t>;

/// Makes inputs by random changes of known ones; the same ones of a seed on every machine.
class RandomInputs {
 public:
  /// @param seeds At least one; outlive this.
  RandomInputs(std::span<const Bytes> seeds, std::uint64_t seed) : seeds_(seeds), random_(seed) {}

  [[nodiscard]] Bytes Next() {
    constexpr std::size_t kMostBytes = 4096;
    constexpr std::size_t kMostChanges = 6;
    Bytes bytes = seeds_[Below(seeds_.size())];
    for (std::size_t left = 1 + Below(kMostChanges); left > 0; --left) Change(bytes);
    if (bytes.size() > kMostBytes) bytes.resize(kMostBytes);
    return bytes;
  }

 private:
  /// Not by a distribution: those differ from library to library.
  std::size_t Below(std::size_t end) { return static_cast<std::size_t>(random_() % end); }
  std::uint8_t Byte() { return static_cast<std::uint8_t>(random_()); }

  void Change(Bytes& bytes) {
    constexpr std::size_t kMostInserted = 8;
    const auto at = [&bytes](std::size_t place) {
      return bytes.begin() + static_cast<std::ptrdiff_t>(place);
    };
    if (bytes.empty()) {
      bytes.push_back(Byte());
      return;
    }
    const std::size_t place = Below(bytes.size());
    switch (Below(6)) {
      case 0:  // another byte
        bytes[place] = Byte();
        return;
      case 1:  // another bit
        bytes[place] = static_cast<std::uint8_t>(bytes[place] ^ (1U << Below(8)));
        return;
      case 2:  // one more or one less, which limits are sensitive to
        bytes[place] = static_cast<std::uint8_t>(bytes[place] + (Below(2) == 0 ? 1U : 255U));
        return;
      case 3:  // a part is gone
        bytes.erase(at(place), at(place + 1 + Below(bytes.size() - place)));
        return;
      case 4:  // something stands between
        bytes.insert(at(place), 1 + Below(kMostInserted), Byte());
        return;
      default: {  // the rest is another one's
        const Bytes& other = seeds_[Below(seeds_.size())];
        bytes.resize(place);
        bytes.insert(bytes.end(),
                     other.begin() + static_cast<std::ptrdiff_t>(std::min(place, other.size())),
                     other.end());
        return;
      }
    }
  }

  std::span<const Bytes> seeds_;
  std::mt19937_64 random_;
};

}  // namespace disflow::test
