// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What TSDF fusion (Open3D) makes of the same images, masks and poses: the surface that
/// disflow_track's is compared with.

#include <open3d/geometry/Image.h>
#include <open3d/geometry/RGBDImage.h>
#include <open3d/geometry/TriangleMesh.h>
#include <open3d/io/TriangleMeshIO.h>
#include <open3d/pipelines/integration/ScalableTSDFVolume.h>

#include <cstdio>
#include <exception>
#include <limits>
#include <string>

#include "disflow/depth/depth_reader.h"
#include "disflow/host/open_sensor.h"
#include "errors.h"
#include "estimate_csv.h"
#include "object_interior.h"

namespace disflow::apps {
namespace {

namespace o3d = open3d;

constexpr double kVoxel_m = 0.002;
constexpr double kTruncation_m = 4.0 * kVoxel_m;

/// The object's depth in metres, 0 elsewhere.
o3d::geometry::Image MaskedDepth(const DepthFrame& frame) {
  const DepthReader depth(frame.depth, 0.0F, std::numeric_limits<float>::max());
  o3d::geometry::Image image;
  image.Prepare(depth.width_px(), depth.height_px(), 1, sizeof(float));
  for (int v = 0; v < depth.height_px(); ++v) {
    for (int u = 0; u < depth.width_px(); ++u) {
      *image.PointerAt<float>(u, v) =
          bench::IsInterior(frame.mask, u, v) ? depth.AtOrZero(u, v) : 0.0F;
    }
  }
  return image;
}

void Integrate(const DepthFrame& frame, const EstimatedPose& T_co,
               o3d::pipelines::integration::ScalableTSDFVolume& volume) {
  o3d::geometry::RGBDImage image;
  image.depth_ = MaskedDepth(frame);
  const PinholeCamera& camera = frame.camera;
  const o3d::camera::PinholeCameraIntrinsic intrinsic(
      frame.depth.width_px, frame.depth.height_px, static_cast<double>(camera.fx_px),
      static_cast<double>(camera.fy_px), static_cast<double>(camera.cx_px),
      static_cast<double>(camera.cy_px));
  Eigen::Matrix4d extrinsic = Eigen::Matrix4d::Identity();
  extrinsic.topLeftCorner<3, 3>() = T_co.rotation();
  extrinsic.topRightCorner<3, 1>() = T_co.translation();
  volume.Integrate(image, intrinsic, extrinsic);
}

hal::DepthSensor& Open(const std::string& sequence, host::Sensor& sensor) {
  const bool is_address = sequence.find(':') != std::string::npos;
  const std::string address = is_address ? sequence : "replay:" + sequence;
  const hal::Fault fault = host::OpenSensor(address, sensor);
  if (!fault.ok()) throw InputError(fault.message);
  return *sensor.get();
}

/// Frames that the tracker did not register are left out, as in its own model.
void Run(const std::string& sequence, const std::string& csv, const std::string& out) {
  const EstimateTable estimates = LoadEstimates(csv, std::numeric_limits<int>::max());
  host::Sensor sensor;
  hal::DepthSensor& source = Open(sequence, sensor);
  o3d::pipelines::integration::ScalableTSDFVolume volume(
      kVoxel_m, kTruncation_m, o3d::pipelines::integration::TSDFVolumeColorType::NoColor, 16, 1);
  for (const EstimateRow& row : estimates.rows) {
    DepthFrame frame;
    const hal::Fault fault = source.Next(std::numeric_limits<std::int64_t>::max(), frame);
    if (fault.status == Status::kEndOfStream) break;
    if (!fault.ok()) throw InputError(fault.message);
    if (row.status == "ok") Integrate(frame, row.T_co, volume);
  }
  const auto mesh = volume.ExtractTriangleMesh();
  mesh->ComputeVertexNormals();
  if (mesh->triangles_.empty()) throw InputError(csv + ": no frame could be fused");
  if (!o3d::io::WriteTriangleMesh(out, *mesh)) throw OutputError(out, "cannot be written");
}

}  // namespace
}  // namespace disflow::apps

int main(int argc, char** argv) {
  if (argc != 4) {
    std::fprintf(stderr,
                 "usage: tsdf_baseline SEQUENCE TRAJECTORY.csv OUT.ply\n"
                 "Fuses a sequence (a folder or an address as for disflow_track --sensor) with the "
                 "poses of a\ntrajectory, 2 mm voxels.\n");
    return 2;
  }
  try {
    disflow::apps::Run(argv[1], argv[2], argv[3]);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "tsdf_baseline: %s\n", error.what());
    return 3;
  }
  return 0;
}
