// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "disflow/hal/fault.h"

namespace disflow::host {

/// A file whose name ends in a number, or at least contains one: "box_000012.png".
struct NumberedFile {
  std::filesystem::path path;
  std::string prefix;        ///< What comes before the last number, e.g. "box_".
  std::uint64_t number = 0;  ///< The last number in the name.
};

/// Files of a folder with an extension, in natural order ("frame9_cam2" before "frame10_cam1").
/// Names without a number are left out. The list is empty if there is no such folder.
[[nodiscard]] hal::Fault ListNumberedFiles(const std::filesystem::path& folder,
                                           const std::string& extension,
                                           std::vector<NumberedFile>& files);

/// Where the file of a number would be, named as its neighbours are: "000003.png" among files of
/// six digits.
/// @param files Not empty.
[[nodiscard]] std::filesystem::path PathOfNumber(const std::vector<NumberedFile>& files,
                                                 std::uint64_t number);

}  // namespace disflow::host
