// SPDX-License-Identifier: BSD-3-Clause
#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <tuple>

#include "peer_run.h"
#include "program/exit_status.h"

namespace {

using disflow::bench::IcpKind;
using disflow::bench::Method;
using disflow::bench::PeerCost;
using disflow::bench::PeerOptions;

constexpr const char* kDescription =
    "Tracks a sequence with ICP of PCL, or with this project's tracker in the same loop, for "
    "./dev bench peers. Prints what it cost as JSON.";

const std::map<std::string, std::pair<Method, IcpKind>> kMethods{
    {"disflow", {Method::kDisflow, {}}},
    {"gicp", {Method::kIcp, IcpKind::kGeneralised}},
    {"point-to-plane", {Method::kIcp, IcpKind::kPointToPlane}}};

void Print(const PeerCost& cost) {
  const nlohmann::json json{{"frames", cost.frames},
                            {"mean_ms", cost.mean_ms},
                            {"median_ms", cost.median_ms},
                            {"allocations_per_frame", cost.allocations_per_frame},
                            {"memory_bytes", cost.memory_bytes}};
  std::printf("%s\n", json.dump().c_str());
}

}  // namespace

int main(int argc, char** argv) {
  PeerOptions options;
  std::string method;
  CLI::App app(kDescription, "peer_trackers");
  app.add_option("--sensor", options.sensor, "Where depth images come from, as of disflow_track")
      ->type_name("URI")
      ->required();
  app.add_option("--csv", options.csv, "Write the trajectory")->type_name("FILE")->required();
  app.add_option("--csv-extrapolated", options.csv_extrapolated,
                 "Write it once more, with velocities from three poses")
      ->type_name("FILE");
  app.add_option("--method", method, "disflow, gicp or point-to-plane")
      ->check(CLI::IsMember(kMethods))
      ->required();
  app.add_option("--voxel", options.icp.voxel_m, "Of frames and model, metres")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_option("--distance", options.icp.max_distance_m, "Farthest correspondence, metres")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_option("--neighbours", options.icp.neighbours, "Points that a normal is made from")
      ->check(CLI::Range(3, 1000))
      ->capture_default_str();
  app.add_option("--flatness", options.icp.flatness,
                 "Of gicp's discs: variance across over variance along")
      ->check(CLI::Range(1e-6, 1.0))
      ->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  std::tie(options.method, options.icp.kind) = kMethods.at(method);
  try {
    Print(disflow::bench::RunPeer(options));
  } catch (const disflow::apps::Failure& failure) {
    std::fprintf(stderr, "peer_trackers: %s\n", failure.what());
    return failure.status();
  } catch (const std::exception& error) {
    std::fprintf(stderr, "peer_trackers: %s\n", error.what());
    return disflow::apps::kInputFailed;
  }
  return 0;
}
