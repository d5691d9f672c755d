// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>

#include "report.h"

namespace disflow::apps {

/// What is to be judged against what.
struct EvaluationInput {
  std::string sequence;  ///< Folder in the Fast-YCB layout, or "sim:...".
  std::filesystem::path csv;
  std::filesystem::path model;    ///< Empty = the sequence's own.
  std::filesystem::path mesh;     ///< Reconstructed surface, tracker's object frame; empty = none.
  std::string object = "";        ///< Which of several; empty: the only one.
  TruthDeviation truth_std = {};  ///< What the covariances are not to be blamed for.
};

/// Reads everything and computes all metrics.
/// @throws InputError
[[nodiscard]] Report Evaluate(const EvaluationInput& input);

}  // namespace disflow::apps
