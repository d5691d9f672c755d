// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "disflow/config.h"

namespace disflow::apps {

/// How many objects one run may track; each costs a tracker's memory.
inline constexpr std::size_t kMaxObjects = 4;

/// What stands for the number of the run in the last part of an output's name.
inline constexpr const char* kRunNumber = "{n}";

/// Files that a run may write for an object; empty = not wanted.
struct ObjectFiles {
  std::string csv;
  std::string mesh;
  std::string mesh_picture;
  std::string flow;  ///< Folder.
};

/// One of the objects to track.
struct ObjectOptions {
  std::string name = "object";  ///< A word that may stand in file and topic names.
  /// Its value in the masks; 0: all that is not 0.
  std::uint8_t label = 0;
  bool uses_mask = true;   ///< false: the masks show other objects.
  std::uint8_t index = 0;  ///< Added to the MAVLink component id.
  Config config;
  ObjectFiles files;
};

}  // namespace disflow::apps
