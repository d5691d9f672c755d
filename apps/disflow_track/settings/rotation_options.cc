// SPDX-License-Identifier: BSD-3-Clause
#include "settings/rotation_options.h"

#include <CLI/CLI.hpp>
#include <cmath>
#include <string>
#include <utility>

#include "program/exit_status.h"
#include "settings/options.h"

namespace disflow::apps {

void AddRotationOptions(CLI::App& app, RotationOptions& options) {
  constexpr double kLargest_mb = 1e9;
  constexpr double kOldest_s = 1e9;
  constexpr double kSmallest = 0.001;
  constexpr int kMostKept = 1'000'000;
  app.add_option("--rotate-size", options.size_mb,
                 "When --csv and --record are larger than this together, they go on in new files, "
                 "with the next number for {n} in their names [never]")
      ->check(CLI::Range(kSmallest, kLargest_mb).description(""))
      ->type_name("MEGABYTES");
  app.add_option("--rotate-age", options.age_s,
                 "The same when they hold more than this, by the frames' stamps [never]")
      ->check(CLI::Range(kSmallest, kOldest_s).description(""))
      ->type_name("SECONDS");
  app.add_option("--rotate-keep", options.keep,
                 "Remove the oldest of these files, those of earlier runs too, so that so many "
                 "numbers are left; the newest is one of them [all]")
      ->check(CLI::Range(1, kMostKept).description(""))
      ->type_name("N");
}

void CheckRotation(const Options& options) {
  const RotationOptions& rotation = options.rotation;
  // The ranges of the options themselves let NaN pass.
  if (std::isnan(rotation.size_mb) || std::isnan(rotation.age_s))
    throw Failure(kWrongUsage, "--rotate-size or --rotate-age: nan is not a number");
  if (!rotation.wanted()) {
    if (rotation.keep == 0) return;
    throw Failure(kWrongUsage, "--rotate-keep needs --rotate-size or --rotate-age");
  }
  const std::string& csv = options.objects.front().files.csv;
  if (csv.empty() && options.record.empty())
    throw Failure(kWrongUsage, "--rotate-size and --rotate-age need --csv or --record");
  for (const auto& [option, name] : {std::pair{"--csv ", &csv}, {"--record ", &options.record}}) {
    if (name->empty() || name->find(kRunNumber) != std::string::npos) continue;
    throw Failure(kWrongUsage, option + *name +
                                   ": to be rotated it needs the place of a number in its name, "
                                   "e.g. run-{n}");
  }
}

}  // namespace disflow::apps
