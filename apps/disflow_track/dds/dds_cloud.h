// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <initializer_list>
#include <string>
#include <vector>

#include "dds/dds_motion.h"
#include "objects/model_snapshot.h"

namespace disflow::apps {

/// Points as sensor_msgs/PointCloud2, every field a float. Used again and again.
class DdsCloud {
 public:
  DdsCloud(std::initializer_list<const char*> fields);

  void Clear() noexcept { data_.clear(); }
  /// One point: as many numbers as there are fields.
  void Add(std::initializer_list<float> point);
  /// @return Points into this; valid until it is changed.
  [[nodiscard]] posix::ros::PointCloud2 Message(std::int64_t ros_ns, const std::string& frame);

 private:
  std::vector<std::string> names_;
  std::vector<posix::ros::PointField> fields_;
  std::vector<std::uint8_t> data_;
};

/// The fused samples of the model, object frame: x y z, normal_x normal_y normal_z, std.
class DdsModelCloud final : public SampleSink {
 public:
  /// @param model A ModelSnapshot or a TrackedObject.
  template <class Model>
  [[nodiscard]] posix::ros::PointCloud2 Message(const Model& model, std::int64_t ros_ns,
                                                const DdsFrames& frames) {
    cloud_.Clear();
    (void)model.StreamSamples(*this);
    posix::ros::PointCloud2 message = cloud_.Message(ros_ns, frames.object);
    message.is_dense = true;
    return message;
  }

 private:
  void DoOnSample(const SurfaceVertex& sample, int observations) noexcept override;

  DdsCloud cloud_{"x", "y", "z", "normal_x", "normal_y", "normal_z", "std"};
};

/// The distance flow of a frame, camera frame: x y z, d, gx gy gz, vx vy vz.
class DdsFlowCloud {
 public:
  [[nodiscard]] posix::ros::PointCloud2 Message(const ModelSnapshot& snapshot, std::int64_t ros_ns,
                                                const DdsFrames& frames);

 private:
  DdsCloud cloud_{"x", "y", "z", "d", "gx", "gy", "gz", "vx", "vy", "vz"};
};

/// The model's surface as triangles coloured by uncertainty, object frame. Coarser than a mesh in a
/// file, for it is sent again and again: at most kMaxTriangles.
class DdsSurface {
 public:
  static constexpr std::size_t kMaxTriangles = 20'000;

  [[nodiscard]] posix::ros::Marker Message(ModelSnapshot& snapshot, int id, std::int64_t ros_ns,
                                           const DdsFrames& frames);

 private:
  const std::string namespace_ = "surface";
  const std::string none_;
  float steps_per_cell_ = 4.0F;  ///< Fewer once there were too many triangles.
  std::vector<posix::ros::Point> points_;
  std::vector<posix::ros::ColorRGBA> colours_;
};

}  // namespace disflow::apps
