// SPDX-License-Identifier: BSD-3-Clause
#include "dds/dds_cloud.h"

#include <algorithm>
#include <bit>
#include <span>

#include "surface_mesh.h"

namespace disflow::apps {
namespace {

namespace ros = posix::ros;

constexpr std::uint8_t kFloat32 = 7;        // sensor_msgs/PointField
constexpr std::int32_t kTriangleList = 11;  // visualization_msgs/Marker

}  // namespace

DdsCloud::DdsCloud(std::initializer_list<const char*> fields)
    : names_(fields.begin(), fields.end()) {
  std::uint32_t offset = 0;
  for (const std::string& name : names_) {
    fields_.push_back({posix::Lend(name), offset, kFloat32, 1});
    offset += sizeof(float);
  }
}

void DdsCloud::Add(std::initializer_list<float> point) {
  for (const float value : point) {
    const auto bytes = std::bit_cast<std::array<std::uint8_t, sizeof(float)>>(value);
    data_.insert(data_.end(), bytes.begin(), bytes.end());
  }
}

ros::PointCloud2 DdsCloud::Message(std::int64_t ros_ns, const std::string& frame) {
  ros::PointCloud2 message{};
  message.header = RosHeader(ros_ns, frame);
  message.height = 1;
  message.point_step = static_cast<std::uint32_t>(fields_.size() * sizeof(float));
  message.width = static_cast<std::uint32_t>(data_.size()) / message.point_step;
  message.row_step = static_cast<std::uint32_t>(data_.size());
  message.is_bigendian = std::endian::native == std::endian::big;
  posix::Lend(fields_, message.fields);
  posix::Lend(data_, message.data);
  return message;
}

void DdsModelCloud::DoOnSample(const SurfaceVertex& sample, int) noexcept {
  const Vec3& x_m = sample.position_m;
  const Vec3& n = sample.normal;
  cloud_.Add({x_m.x(), x_m.y(), x_m.z(), n.x(), n.y(), n.z(), sample.std_m});
}

ros::PointCloud2 DdsFlowCloud::Message(const ModelSnapshot& snapshot, std::int64_t ros_ns,
                                       const DdsFrames& frames) {
  cloud_.Clear();
  for (const FlowSample& sample : snapshot.flow().samples()) {
    const Vec3& x_m = sample.position_m;
    const Vec3& g = sample.gradient;
    const Vec3& v = sample.flow_mps;
    cloud_.Add(
        {x_m.x(), x_m.y(), x_m.z(), sample.distance_m, g.x(), g.y(), g.z(), v.x(), v.y(), v.z()});
  }
  // Not dense: d is NaN where the model has no surface.
  return cloud_.Message(ros_ns, frames.camera);
}

ros::Marker DdsSurface::Message(ModelSnapshot& snapshot, int id, std::int64_t ros_ns,
                                const DdsFrames& frames) {
  SurfaceMesh mesh;
  // An empty model gives an empty mesh, which clears what was shown.
  (void)snapshot.ExtractSurface(snapshot.config().field.cell_size_m / steps_per_cell_, mesh);
  const std::size_t count = std::min(mesh.triangles().size(), kMaxTriangles);
  if (count < mesh.triangles().size()) steps_per_cell_ = std::max(0.7F * steps_per_cell_, 1.0F);
  const std::vector<Colour> colours = mesh.Colours();
  points_.clear();
  colours_.clear();
  for (const SurfaceMesh::Triangle& triangle : std::span(mesh.triangles()).first(count)) {
    for (const std::uint32_t i : triangle) {
      const Vec3& x_m = mesh.vertices()[i].position_m;
      const auto share = [&colour = colours[i]](std::size_t channel) {
        return static_cast<float>(colour[channel]) / 255.0F;
      };
      points_.push_back({static_cast<double>(x_m.x()), static_cast<double>(x_m.y()),
                         static_cast<double>(x_m.z())});
      colours_.push_back({share(0), share(1), share(2), 1.0F});
    }
  }
  ros::Marker message{};
  message.header = RosHeader(ros_ns, frames.object);
  message.ns = posix::Lend(namespace_);
  message.id = id;
  message.type = kTriangleList;
  message.pose.orientation.w = 1.0;
  message.scale = {1.0, 1.0, 1.0};
  message.color = {1.0F, 1.0F, 1.0F, 1.0F};
  message.frame_locked = true;  // between two messages it moves with the object
  posix::Lend(points_, message.points);
  posix::Lend(colours_, message.colors);
  for (char** const text :
       {&message.texture_resource, &message.texture.header.frame_id, &message.texture.format,
        &message.text, &message.mesh_resource, &message.mesh_file.filename}) {
    *text = posix::Lend(none_);
  }
  return message;
}

}  // namespace disflow::apps
