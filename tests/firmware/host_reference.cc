// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The firmware's tracker built for the host, with Eigen's vector instructions off as on the
/// target: they add in another order. Reads packets from standard input and prints a pose per
/// frame.

#include <cstdio>
#include <vector>

#include "disflow/hal/depth_stream/stream_sensor.h"
#include "disflow/tracker.h"
#include "profile.h"

namespace {

using namespace disflow;

class StandardInput final : public hal::ByteLink {
 private:
  hal::Fault DoOpen() noexcept override { return {}; }
  void DoClose() noexcept override {}
  hal::Fault DoSend(std::span<const std::byte> /*message*/) noexcept override { return {}; }
  Expected<std::size_t> DoReceive(std::span<std::byte> buffer) noexcept override {
    const std::size_t size = std::fread(buffer.data(), 1, buffer.size(), stdin);
    return {size, size == 0 ? Status::kEndOfStream : Status::kOk};
  }
  [[nodiscard]] const char* DoName() const noexcept override { return "standard input"; }
  [[nodiscard]] hal::LinkCounters DoCounters() const noexcept override { return {}; }
};

class StoppedClock final : public hal::Clock {
 private:
  [[nodiscard]] std::int64_t DoNowNs() noexcept override { return 0; }
  void DoSleepUntilNs(std::int64_t /*deadline_ns*/) noexcept override {}
};

}  // namespace

int main() {
  static Tracker<firmware::Profile> tracker(firmware::FirmwareConfig());
  StandardInput input;
  StoppedClock clock;
  std::vector<std::uint16_t> image(std::size_t{firmware::Profile::kMaxImageWidth} *
                                   firmware::Profile::kMaxImageHeight);
  hal::depth_stream::TimeBudgets budgets;
  hal::depth_stream::StreamSensor sensor(input, clock, image, budgets);
  DepthFrame frame;
  Estimate estimate;
  while (sensor.Next(1, frame).ok()) {
    (void)tracker.Process(frame, estimate);
    const Vec3& t = estimate.T_co.translation();
    const auto q = estimate.T_co.rotation_quaternion();
    for (const float value : {t.x(), t.y(), t.z(), q.w(), q.x(), q.y(), q.z()}) {
      std::printf("%.9g ", static_cast<double>(value));
    }
    std::printf("\n");
  }
  return 0;
}
