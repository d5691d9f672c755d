// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <limits>
#include <optional>
#include <string>

#include "disflow/geometry/pinhole_camera.h"
#include "disflow/hal/fault.h"
#include "disflow/host/uri.h"

namespace disflow::host {

/// Where the camera poses in the world (DepthFrame::T_wc) of a recorded sequence come from.
enum class WorldPoses : std::uint8_t {
  kIfRecorded,  ///< T_wc.txt if the sequence has it.
  kGiven,       ///< Those of others: pose/*.txt, groundtruth.txt (TUM), scene_camera.json (BOP).
  kNone,
};

/// Which recorded sequence to replay, and how.
struct ReplayOptions {
  std::filesystem::path dir;
  /// Folder below masks/ (BOP: mask or mask_visib); "none" = no mask; empty = gt (BOP: mask_visib)
  /// if the sequence has it, else none.
  std::string mask_set;
  /// Whose masks, if a set holds those of several objects. Several names joined by +: the mask
  /// then shows them with the labels 1, 2, ... BOP: obj_id, or gtN for the N-th in scene_gt.json.
  std::string object;
  std::optional<double> unit_m;   ///< Of 16-bit images; default 0.001, TUM 1/5000, BOP its own.
  std::optional<double> rate_hz;  ///< Images per second, where they have no stamps.
  std::optional<PinholeCamera> camera;  ///< Instead of the sequence's own.
  WorldPoses world_poses = WorldPoses::kIfRecorded;
  int first = 0;                                ///< Images left out at the start.
  int count = std::numeric_limits<int>::max();  ///< Images replayed at most.
};

/// Reads `replay:DIR?mask=SET&object=NAME&scale=M&fps=HZ&K=fx,fy,cx,cy&
/// T_wc=auto|poses|none&first=N&count=N`.
/// @param options Unchanged unless the result is ok.
[[nodiscard]] hal::Fault ParseReplayUri(const Uri& uri, ReplayOptions& options);

}  // namespace disflow::host
