// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/host/open_sensor.h"

#include <string>
#include <string_view>
#include <vector>

#include "disflow/host/replay_sensor.h"
#include "disflow/host/simulated_object.h"
#include "disflow/host/uri.h"

namespace disflow::host {
namespace {

using hal::Fault;
using hal::MakeFault;

Fault OpenReplay(const Uri& uri, Sensor& sensor) {
  ReplayOptions options;
  if (const Fault fault = ParseReplayUri(uri, options); !fault.ok()) return fault;
  auto& replay = sensor.Emplace<ReplaySensor>(options);
  const Fault fault = replay.Open();
  sensor.set_note(replay.note());
  return fault;
}

Fault OpenSimulation(const Uri& uri, Sensor& sensor) {
  SimulationOptions options;
  if (const Fault fault = ParseSimulationUri(uri, options); !fault.ok()) return fault;
  std::vector<TriangleMesh> meshes;
  if (const Fault fault = LoadSimulatedObjects(options, meshes); !fault.ok()) return fault;
  auto& simulated = sensor.Emplace<SimulatedSensor>(options, std::move(meshes));
  sensor.set_simulated(&simulated);
  return simulated.Open();
}

/// The names of all objects, in lines as wide as the help's others.
std::string ObjectLines() {
  constexpr std::size_t kWidth = 100;
  const std::string indent(17, ' ');
  std::string lines;
  std::string line = indent;
  for (const std::string_view name : ListSimulationObjects()) {
    if (line.size() + name.size() + 2 > kWidth) {
      lines += line + "\n";
      line = indent;
    }
    if (line.size() > indent.size()) line += ' ';
    line.append(name).append(",");
  }
  return lines + line + "\n";
}

}  // namespace

Fault OpenSensor(std::string_view address, Sensor& sensor) {
  Uri uri;
  if (const Fault fault = ParseUri(address, uri); !fault.ok()) return fault;
  if (uri.scheme == "replay") return OpenReplay(uri, sensor);
  if (uri.scheme == "sim") return OpenSimulation(uri, sensor);
  return MakeFault(Status::kInvalidUri,
                   "%s: is no kind of sensor; known: replay:DIR, sim:OBJECT and, where the program "
                   "has them, v4l2:DEVICE, libcamera:CAMERA, dds:depth=TOPIC, rosbag:FILE",
                   uri.scheme.c_str());
}

std::string SensorHelp() {
  return "  replay:DIR   a recorded sequence: the Fast-YCB layout, a TUM RGB-D folder (depth.txt), "
         "a BOP scene\n"
         "               (scene_camera.json), or 16-bit PNG depth images with cam_K.json or "
         "camera-intrinsics.txt.\n"
         "               Options: fps=HZ (where images have no stamps: BOP, plain folders), "
         "mask=gt|none|SET (a folder\n"
         "               in masks/; BOP: mask_visib, mask), object=NAME (whose masks; BOP: obj_id; "
         "several joined by +\n"
         "               have the labels 1, 2, ...), scale=0.001 (metres per PNG unit; TUM 0.0002, "
         "BOP its own),\n"
         "               K=fx,fy,cx,cy, T_wc=auto|poses|none (camera poses from T_wc.txt, or from "
         "pose/*.txt,\n"
         "               groundtruth.txt, scene_camera.json), first=N, count=N\n"
         "  sim:OBJECT   a simulated depth camera; OBJECT is\n" +
         ObjectLines() +
         "               or obj:FILE, or up to four of these joined by +, whose masks have the "
         "labels\n"
         "               1, 2, ... Options:\n" +
         SimulationOptionsHelp();
}

}  // namespace disflow::host
