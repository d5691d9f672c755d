// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// In place of libFuzzer, for builds that have none: gives the fuzzer every file of a folder,
/// whole, cut short and with a byte changed, in the same way every time.

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <vector>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace {

using Bytes = std::vector<std::uint8_t>;

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

}  // namespace

int main(int count, char** arguments) {
  if (count != 2) {
    std::fprintf(stderr, "usage: %s FOLDER\n", arguments[0]);
    return 2;
  }
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(arguments[1]))
    files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  std::size_t tries = 0;
  for (const std::filesystem::path& file : files) {
    const Bytes bytes = Read(file);
    // Said before: whoever ends the program by it is known.
    std::printf("%s\n", file.filename().c_str());
    std::fflush(stdout);
    Try(bytes.data(), bytes.size());
    const bool is_slow = file.filename().string().starts_with("slow_");
    tries += 1 + TryDamaged(bytes, is_slow ? kPlacesOfSlow : kPlaces);
  }
  std::printf("%zu inputs\n", tries);
  return tries > 0 ? 0 : 1;
}
