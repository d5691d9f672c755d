// SPDX-License-Identifier: BSD-3-Clause
#include "dds/bag_recording.h"
#include "program/exit_status.h"

/// @file
/// In the place of bag_recording.cc in a program that is built without one of its libraries.

namespace disflow::apps {

struct BagRecording::State {};

BagRecording::BagRecording(const Options& options, const hal::SensorInfo&) {
  throw Failure(kWrongUsage, "--record " + options.record +
                                 ": this program was built without recordings of ROS "
                                 "(DISFLOW_WITH_DDS=OFF or DISFLOW_WITH_ROSBAG=OFF)");
}

BagRecording::~BagRecording() = default;

hal::Fault BagRecording::Add(const DepthFrame*, std::span<const FrameResult>,
                             std::span<const SampleList>) {
  return {};
}

hal::Fault BagRecording::Finish() { return {}; }

int BagRecording::frame_count() const noexcept { return 0; }

std::int64_t BagRecording::size_bytes() const noexcept { return 0; }

}  // namespace disflow::apps
