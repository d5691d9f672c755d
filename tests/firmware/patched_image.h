// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <elf.h>
#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace disflow::firmware_test {

/// A copy of a board's firmware in which one function begins with an instruction that there is not:
/// whoever calls it makes the processor fault. The file goes with the object.
class PatchedImage {
 public:
  /// @param function A part of its symbol that no other function has.
  /// @throws std::runtime_error if there is no such function.
  PatchedImage(const std::filesystem::path& image, std::string_view function)
      : path_(std::filesystem::temp_directory_path() /
              ("disflow-patched-" + std::to_string(::getpid()) + ".elf")) {
    std::ifstream in(image, std::ios::binary);
    bytes_.assign(std::istreambuf_iterator<char>(in), {});
    constexpr std::uint16_t kUndefined = 0xDE00;  // udf #0
    const std::size_t offset = FileOffset(AddressOf(function));
    std::memcpy(&bytes_.at(offset), &kUndefined, sizeof(kUndefined));
    std::ofstream(path_, std::ios::binary)
        .write(bytes_.data(), static_cast<std::streamsize>(bytes_.size()));
  }
  PatchedImage(const PatchedImage&) = delete;
  PatchedImage& operator=(const PatchedImage&) = delete;
  ~PatchedImage() {
    std::error_code ignored;
    std::filesystem::remove(path_, ignored);
  }

  [[nodiscard]] std::string path() const { return path_; }

 private:
  template <class Record>
  [[nodiscard]] Record At(std::size_t offset) const {
    Record record;
    if (offset + sizeof(record) > bytes_.size()) throw std::runtime_error("the image is no ELF");
    std::memcpy(&record, bytes_.data() + offset, sizeof(record));
    return record;
  }
  [[nodiscard]] Elf32_Shdr Section(std::size_t index) const {
    const auto header = At<Elf32_Ehdr>(0);
    return At<Elf32_Shdr>(header.e_shoff + index * header.e_shentsize);
  }

  [[nodiscard]] std::uint32_t AddressOf(std::string_view function) const {
    const auto header = At<Elf32_Ehdr>(0);
    for (std::size_t i = 0; i < header.e_shnum; ++i) {
      const Elf32_Shdr table = Section(i);
      if (table.sh_type != SHT_SYMTAB) continue;
      const Elf32_Shdr names = Section(table.sh_link);
      for (std::size_t at = 0; at < table.sh_size; at += sizeof(Elf32_Sym)) {
        const auto symbol = At<Elf32_Sym>(table.sh_offset + at);
        const char* const name = &bytes_.at(names.sh_offset + symbol.st_name);
        if (ELF32_ST_TYPE(symbol.st_info) == STT_FUNC &&
            std::string_view(name).find(function) != std::string_view::npos) {
          return symbol.st_value & ~1U;  // the lowest bit says Thumb
        }
      }
    }
    throw std::runtime_error("the image has no function " + std::string(function));
  }

  [[nodiscard]] std::size_t FileOffset(std::uint32_t address) const {
    const auto header = At<Elf32_Ehdr>(0);
    for (std::size_t i = 0; i < header.e_phnum; ++i) {
      const auto segment = At<Elf32_Phdr>(header.e_phoff + i * header.e_phentsize);
      if (segment.p_type == PT_LOAD && address >= segment.p_vaddr &&
          address < segment.p_vaddr + segment.p_filesz) {
        return segment.p_offset + (address - segment.p_vaddr);
      }
    }
    throw std::runtime_error("the function is not in a loaded segment");
  }

  std::filesystem::path path_;
  std::vector<char> bytes_;
};

}  // namespace disflow::firmware_test
