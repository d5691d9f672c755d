// SPDX-License-Identifier: BSD-3-Clause
#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cstdio>
#include <exception>
#include <string>
#include <vector>

#include "answer_csv.h"
#include "board_connection.h"
#include "disflow/host/open_sensor.h"
#include "disflow/limits.h"
#include "disflow/posix/link.h"
#include "disflow/posix/monotonic_clock.h"
#include "disflow/posix/socket_link.h"
#include "disflow/types.h"
#include "empty_values.h"
#include "image_reducer.h"

namespace {

using namespace disflow;
using apps::BoardAnswer;
using hal::Fault;

enum ExitStatus : int { kDone = 0, kWrongUsage = 2, kInputFailed = 3, kOutputFailed = 4 };

constexpr std::int64_t kHello_ns = 10 * kSecond_ns;
constexpr std::int64_t kFrame_ns = 60 * kSecond_ns;

constexpr const char* kFooter =
    "Links: serial:///dev/NAME[?baud=RATE], also a pseudo-terminal; unix:PATH and tcp:HOST:PORT "
    "for "
    "emulators\nand terminal servers.\n\n"
    "Exit status: 0 done, 2 wrong usage, 3 the sensor failed, 4 the link, the controller or a file "
    "failed.";

struct Arguments {
  std::string sensor;
  std::string link;
  std::string csv;
  int width_px = profiles::Micro::kMaxImageWidth;
  int height_px = profiles::Micro::kMaxImageHeight;
  std::int64_t frames = 0;
  double frame_budget_ms = 0.0;
  double stage_budget_ms = 0.0;
};

int Fail(const Fault& fault, int status) {
  std::fprintf(stderr, "disflow_feed: %s\n", fault.message);
  return status;
}

std::uint32_t Microseconds(double ms) { return static_cast<std::uint32_t>(ms * 1e3); }

/// What the run came to.
struct Summary {
  std::int64_t sent = 0;
  std::int64_t tracked = 0;
  std::int64_t lost = 0;
  BoardAnswer last;
  std::vector<double> frame_ms;

  void Add(const BoardAnswer& answer) {
    ++sent;
    last = answer;
    if (!answer.tracked) {
      ++lost;
      return;
    }
    tracked += answer.odometry.quality != hal::mavlink::Odometry::kQualityFailed ? 1 : 0;
    frame_ms.push_back(static_cast<double>(answer.timing.frame_ns) * 1e-6);
  }
  void Print() {
    std::printf("%lld frames sent, %lld tracked, %lld not received whole\n",
                static_cast<long long>(sent), static_cast<long long>(tracked),
                static_cast<long long>(lost));
    if (frame_ms.empty()) return;
    std::sort(frame_ms.begin(), frame_ms.end());
    std::printf("time per frame on the controller: median %.3f ms, longest %.3f ms\n",
                frame_ms[frame_ms.size() / 2], frame_ms.back());
    std::printf(
        "stack %u bytes, stages over budget %u, restarts %u; packets %u, corrupt %u, "
        "bytes lost %u\n",
        last.timing.stack_bytes, last.timing.stages_late, last.timing.restarts, last.ready.packets,
        last.ready.packets_corrupt, last.ready.bytes_lost);
  }
};

int Feed(const Arguments& arguments, hal::ByteLink& link) {
  posix::MonotonicClock clock;
  apps::BoardConnection board(link, clock);
  apps::AnswerCsv csv;
  host::Sensor sensor;
  Fault fault = host::OpenSensor(arguments.sensor, sensor);
  if (!fault.ok()) {
    return Fail(fault, fault.status == Status::kInvalidUri ? kWrongUsage : kInputFailed);
  }
  if (!sensor.note().empty()) std::fprintf(stderr, "disflow_feed: %s\n", sensor.note().c_str());
  if (!arguments.csv.empty()) fault = csv.Open(arguments.csv);
  if (fault.ok()) fault = link.Open();
  if (fault.ok()) fault = board.WaitUntilReady(kHello_ns);
  if (fault.ok()) {
    fault = board.SetBudgets({.frame_us = Microseconds(arguments.frame_budget_ms),
                              .stage_us = Microseconds(arguments.stage_budget_ms)});
  }
  if (!fault.ok()) return Fail(fault, kOutputFailed);

  apps::ImageReducer reducer(arguments.width_px, arguments.height_px);
  Summary summary;
  for (std::int64_t index = 0; arguments.frames == 0 || index < arguments.frames; ++index) {
    DepthFrame frame;
    fault = sensor.get()->Next(kSecond_ns, frame);
    if (fault.status == Status::kEndOfStream) break;
    if (!fault.ok()) return Fail(fault, kInputFailed);
    BoardAnswer answer;
    fault = board.Track(reducer.Reduce(frame), kFrame_ns, answer);
    if (!fault.ok()) return Fail(fault, kOutputFailed);
    csv.Add(index, frame.stamp_ns, answer);
    summary.Add(answer);
  }
  summary.Print();
  fault = csv.Close();
  return fault.ok() ? kDone : Fail(fault, kOutputFailed);
}

int Run(const Arguments& arguments) {
  if (posix::SocketLink::IsSocketAddress(arguments.link)) {
    const Fault fault = posix::SocketLink::CheckAddress(arguments.link);
    if (!fault.ok()) return Fail(fault, kWrongUsage);
    posix::SocketLink link(arguments.link);
    return Feed(arguments, link);
  }
  posix::Link link;
  const Fault fault = link.Configure(arguments.link);
  if (!fault.ok()) return Fail(fault, kWrongUsage);
  if (link.address().key_file[0] != '\0') {
    return Fail(hal::MakeFault(Status::kUnsupported,
                               "link '%s': disflow_firmware does not sign; leave out key=FILE",
                               arguments.link.c_str()),
                kWrongUsage);
  }
  return Feed(arguments, *link.get());
}

}  // namespace

int main(int argc, char** argv) {
  Arguments arguments;
  CLI::App app(
      "Feeds depth images to a controller that runs disflow_firmware and writes down what "
      "it answers.");
  app.set_version_flag("--version", DISFLOW_VERSION);
  app.footer(host::SensorHelp() + "\n\n" + kFooter);
  app.add_option("--sensor", arguments.sensor, "Where depth images come from, see below")
      ->required()
      ->type_name("URI");
  app.add_option("--link", arguments.link, "The line to the controller, see below")
      ->required()
      ->type_name("ADDRESS");
  app.add_option("--csv", arguments.csv, "Write the trajectory, for disflow_eval")
      ->type_name("FILE");
  app.add_option("--width", arguments.width_px,
                 "Widest image that the firmware takes; larger ones "
                 "are reduced")
      ->capture_default_str()
      ->check(CLI::Range(16, 65535));
  app.add_option("--height", arguments.height_px, "The same for the height")
      ->capture_default_str()
      ->check(CLI::Range(16, 65535));
  app.add_option("--frames", arguments.frames, "Stop after this many frames [all]")
      ->check(CLI::Range(std::int64_t{1}, std::int64_t{1} << 31));
  app.add_option("--frame-budget-ms", arguments.frame_budget_ms,
                 "The controller starts anew if a frame takes longer [no limit]")
      ->check(CLI::Range(0.001, 4e6));
  app.add_option("--stage-budget-ms", arguments.stage_budget_ms,
                 "Count the stages that take longer [none]")
      ->check(CLI::Range(0.001, 4e6));
  try {
    app.parse(argc, argv);
    apps::RefuseEmptyValues(app);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? kDone : kWrongUsage;
  }
  try {
    return Run(arguments);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "disflow_feed: %s\n", error.what());
    return kInputFailed;
  }
}
