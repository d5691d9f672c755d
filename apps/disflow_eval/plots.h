// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "report.h"

namespace disflow::apps {

/// A picture and what it shows.
struct Plot {
  std::string file;  ///< Name within the folder.
  std::string title;
};

/// Draws errors over time, speeds against the truth, the ADD curve, the NEES and the time per frame
/// (what the report holds of these) as PNG with gnuplot. The script and its data stay beside the
/// pictures.
/// @param dir Created if need be.
/// @throws OutputError if a file cannot be written, gnuplot is not installed or fails.
std::vector<Plot> WritePlots(const Report& report, const std::filesystem::path& dir);

}  // namespace disflow::apps
