// SPDX-License-Identifier: BSD-3-Clause
#include "bop_sequence.h"

#include <algorithm>
#include <cinttypes>
#include <cstdio>
#include <string>
#include <vector>

#include "disflow/host/bop_scene.h"
#include "disflow/host/sequence_layout.h"
#include "recorded_masks.h"

namespace disflow::host {
namespace {

namespace fs = std::filesystem;

/// As BOP numbers its files.
std::string SixDigits(std::uint64_t number) {
  char text[24];
  (void)std::snprintf(text, sizeof(text), "%06" PRIu64, number);
  return text;
}

hal::Fault ListCameras(const ReplayOptions& options, SequenceIndex& index) {
  BopCameras cameras;
  const hal::Fault fault = ReadBopCameras(options.dir, cameras);
  if (!fault.ok()) return fault;
  for (const auto& [number, camera] : cameras) {
    RecordedFrame& frame = index.frames.emplace_back();
    frame.number = number;
    frame.depth = (options.dir / kDepthFolder / (SixDigits(number) + kImageExtension)).string();
    // Some data sets leave out images of a video and keep its numbers.
    frame.stamp_ns = StampAtRate(number - cameras.begin()->first, *options.rate_hz);
    if (!options.camera) frame.camera = camera.camera;
    frame.unit_m = camera.unit_m;
    if (options.world_poses != WorldPoses::kGiven) continue;
    if (!camera.has_T_wc) {
      return hal::MakeFault(Status::kNotFound,
                            "%s: image %" PRIu64 ": T_wc=poses needs cam_R_w2c and cam_t_w2c",
                            (options.dir / kBopCameraFile).c_str(), number);
    }
    frame.T_wc = camera.T_wc;
    frame.has_T_wc = true;
  }
  if (!index.frames.empty()) return {};
  return hal::MakeFault(Status::kNotFound, "%s: names no image",
                        (options.dir / kBopCameraFile).c_str());
}

/// One object's masks.
hal::Fault AddMasks(const fs::path& folder, const BopObjects& objects, const std::string& wanted,
                    std::vector<RecordedFrame>& frames) {
  bool any = false;
  for (RecordedFrame& frame : frames) {
    fs::path& mask = frame.masks.emplace_back();
    const auto found = objects.find(frame.number);
    if (found == objects.end()) continue;
    int place = -1;
    const hal::Fault fault = FindBopObject(found->second, wanted, place);
    if (!fault.ok()) {
      return hal::MakeFault(fault.status, "%s: with object=, %s", folder.c_str(), fault.message);
    }
    if (place < 0) continue;
    any = true;
    mask = folder / (SixDigits(frame.number) + "_" + SixDigits(static_cast<unsigned>(place)) +
                     kImageExtension);
  }
  if (any) return {};
  return hal::MakeFault(Status::kNotFound, "%s: no image shows the object '%s' of object=",
                        (folder.parent_path() / kBopTruthFile).c_str(), wanted.c_str());
}

hal::Fault FindBopMasks(const ReplayOptions& options, SequenceIndex& index) {
  const fs::path folder =
      options.dir / (options.mask_set.empty() ? kBopVisibleFolder : options.mask_set.c_str());
  if (options.mask_set == "none" || (options.mask_set.empty() && !fs::exists(folder))) return {};
  if (!fs::is_directory(folder)) {
    return hal::MakeFault(Status::kNotFound,
                          "%s: is no folder; mask= may be mask_visib, mask, none", folder.c_str());
  }
  BopObjects objects;
  hal::Fault fault = ReadBopObjects(options.dir, objects);
  if (!fault.ok()) return fault;
  const std::vector<std::string> wanted = SplitNames(options.object);
  if (wanted.size() > kMostLabels) return TooManyObjects(wanted.size());
  for (const std::string& object : wanted) {
    fault = AddMasks(folder, objects, object, index.frames);
    if (!fault.ok()) return fault;
  }
  index.masked_objects = static_cast<int>(wanted.size());
  return {};
}

}  // namespace

hal::Fault ListBopSequence(const ReplayOptions& options, SequenceIndex& index) {
  index.layout = SequenceLayout::kBop;
  hal::Fault fault = CheckRate(options, nullptr);
  if (fault.ok()) fault = ListCameras(options, index);
  if (fault.ok()) fault = FindBopMasks(options, index);
  return fault;
}

}  // namespace disflow::host
