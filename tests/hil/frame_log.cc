// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Takes frames from a camera that plays a file of raw images, and prints what came: per frame
/// "frame STAMP_NS NUMBER" with the number of the first image, after the last one found, that it
/// equals bit for bit, or -1; at the end the sensor's counters.
///   frame_log URI COUNT [FRAMES]

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <string>
#include <vector>

#include "disflow/posix/camera/v4l2_sensor.h"
#ifdef DISFLOW_HAS_LIBCAMERA
#include "disflow/posix/camera/libcamera_sensor.h"
#endif

namespace {

using namespace disflow;

constexpr std::int64_t kPatience_ns = 3'000'000'000;

/// What the camera plays.
class Images {
 public:
  explicit Images(const char* path) {
    std::ifstream file(path, std::ios::binary | std::ios::ate);
    if (!file || file.tellg() <= 0) return;
    data_.resize(static_cast<std::size_t>(file.tellg()));
    file.seekg(0).read(data_.data(), static_cast<std::streamsize>(data_.size()));
  }

  int Find(const DepthView& depth) {
    const auto bytes = static_cast<std::size_t>(2 * depth.width_px * depth.height_px);
    const int count = static_cast<int>(data_.size() / bytes);
    for (int i = next_; i < count; ++i) {
      if (!Equals(depth, data_.data() + static_cast<std::size_t>(i) * bytes)) continue;
      next_ = i + 1;
      return i;
    }
    return -1;
  }

 private:
  static bool Equals(const DepthView& depth, const char* image) {
    const auto row_bytes = static_cast<std::size_t>(2 * depth.width_px);
    for (int v = 0; v < depth.height_px; ++v) {
      if (std::memcmp(depth.row(v), image + static_cast<std::size_t>(v) * row_bytes, row_bytes) !=
          0) {
        return false;
      }
    }
    return true;
  }

  std::vector<char> data_;
  int next_ = 0;
};

int Run(hal::DepthSensor& sensor, int count, const char* path) {
  Images images(path);
  hal::Fault fault = sensor.Open();
  if (!fault.ok()) {
    std::printf("refused %d %s\n", static_cast<int>(fault.status), fault.message);
    return 1;
  }
  const hal::SensorInfo info = sensor.info();
  std::printf("open %dx%d %.3f fps\n", info.width_px, info.height_px,
              static_cast<double>(info.rate_hz));
  for (int i = 0; i < count; ++i) {
    DepthFrame frame;
    fault = sensor.Next(kPatience_ns, frame);
    if (fault.ok()) {
      std::printf("frame %lld %d\n", static_cast<long long>(frame.stamp_ns),
                  images.Find(frame.depth));
    } else {
      std::printf("fault %d %s\n", static_cast<int>(fault.status), fault.message);
      if (fault.status == Status::kTimeout) break;
    }
  }
  const hal::SensorCounters counters = sensor.counters();
  std::printf("stamps of %s\n", sensor.info().stamp_point == hal::StampPoint::kStartOfExposure
                                    ? "start of exposure"
                                    : "end of frame");
  std::printf("counters frames %u gaps %u skipped %u flagged %u short %u restarts %u\n",
              counters.frames, counters.gaps, counters.skipped, counters.flagged,
              counters.short_frames, counters.restarts);
  sensor.Close();
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  posix::CameraAddress address;
  if (argc < 3 || argc > 4) {
    std::fprintf(stderr, "usage: frame_log URI COUNT [FRAMES]\n");
    return 2;
  }
  const hal::Fault fault = posix::ParseCameraAddress(argv[1], address);
  if (!fault.ok()) {
    std::fprintf(stderr, "frame_log: %s\n", fault.message);
    return 2;
  }
#ifdef DISFLOW_HAS_LIBCAMERA
  if (address.kind == posix::CameraAddress::Kind::kLibcamera) {
    posix::LibcameraSensor camera(address, {});
    return Run(camera, std::atoi(argv[2]), argc > 3 ? argv[3] : "/dev/null");
  }
#endif
  posix::V4l2Sensor sensor(address, {});
  return Run(sensor, std::atoi(argv[2]), argc > 3 ? argv[3] : "/dev/null");
}
