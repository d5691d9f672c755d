// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// In place of libFuzzer, for builds that have none: gives the fuzzer every file of a folder,
/// whole, cut short and with a byte changed, and as many random changes of them as are asked for;
/// in the same way every time, but that DISFLOW_FUZZ_SEED asks for other random ones.

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "found_input.h"
#include "random_input.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace {

using disflow::test::Bytes;

/// Places of a file that are tried, evenly spread.
constexpr std::size_t kPlaces = 25;
/// Of inputs that take their time, which their names say: slow_...
constexpr std::size_t kPlacesOfSlow = 4;

Bytes Read(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

/// Of a copy that is no longer than it says: the sanitizers see what is read beyond.
void Try(const std::uint8_t* data, std::size_t size) {
  const Bytes copy(data, data + size);
  disflow::test::TheInput().data = copy.data();
  disflow::test::TheInput().size = copy.size();
  (void)LLVMFuzzerTestOneInput(copy.data(), copy.size());
}

std::size_t TryDamaged(const Bytes& bytes, std::size_t places) {
  const std::size_t step = std::max<std::size_t>(bytes.size() / places, 1);
  std::size_t tries = 0;
  for (std::size_t place = 0; place < bytes.size(); place += step) {
    Try(bytes.data(), place);
    Bytes changed = bytes;
    for (const std::uint8_t byte : {std::uint8_t{0x00}, std::uint8_t{0x7f}, std::uint8_t{0xff}}) {
      changed[place] = byte;
      Try(changed.data(), changed.size());
    }
    tries += 4;
  }
  return tries;
}

std::size_t TryRandom(const std::vector<Bytes>& seeds, std::size_t wanted) {
  const char* const given = std::getenv("DISFLOW_FUZZ_SEED");
  const std::uint64_t seed = given == nullptr ? 1 : std::strtoull(given, nullptr, 10);
  disflow::test::RandomInputs inputs(seeds, seed);
  for (std::size_t i = 0; i < wanted; ++i) {
    disflow::test::TheInput().told = "random input " + std::to_string(i) + " of seed " +
                                     std::to_string(seed) + ", kept in " +
                                     disflow::test::TheInput().path + "\n";
    const Bytes bytes = inputs.Next();
    Try(bytes.data(), bytes.size());
  }
  return wanted;
}

}  // namespace

int main(int count, char** arguments) {
  if (count != 2 && count != 3) {
    std::fprintf(stderr, "usage: %s FOLDER [RANDOM_INPUTS]\n", arguments[0]);
    return 2;
  }
  const std::string name = std::filesystem::path(arguments[0]).filename().string();
  disflow::test::TheInput().path = name + ".found";
  disflow::test::KeepInputThatEndsTheProgram();
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(arguments[1]))
    files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  std::size_t tries = 0;
  std::vector<Bytes> seeds;
  for (const std::filesystem::path& file : files) {
    const Bytes& bytes = seeds.emplace_back(Read(file));
    // Said before: whoever ends the program by it is known.
    std::printf("%s\n", file.filename().c_str());
    std::fflush(stdout);
    disflow::test::TheInput().told =
        file.filename().string() + ", as it was kept in " + disflow::test::TheInput().path + "\n";
    Try(bytes.data(), bytes.size());
    const bool is_slow = file.filename().string().starts_with("slow_");
    tries += 1 + TryDamaged(bytes, is_slow ? kPlacesOfSlow : kPlaces);
  }
  if (count == 3 && !seeds.empty())
    tries += TryRandom(seeds, std::strtoull(arguments[2], nullptr, 10));
  std::printf("%zu inputs\n", tries);
  return tries > 0 ? 0 : 1;
}
