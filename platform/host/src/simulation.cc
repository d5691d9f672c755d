// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/host/simulation.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "disflow/host/random.h"
#include "smooth_motion.h"

namespace disflow::host {
namespace {

/// Turns the mesh's longest side upright; then the front towards the camera and the top into view.
Mat3d StartRotation(ObjectKind object, const TriangleMesh& mesh, std::uint64_t seed) {
  Mat3d rotation;
  rotation << 1, 0, 0, 0, 0, -1, 0, 1, 0;  // +z up: the camera's y axis points down
  double tilt_rad = 25.0 * kRadPerDeg;
  const bool is_flat = object == ObjectKind::kDoughnut || object == ObjectKind::kFlatBox ||
                       object == ObjectKind::kBowl || object == ObjectKind::kBracket;
  if (is_flat) tilt_rad = 50.0 * kRadPerDeg;
  if (object == ObjectKind::kObjFile) {
    Vec3d extent = Vec3d::Zero();
    for (const Vec3d& vertex : mesh.vertices) extent = extent.cwiseMax(vertex.cwiseAbs());
    int longest = 0;
    extent.maxCoeff(&longest);
    if (longest == 0) rotation *= ExpSo3(Vec3d(0.0, -0.5 * std::numbers::pi, 0.0));
    // Tall meshes with a y axis along their height have it point down, as Fast-YCB's do.
    if (longest == 1) rotation *= ExpSo3(Vec3d(-0.5 * std::numbers::pi, 0.0, 0.0));
  }
  RandomNumbers random(seed, 5);
  const double yaw_rad = random.Uniform(25.0, 65.0) * kRadPerDeg;
  return ExpSo3(Vec3d(tilt_rad, 0.0, 0.0)) * ExpSo3(Vec3d(0.0, yaw_rad, 0.0)) * rotation;
}

/// A share of the frames, never the first.
std::vector<bool> ChooseFrames(double share, int frames, RandomNumbers random) {
  std::vector<bool> chosen(static_cast<std::size_t>(frames));
  for (std::size_t i = 1; i < chosen.size(); ++i) chosen[i] = random.Uniform() < share;
  return chosen;
}

std::vector<StampNs> ChooseJitter(const SimulationOptions& options) {
  // Stamps keep their order.
  const double most_s = std::min(1e-3 * options.jitter_ms, 0.45 / options.fps);
  RandomNumbers random(options.seed, 14);
  std::vector<StampNs> jitter_ns(static_cast<std::size_t>(options.frames));
  for (StampNs& jitter : jitter_ns) jitter = std::llround(1e9 * random.Uniform(-most_s, most_s));
  return jitter_ns;
}

/// Where an object is in the image at the start, about.
struct Disc {
  Vec3d centre = Vec3d::Zero();  ///< On the plane z = 1.
  double radius = 0.0;
};

/// A seed whose motion starts where the objects before it do not hide much of this one.
std::uint64_t SeedOfFreeStart(MotionSettings settings, std::size_t object, double radius_m,
                              std::vector<Disc>& taken) {
  constexpr std::uint64_t kSeedsPerObject = 1000;
  constexpr double kApart = 0.75;       // of the spheres, which the objects do not fill
  settings.kind = MotionKind::kStatic;  // starts at the same place and is made at once
  const std::uint64_t first = settings.seed + object * kSeedsPerObject;
  Disc best;
  double best_gap = -std::numeric_limits<double>::max();
  std::uint64_t best_seed = first;
  for (std::uint64_t k = 0; k < kSeedsPerObject && best_gap < 0.0; ++k) {
    settings.seed = first + k;
    const Vec3d start_m = MakeObjectMotion(settings)->At(0.0).pose.translation();
    const Disc disc{start_m / start_m.z(), radius_m / start_m.z()};
    double gap = std::numeric_limits<double>::max();
    for (const Disc& other : taken) {
      gap = std::min(gap,
                     (disc.centre - other.centre).norm() - kApart * (disc.radius + other.radius));
    }
    if (gap <= best_gap) continue;
    best_gap = gap;
    best_seed = settings.seed;
    best = disc;
  }
  taken.push_back(best);
  return best_seed;
}

}  // namespace

Simulation::Simulation(const SimulationOptions& options, TriangleMesh mesh)
    : Simulation(options, std::vector<TriangleMesh>{std::move(mesh)}) {}

Simulation::Simulation(const SimulationOptions& options, std::vector<TriangleMesh> meshes)
    : options_(options),
      camera_(SimulatedCamera(options)),
      bodies_(MakeBodies(options, std::move(meshes))),
      renderer_(camera_, options.width_px, options.height_px),
      depth_camera_(MakeDepthCamera(options)),
      dropped_(ChooseFrames(options.drop, options.frames, RandomNumbers(options.seed, 6))),
      repeated_(ChooseFrames(options.repeat, options.frames, RandomNumbers(options.seed, 13))),
      jitter_ns_(ChooseJitter(options)),
      depth_m_(renderer_.labels().size()),
      depth_mm_(options.format == DepthFormat::kUint16 ? depth_m_.size() : 0),
      gt_mask_(depth_m_.size()),
      sloppy_mask_(depth_m_.size()),
      disturbed_mask_(depth_m_.size()),
      exact_(depth_m_.size()) {
  const Body& first = bodies_.front();
  if (options.camera == CameraKind::kMoving) {
    camera_motion_.emplace(first.workspace.centre_m.z(), options.seed);
  }
  if (options.support == SupportKind::kTable) table_up_ = UpFromTable();
  if (options.mask_delay > 0) late_.emplace(camera_, options.width_px, options.height_px);
  if (options.occluder == OccluderKind::kArm) arm_.emplace(first.radius_m, options.seed);
  if (options.occluder == OccluderKind::kHand)
    hand_.emplace(first.mesh, TruthAt(0).object.pose.rotation());
}

std::vector<Simulation::Body> Simulation::MakeBodies(const SimulationOptions& options,
                                                     std::vector<TriangleMesh> meshes) {
  const PinholeCamera camera = SimulatedCamera(options);
  const double margin_m = options.camera == CameraKind::kMoving ? CameraMotion::kViewMargin_m : 0.0;
  std::vector<Body> bodies;
  std::vector<double> radii_m;
  for (TriangleMesh& mesh : meshes) {
    const double radius_m = BoundingRadius(mesh);
    radii_m.push_back(radius_m + margin_m);
    bodies.push_back({.mesh = std::move(mesh),
                      .radius_m = radius_m,
                      .workspace = {},
                      .motion = nullptr,
                      .sloppy = SloppyMask(options.width_px, options.height_px),
                      .disturbance = MaskDisturbance(options, bodies.size())});
  }
  std::vector<Workspace> workspaces = {FitWorkspace(camera, options.width_px, options.height_px,
                                                    radii_m.front(), options.distance_m)};
  if (bodies.size() > 1)
    workspaces =
        StackWorkspaces(camera, options.width_px, options.height_px, radii_m, options.distance_m);
  const std::vector<SimulatedShape> shapes = ObjectShapes(options);
  std::vector<Disc> taken;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    Body& body = bodies[i];
    body.workspace = workspaces[i];
    MotionSettings settings{
        .kind = options.motion,
        .workspace = body.workspace,
        .start_rotation = StartRotation(shapes[i].object, body.mesh, options.seed + i),
        .duration_s = options.frames / options.fps,
        .frame_period_s = 1.0 / options.fps,
        .seed = options.seed};
    if (bodies.size() > 1) settings.seed = SeedOfFreeStart(settings, i, body.radius_m, taken);
    body.motion = MakeObjectMotion(settings);
  }
  return bodies;
}

FrameTruth Simulation::TruthAt(int index, std::size_t object) const {
  const double time_s = index / options_.fps;
  FrameTruth truth;
  // Not zero: a stamp of zero means "not set" to some programs.
  truth.stamp_ns =
      kFirstStamp_ns + std::llround(time_s * 1e9) + jitter_ns_[static_cast<std::size_t>(index)];
  if (camera_motion_) truth.camera = camera_motion_->At(time_s);
  truth.object = SeenFrom(truth.camera, bodies_[object].motion->At(time_s));
  return truth;
}

/// The frame whose image is shown.
int Simulation::SourceOf(int index) const {
  while (index > 0 && (IsRepeated(index) || IsDropped(index))) --index;
  return index;
}

bool Simulation::IsBlank(int index) const {
  const double since_s = index / options_.fps - options_.blank_at_s;
  return since_s >= 0.0 && since_s < options_.blank_s;
}

void Simulation::Blank() {
  std::fill(depth_m_.begin(), depth_m_.end(), 0.0F);
  for (std::vector<std::uint8_t>* mask : {&gt_mask_, &sloppy_mask_, &disturbed_mask_})
    std::fill(mask->begin(), mask->end(), std::uint8_t{0});
}

void Simulation::Render(int index, DepthFrame& frame) {
  const FrameTruth truth = TruthAt(index);
  const int shown = SourceOf(index);
  DrawScene(shown, Vec3d::Zero(), renderer_);
  PlaceSurfaces(shown);
  const SceneView scene{.inverse_depth_per_m = renderer_.inverse_depth_per_m(),
                        .labels = renderer_.labels(),
                        .surfaces = surfaces_,
                        .draw_from = [this, shown](const Vec3d& eye_m, DepthRenderer& renderer) {
                          DrawScene(shown, eye_m, renderer);
                        }};
  depth_camera_->Measure(shown, scene, depth_m_);
  DrawMasks(shown);
  if (HasDisturbedMask()) DisturbMasks(shown);
  if (IsBlank(shown)) Blank();

  frame = DepthFrame{};
  frame.depth = DepthToDeliver();
  frame.camera = camera_;
  frame.stamp_ns = truth.stamp_ns;
  frame.mask = mask();
  frame.has_T_wc = camera_motion_.has_value();
  if (frame.has_T_wc) frame.T_wc = truth.camera.pose.Cast<float>();
}

DepthView Simulation::DepthToDeliver() {
  DepthView view;
  view.width_px = options_.width_px;
  view.height_px = options_.height_px;
  view.format = options_.format;
  if (options_.format == DepthFormat::kFloat32) {
    view.data = depth_m_.data();
  } else {
    constexpr float kMaxUnits = 65535.0F;
    std::transform(depth_m_.begin(), depth_m_.end(), depth_mm_.begin(), [](float depth_m) {
      const float units = std::round(depth_m * 1000.0F);
      return static_cast<std::uint16_t>(units <= kMaxUnits ? units : 0.0F);
    });
    view.data = depth_mm_.data();
  }
  view.stride_bytes = static_cast<std::ptrdiff_t>(view.width_px) * view.bytes_per_pixel();
  return view;
}

MaskView Simulation::ViewOf(std::span<const std::uint8_t> mask) const {
  return {mask.empty() ? nullptr : mask.data(), options_.width_px, options_.height_px,
          options_.width_px};
}

}  // namespace disflow::host
