// SPDX-License-Identifier: BSD-3-Clause
#include <cstring>
#include <string_view>

#include "disflow/host/replay_options.h"
#include "disflow/host/simulation_options.h"
#include "disflow/host/uri.h"
#include "disflow/posix/camera/camera_address.h"
#include "file_in_memory.h"

namespace {

using disflow::fuzz::Require;
using disflow::hal::Fault;

/// Whoever is refused is told why.
void CheckMessage(const Fault& fault) { Require(fault.ok() == (fault.message[0] == '\0')); }

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace disflow;
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  posix::CameraAddress address;
  const Fault camera = posix::ParseCameraAddress(text, address);
  CheckMessage(camera);
  Require(std::memchr(address.device, 0, sizeof(address.device)) != nullptr);
  Require(std::memchr(address.serial, 0, sizeof(address.serial)) != nullptr);
  Require(std::memchr(address.intrinsics, 0, sizeof(address.intrinsics)) != nullptr);
  if (camera.ok()) {
    Require(address.width_px >= 0 && address.width_px <= posix::CameraAddress::kMaxSide_px);
    Require(address.height_px >= 0 && address.height_px <= posix::CameraAddress::kMaxSide_px);
    Require(address.rate_hz >= 0.0F && address.unit_m >= 0.0F);
  }
  (void)posix::IsCameraAddress(text);

  host::Uri uri;
  const Fault parsed = host::ParseUri(text, uri);
  CheckMessage(parsed);
  if (!parsed.ok()) return 0;
  host::ReplayOptions replay;
  CheckMessage(host::ParseReplayUri(uri, replay));
  host::SimulationOptions simulation;
  const Fault simulated = host::ParseSimulationUri(uri, simulation);
  CheckMessage(simulated);
  if (simulated.ok()) Require(simulation.width_px > 0 && simulation.height_px > 0);
  return 0;
}
