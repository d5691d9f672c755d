// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace disflow::test {

/// The files of a sequence in the Fast-YCB layout, for damaging them.
class SequenceFiles {
 public:
  explicit SequenceFiles(std::filesystem::path folder) : folder_(std::move(folder)) {}

  [[nodiscard]] std::filesystem::path depth(int frame) const;
  [[nodiscard]] std::filesystem::path mask(int frame) const;
  [[nodiscard]] std::filesystem::path intrinsics() const { return folder_ / "cam_K.json"; }
  [[nodiscard]] std::filesystem::path stamps() const { return folder_ / "data.txt"; }

 private:
  std::filesystem::path folder_;
};

/// Contents of depth/<i>.float.
struct DepthFile {
  std::uint64_t width_px = 0;
  std::uint64_t height_px = 0;
  std::vector<float> depth_m;
};

[[nodiscard]] DepthFile ReadDepth(const std::filesystem::path& file);
void WriteDepth(const std::filesystem::path& file, const DepthFile& depth);
/// Writes a mask of one value.
void WriteMask(const std::filesystem::path& file, int width_px, int height_px, std::uint8_t value);
/// Cuts a file to half of its size.
void Truncate(const std::filesystem::path& file);
/// Replaces the first `old_text`; fails the test if there is none.
void ReplaceText(const std::filesystem::path& file, const std::string& old_text,
                 const std::string& new_text);

}  // namespace disflow::test
