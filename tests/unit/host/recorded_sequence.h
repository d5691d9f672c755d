// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "disflow/host/replay_sensor.h"
#include "disflow/host/sequence_writer.h"
#include "disflow/host/simulated_shapes.h"
#include "disflow/host/simulation.h"
#include "scratch_dir.h"

namespace disflow::host {

/// What a sensor delivered, copied out of its buffers.
struct CopiedFrame {
  hal::Fault fault;
  DepthFrame frame;
  std::vector<std::byte> depth;
  std::vector<std::uint8_t> mask;
};

inline CopiedFrame CopyOf(const DepthFrame& frame) {
  CopiedFrame copy;
  copy.frame = frame;
  const auto bytes = static_cast<std::size_t>(frame.depth.stride_bytes * frame.depth.height_px);
  copy.depth.resize(bytes);
  std::memcpy(copy.depth.data(), frame.depth.data, bytes);
  if (frame.mask.given()) {
    copy.mask.assign(frame.mask.data,
                     frame.mask.data + frame.mask.stride_bytes * frame.mask.height_px);
  }
  return copy;
}

/// Everything that a sequence delivers until its end.
inline std::vector<CopiedFrame> PlayAll(ReplaySensor& sensor) {
  std::vector<CopiedFrame> frames;
  for (;;) {
    DepthFrame frame;
    const hal::Fault fault = sensor.Next(0, frame);
    if (fault.status == Status::kEndOfStream || fault.status == Status::kNotOpen) return frames;
    frames.push_back(fault.ok() ? CopyOf(frame) : CopiedFrame{});
    frames.back().fault = fault;
  }
}

/// A short simulated sequence on disk, and what it was made of.
class RecordedSequence : public testing::Test {
 protected:
  static constexpr int kFrames = 6;

  static SimulationOptions Options() {
    SimulationOptions options;
    options.motion = MotionKind::kFast;
    options.noise = NoiseKind::kWhite;
    options.frames = kFrames;
    options.width_px = 64;
    options.height_px = 48;
    options.camera = CameraKind::kMoving;
    return options;
  }

  void SetUp() override {
    Simulation simulation(Options(), MakeObjectMesh(ObjectKind::kBox));
    SequenceWriter writer;
    ASSERT_TRUE(writer.Open(path(), "box", false).ok());
    for (int i = 0; i < kFrames; ++i) {
      DepthFrame frame;
      simulation.Render(i, frame);
      ASSERT_TRUE(writer.AddFrame(frame).ok());
      ASSERT_TRUE(writer.AddMask("gt", simulation.gt_mask()).ok());
      ASSERT_TRUE(writer.AddMask("sloppy", simulation.sloppy_mask()).ok());
      ASSERT_TRUE(writer.AddTruth(simulation.TruthAt(i).object).ok());
      truths_.push_back(simulation.TruthAt(i));
      frames_.push_back(CopyOf(frame));
    }
    ASSERT_TRUE(writer.Finish().ok());
  }

  [[nodiscard]] std::filesystem::path path() const { return dir_.path() / "sequence"; }
  [[nodiscard]] std::filesystem::path depth(int i) const {
    return path() / "depth" / (std::to_string(i) + ".float");
  }
  [[nodiscard]] std::filesystem::path mask(int i) const {
    return path() / "masks" / "gt" / ("box_" + std::to_string(i) + ".png");
  }
  [[nodiscard]] ReplayOptions Replay() const {
    ReplayOptions options;
    options.dir = path();
    return options;
  }
  void Overwrite(const std::filesystem::path& file, const std::string& text) const {
    std::ofstream(file, std::ios::binary) << text;
  }
  [[nodiscard]] static std::string TextOf(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
  }

  std::vector<CopiedFrame> frames_;
  std::vector<FrameTruth> truths_;

 private:
  apps::ScratchDir dir_;
};

}  // namespace disflow::host
