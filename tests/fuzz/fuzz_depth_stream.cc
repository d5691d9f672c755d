// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Any bytes on a firmware's line: the sensor that reads depth images from it must deliver only
/// frames that the tracker can take, in the memory that it was given, and must not keep on reading
/// for ever.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <span>
#include <utility>
#include <vector>

#include "disflow/hal/depth_stream/crc32.h"
#include "disflow/hal/depth_stream/stream_sensor.h"

namespace {

using disflow::hal::Fault;

/// A line from which the fuzzer's bytes come, once.
class FuzzedLine final : public disflow::hal::ByteLink {
 public:
  explicit FuzzedLine(std::vector<std::byte> bytes) : bytes_(std::move(bytes)) {}
  [[nodiscard]] bool empty() const { return next_ == bytes_.size(); }

 private:
  Fault DoOpen() noexcept override { return {}; }
  void DoClose() noexcept override {}
  Fault DoSend(std::span<const std::byte>) noexcept override { return {}; }
  disflow::Expected<std::size_t> DoReceive(std::span<std::byte> buffer) noexcept override {
    const std::size_t count = std::min(buffer.size(), bytes_.size() - next_);
    std::copy_n(bytes_.begin() + static_cast<std::ptrdiff_t>(next_), count, buffer.begin());
    next_ += count;
    return {count};
  }
  [[nodiscard]] const char* DoName() const noexcept override { return "fuzzed"; }
  [[nodiscard]] disflow::hal::LinkCounters DoCounters() const noexcept override { return {}; }

  std::vector<std::byte> bytes_;
  std::size_t next_ = 0;
};

/// A clock on which every look takes a microsecond.
class SteppingClock final : public disflow::hal::Clock {
 private:
  std::int64_t DoNowNs() noexcept override { return now_ns_ += 1000; }
  void DoSleepUntilNs(std::int64_t due_ns) noexcept override {
    now_ns_ = std::max(now_ns_, due_ns);
  }

  std::int64_t now_ns_ = 0;
};

/// Appends a packet with a right checksum, coded without zeros, in the simplest way: a code byte
/// per stretch between zeros. See packet.h.
void AppendPacket(std::vector<std::byte> content, std::vector<std::byte>& line) {
  const std::uint32_t crc = disflow::hal::depth_stream::Crc32(content);
  for (int i = 0; i < 4; ++i) content.push_back(static_cast<std::byte>(crc >> (8 * i)));
  std::size_t code_at = line.size();
  line.push_back(std::byte{1});
  for (const std::byte byte : content) {
    if (byte != std::byte{0}) {
      line.push_back(byte);
      line[code_at] = static_cast<std::byte>(line.size() - code_at);
    }
    if (byte == std::byte{0} || line[code_at] == std::byte{0xFF}) {
      code_at = line.size();
      line.push_back(std::byte{1});
    }
  }
  line.push_back(std::byte{0});
}

/// Bytes as they are, or cut into packets whose checksums are right: chance alone finds none.
std::vector<std::byte> LineFrom(std::span<const std::uint8_t> data) {
  std::vector<std::byte> line;
  if (data.empty()) return line;
  const bool as_packets = (data[0] & 1U) != 0;
  data = data.subspan(1);
  while (!data.empty()) {
    // A byte for the size, then type, sequence number and payload.
    const std::size_t size =
        as_packets ? std::min<std::size_t>(data.size() - 1, data[0]) : data.size();
    if (as_packets) data = data.subspan(1);
    std::vector<std::byte> content(size);
    std::transform(data.begin(), data.begin() + static_cast<std::ptrdiff_t>(size), content.begin(),
                   [](std::uint8_t value) { return std::byte{value}; });
    data = data.subspan(size);
    if (as_packets) {
      AppendPacket(std::move(content), line);
    } else {
      line = std::move(content);
    }
  }
  return line;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  constexpr std::size_t kGuard = 16;
  constexpr std::uint16_t kUntouched = 0xABCD;
  std::array<std::uint16_t, 64 * 48 + kGuard> memory;
  memory.fill(kUntouched);
  FuzzedLine line(LineFrom({data, size}));
  SteppingClock clock;
  disflow::hal::depth_stream::TimeBudgets budgets;
  disflow::hal::depth_stream::StreamSensor sensor(
      line, clock, std::span(memory).first(memory.size() - kGuard), budgets);
  if (!sensor.Open().ok()) std::abort();
  std::uint32_t frames = 0;
  for (std::size_t calls = 0; !line.empty(); ++calls) {
    if (calls > 2 * size + 8) std::abort();  // a call that neither waits nor reads
    disflow::DepthFrame frame;
    if (!sensor.Next(1'000'000, frame).ok()) continue;
    ++frames;
    const disflow::DepthView& depth = frame.depth;
    if (disflow::CheckFrame(frame, 64 * 48, 64 * 48) != disflow::Status::kOk) std::abort();
    if (depth.width_px * depth.height_px > 64 * 48 || depth.data != memory.data()) std::abort();
  }
  if (sensor.counters().frames < frames) std::abort();
  for (std::size_t i = memory.size() - kGuard; i < memory.size(); ++i) {
    if (memory[i] != kUntouched) std::abort();
  }
  return 0;
}
