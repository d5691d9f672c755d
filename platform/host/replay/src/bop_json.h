// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "disflow/hal/fault.h"

namespace disflow::host {

/// What a BOP file says of one image, or of one object in it: numbers and lists of numbers by name.
struct BopEntry {
  std::uint64_t image = 0;
  std::map<std::string, std::vector<double>, std::less<>> fields;

  /// @return Empty unless the field has exactly this many.
  [[nodiscard]] std::span<const double> Numbers(const char* field, std::size_t count) const;
};

/// Reads `{"IMAGE": {"FIELD": NUMBERS, …}, …}` or `{"IMAGE": [{"FIELD": NUMBERS, …}, …], …}`, entry
/// by entry: nothing of the file is kept but its text.
/// @param take Ends the reading with its fault.
[[nodiscard]] hal::Fault ReadBopJson(const std::filesystem::path& file,
                                     const std::function<hal::Fault(const BopEntry&)>& take);

}  // namespace disflow::host
