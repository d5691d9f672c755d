// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "disflow/depth/depth_frame.h"
#include "ground_truth.h"
#include "surface.h"

namespace disflow::apps {

/// Depth image of frame k, or nothing if there is none; its view stays valid until the next call.
using ImageSource = std::function<std::optional<DepthFrame>(std::size_t k)>;

/// A sequence with ground truth.
struct Sequence {
  GroundTruth truth;
  std::string model_name;        ///< Where the model came from, or would be.
  std::optional<Surface> model;  ///< True object frame, metres.
  ImageSource image;             ///< Empty if the sequence has no images.
};

/// Opens a folder in the Fast-YCB layout, a scene of the BOP benchmark, or a simulation by the
/// address that disflow_track takes
/// ("sim:box?motion=fast"): the same images, rendered anew where they are asked for.
/// @param model_file Used in place of the sequence's own model unless empty.
/// @param object Which of several objects is to be judged; empty: the only one.
/// @throws InputError naming file or address and reason.
[[nodiscard]] Sequence OpenSequence(const std::string& address,
                                    const std::filesystem::path& model_file = {},
                                    const std::string& object = {});

}  // namespace disflow::apps
