// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include "report.h"

namespace disflow::apps {

/// What is to be judged against what.
struct EvaluationInput {
  std::filesystem::path sequence_dir;
  std::filesystem::path csv;
  std::filesystem::path model;  ///< Empty = sequence_dir/gt/model.obj.
  std::filesystem::path mesh;   ///< Reconstructed surface, tracker's object frame; empty = none.
};

/// Reads everything and computes all metrics.
/// @throws InputError
[[nodiscard]] Report Evaluate(const EvaluationInput& input);

}  // namespace disflow::apps
