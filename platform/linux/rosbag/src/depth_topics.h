// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <vector>

#include "disflow/hal/fault.h"
#include "disflow/posix/rosbag/bag_address.h"

namespace disflow::posix {

/// Finds the depth images of a recording for options that name none: those of 16UC1, 32FC1 and
/// compressedDepth, with `scale=` mono16 too, that have their intrinsics. Topics may begin
/// anywhere, so all of it is read once, but for SQLite, which lists them.
/// @param options Unchanged unless the result is ok; then what follows from the topic is set, too.
/// @return kInvalidUri, naming them, if there are several; kNotFound if there are none, naming what
/// there is instead.
[[nodiscard]] hal::Fault FindDepthTopic(const std::vector<std::filesystem::path>& files,
                                        BagOptions& options);

}  // namespace disflow::posix
