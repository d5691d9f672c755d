// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <string_view>

namespace disflow::test {

[[nodiscard]] inline std::string ReadFile(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  return text.str();
}

inline void WriteFile(const std::filesystem::path& file, std::string_view text) {
  std::ofstream(file, std::ios::binary)
      .write(text.data(), static_cast<std::streamsize>(text.size()));
}

/// Tests with a folder of their own, gone when the test ends.
class ScratchFolderTest : public testing::Test {
 protected:
  ScratchFolderTest() {
    std::string name = testing::TempDir() + "disflow_track_XXXXXX";
    if (::mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary folder");
    scratch_ = name;
  }
  ~ScratchFolderTest() override {
    std::error_code error;
    std::filesystem::remove_all(scratch_, error);
  }

  [[nodiscard]] const std::filesystem::path& scratch() const { return scratch_; }
  [[nodiscard]] std::string Path(const std::string& name) const { return scratch_ / name; }

 private:
  std::filesystem::path scratch_;
};

}  // namespace disflow::test
