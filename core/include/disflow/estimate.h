// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>

#include "disflow/geometry/transform.h"
#include "disflow/status.h"
#include "disflow/types.h"

namespace disflow {

enum class TrackingState : std::uint8_t {
  kInitialising = 0,  ///< The first frames: the model is being started.
  kTracking = 1,      ///< The pose is registered and trustworthy.
  kDegraded = 2,      ///< Registered with few inliers or a poor fit; use the covariance.
  /// The pose is only predicted; do not act on it. Also of a frame that is refused for
  /// anything but its stamp, more than 0.15 s after the last registered one.
  kLost = 3,
  kRecovered = 4,  ///< First frames after a loss in which the same object frame was found again.
};

/// @return Lower-case name, static storage.
[[nodiscard]] const char* Name(TrackingState state) noexcept;

/// What was dropped and why, counted. Saturating, so that no counter ever wraps to a small number.
struct Counters {
  std::uint32_t frames = 0;               ///< Frames given to Process().
  std::uint32_t frames_rejected = 0;      ///< Frames refused with a Status before registration.
  std::uint32_t frames_unregistered = 0;  ///< Frames that were taken but not registered.
  /// Images that were the one before once more. Where the object should have moved meanwhile,
  /// nothing but the prediction is made of them.
  std::uint32_t images_repeated = 0;
  std::uint32_t pixels_out_of_range =
      0;  ///< Object pixels without depth, not finite or outside of the range gate.
  std::uint32_t runs_dropped = 0;    ///< Pixel runs beyond the segmenter's capacity.
  std::uint32_t blocks_sparse = 0;   ///< Blocks with too few valid pixels.
  std::uint32_t blocks_grazing = 0;  ///< Blocks seen at too flat an angle.
  std::uint32_t blocks_flying = 0;   ///< Blocks that fit no plane: flying pixels, creases, clutter.
  std::uint32_t samples_dropped = 0;  ///< Surface samples beyond capacity.
  std::uint32_t residuals_unmatched =
      0;  ///< Samples with no model surface nearby in the last step.
  std::uint32_t residuals_truncated =
      0;  ///< Samples beyond the truncation distance in the last step.
  std::uint32_t residuals_normal_mismatch =
      0;                                    ///< Samples whose normal disagrees in the last step.
  std::uint32_t observations_rejected = 0;  ///< Observations not fused: too far from known surface.
  std::uint32_t observations_out_of_bounds = 0;  ///< Observations outside of the mapped volume.
  /// New samples refused since their cluster is full, or no room could be made for one.
  std::uint32_t samples_refused = 0;
  std::uint32_t clusters_evicted = 0;    ///< The stalest clusters, removed to make room.
  std::uint32_t clusters_forgotten = 0;  ///< Those that later frames looked through or never saw.
  std::uint32_t edges_refused = 0;  ///< Occluding-edge samples refused since the store is full.
  /// Samples that a local GP could have been trained on, beyond those that were considered.
  std::uint32_t candidates_dropped = 0;

  static constexpr int kCount = 20;
  /// Adds `other` to this, saturating.
  void Accumulate(const Counters& other) noexcept;
};

/// Velocity of the object relative to the camera, in camera axes, at the capture time.
struct Twist {
  Vec3 linear_mps = Vec3::Zero();   ///< v, of the object frame's origin.
  Vec3 angular_rps = Vec3::Zero();  ///< omega, rad/s.
};

enum class WeakKind : std::uint8_t {
  kNone = 0,         ///< All six directions are well observed.
  kTranslation = 1,  ///< The position along an axis is not, as along a bare plane.
  kRotation = 2,     ///< The rotation about an axis is not, as of a can.
};
/// @return Lower-case name, static storage.
[[nodiscard]] const char* Name(WeakKind kind) noexcept;

/// The direction in which what is seen of the object's surface says least about the pose.
struct WeakDirection {
  WeakKind kind = WeakKind::kNone;
  Vec3 axis = Vec3::Zero();  ///< Unit vector in camera axes, either sign; zero with kNone.
  float std = 0.0F;          ///< Standard deviation along or about it, m or rad; 0 with kNone.
};

/// Pipeline stages in the order in which a frame passes them.
enum class Stage : std::uint8_t { kSegment, kSample, kRegister, kFilter, kFuse, kRetrain };
inline constexpr int kStageCount = 6;
/// @return Lower-case name, static storage.
[[nodiscard]] const char* Name(Stage stage) noexcept;

/// A clock lent by the caller: core has none. Null = stages are not timed.
struct StageClock {
  std::int64_t (*now_ns)(void* context) = nullptr;
  void* context = nullptr;
};

/// All that one frame yields.
struct Estimate {
  Status status =
      Status::kNotInitialised;  ///< Of this frame. Not ok: pose and twist are predictions.
  TrackingState state = TrackingState::kInitialising;
  /// What pose and twist are for: the frame's capture time. If that does not increase
  /// (kStampNotIncreasing), the stamp of the last frame that was taken.
  StampNs stamp_ns = 0;

  PoseCameraFromObject T_co;  ///< Pose of the object in the camera frame.
  bool has_T_wo = false;
  Transform<World, Object> T_wo;  ///< Pose of the object in the world, valid if has_T_wo.
  Twist twist;

  /// Covariance of the pose: (position of the object's origin [m], rotation vector [rad]) in camera
  /// axes. All zeros: no pose has been measured yet.
  Mat6 pose_covariance = Mat6::Zero();
  /// Covariance of (linear_mps, angular_rps).
  Mat6 twist_covariance = Mat6::Zero();
  /// Named when its standard deviation exceeds monitor.weak_std_m or weak_std_rad.
  WeakDirection weak;

  /// 0 = not usable, 100 = best. Of a refused frame: as state, that of the last frame taken until
  /// the object counts as kLost, then 0.
  std::uint8_t quality = 0;
  std::uint8_t reset_counter = 0;  ///< Bumped whenever the object frame starts anew.
  float score = 0.0F;              ///< Share of observed samples that the model explains, 0..1.
  float conflict = 0.0F;      ///< Share of the model's visible points that are not there, 0..1.
  float visible = 0.0F;       ///< Share of the model's front that is in view and not hidden.
  std::uint16_t samples = 0;  ///< Surface samples seen in this frame.
  std::uint16_t inliers = 0;  ///< Samples that supported the pose.
  std::uint16_t edge_inliers = 0;        ///< Occluding-edge points that supported the pose.
  std::uint8_t hypotheses = 0;           ///< Starting poses tried.
  std::uint8_t iterations = 0;           ///< Closed-form steps of the final registration.
  float rms_m = 0.0F;                    ///< Root mean square of the inliers' distances.
  float inverse_depth_std_per_m = 0.0F;  ///< Sensor noise used for this frame.

  Counters rejected;                                 ///< Of this frame alone.
  std::array<std::int64_t, kStageCount> stage_ns{};  ///< Time per stage, if a StageClock was given.
};

/// What an estimate may be used for. Whatever leaves the program does so by this and nothing else;
/// docs/wire-format.md has the table of what each channel makes of it.
enum class EstimateKind : std::uint8_t {
  /// The frame was registered: pose and twist are of its capture time. For control, and for other
  /// filters to fuse.
  kMeasured,
  /// The frame was not registered: pose and twist are predicted to its capture time, with a
  /// covariance that grows. For displays and for bridging a short gap; never to be fused, since
  /// nothing has been seen.
  kPredicted,
  /// Nothing is known at this time: there is no model yet, the stamp does not increase, the frame
  /// could not be read, or a number is not finite. For counting only.
  kRefused,
};
/// @return Lower-case name, static storage.
[[nodiscard]] const char* Name(EstimateKind kind) noexcept;

[[nodiscard]] EstimateKind KindOf(const Estimate& estimate) noexcept;

/// What may leave of an estimate, through any channel. That of a refused one is told from a pose by
/// everybody: pose, twist and covariances are NaN, the quality is 0.
[[nodiscard]] Estimate Published(const Estimate& estimate) noexcept;

}  // namespace disflow
