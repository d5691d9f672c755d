// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "disflow/config.h"
#include "disflow/depth/depth_frame.h"
#include "disflow/depth/depth_reader.h"
#include "disflow/depth/image_repeats.h"
#include "disflow/depth/outline_scale.h"
#include "disflow/depth/seen_space.h"
#include "disflow/depth/segmenter.h"
#include "disflow/depth/surface_sampler.h"
#include "disflow/estimate.h"
#include "disflow/field/distance_field.h"
#include "disflow/field/edge_map.h"
#include "disflow/flow/first_view.h"
#include "disflow/flow/free_axis.h"
#include "disflow/flow/place_slip.h"
#include "disflow/flow/pose_noise.h"
#include "disflow/flow/recognition.h"
#include "disflow/flow/registration.h"
#include "disflow/flow/tracking_monitor.h"
#include "disflow/flow/twist_filter.h"
#include "disflow/late_stamps.h"
#include "disflow/limits.h"
#include "disflow/memory/stage_scratch.h"
#include "disflow/status.h"

namespace disflow {

struct ModelAgreement;
struct PoseSearchPrior;
class StageStopwatch;

/// Tracks and reconstructs one rigid object (the paper's section V). Owns all of its memory by
/// value and never allocates: `static Tracker<profiles::Edge> tracker;` lives in .bss. Too large
/// for most stacks (docs/memory.md). Not thread-safe; one instance per object.
/// @tparam Limits A profile of limits.h. For a profile of your own include tracker_impl.h in one
/// source file.
template <CapacityProfile Limits>
class Tracker {
 public:
  using Field = DistanceField<Limits>;

  /// @param config Checked; see config_issue(). Process() refuses to work with an invalid one.
  explicit Tracker(const Config& config = Config{}) noexcept;
  Tracker(const Tracker&) = delete;
  Tracker& operator=(const Tracker&) = delete;

  /// The whole pipeline on one frame: segment, sample, predict, register, filter, fuse, retrain.
  /// @param estimate Always written completely. Its pose and twist are predictions if the status is
  /// not ok: for the frame's capture time, or for that of the last frame taken if the frame's does
  /// not increase. The covariances of predictions grow with the time since the pose was last
  /// registered.
  /// @return Same as estimate.status. A refused frame changes nothing but the counters; but a clock
  /// that was set back for good, see LateStamps, starts a new object, as after Reset().
  Status Process(const DepthFrame& frame, Estimate& estimate, StageClock clock = {}) noexcept;

  /// Fuses a frame whose pose is known (turntable, robot arm) instead of estimating it. The object
  /// frame is the caller's. Not to be mixed with Process() on the same object. Once an object has
  /// been seen the estimate's pose is the given one, whether or not it is seen in this frame,
  /// unless the frame is refused: kInvalidTransform if T_oc is no rigid motion.
  Status Fuse(const DepthFrame& frame, const PoseObjectFromCamera& T_oc, Estimate& estimate,
              StageClock clock = {}) noexcept;

  /// Forgets the object; the next frame starts a new one, of whatever stamp, and has a higher
  /// reset_counter.
  void Reset() noexcept;

  /// Forgets the object for another one, which the next frame starts where somebody points, in
  /// place of what the settings said; so does every start after it.
  /// @return kInvalidConfig, and nothing changes, if a value is out of its range, see Validate().
  [[nodiscard]] Status Choose(const ObjectStart& start) noexcept;

  /// Takes new settings between two frames and keeps the object. Those that VisitFields() does not
  /// mark as at_run_time stay as they are.
  /// @return kInvalidConfig, and nothing changes, if what comes of it is invalid, see Validate().
  [[nodiscard]] Status Adjust(const Config& config) noexcept;

  [[nodiscard]] const ConfigIssue& config_issue() const noexcept { return config_issue_; }
  /// The reconstructed surface; see also surface_extractor.h.
  [[nodiscard]] const Field& field() const noexcept { return field_; }
  [[nodiscard]] const Config& config() const noexcept { return config_; }
  /// Surface seen in the frame processed last, camera frame; see also distance_flow.h.
  [[nodiscard]] const typename SurfaceSampler<Limits>::Samples& last_samples() const noexcept {
    return samples_;
  }
  /// Pixels of that frame that were taken for the object.
  [[nodiscard]] const typename Segmenter<Limits>::Mask& last_mask() const noexcept {
    return object_mask_;
  }
  /// Sums of Estimate::rejected since construction, saturating.
  [[nodiscard]] const Counters& totals() const noexcept { return totals_; }

 private:
  static constexpr std::uint32_t kInitialFrames =
      5;  ///< Frames after a start during which training catches up.
  static constexpr std::uint32_t kFramesUntilVelocity = 3;
  /// Frames in which a lost object is looked for near where it should be, before it is looked for
  /// turned anyhow.
  static constexpr int kLocalSearches = 2;
  static constexpr int kInitialBudgetFactor = 12;
  static constexpr int kFramesUntilObserved = 3;
  static constexpr int kMostForgotten = 64;  ///< Clusters per frame; the rest goes in the next.
  using Handles = FixedVector<Handle, kMostForgotten>;
  static constexpr float kFade_s = 0.5F;  ///< Time constant of a velocity that nothing tells.
  /// Longer repeats are no hiccup of a driver: the scene stands still, or the camera hangs.
  static constexpr StampNs kLongestHiccup_ns = 100'000'000;
  static constexpr float kDefinedPoseVariance = 1e-10F;  ///< (0.01 mm)^2 and (0.01 mrad)^2.
  static constexpr float kKnownPoseVariance = 1e-8F;

  using Aligned = typename Registration<Limits>::Result;

  struct PoseCovariance {
    bool solved = false;
    Mat6 registered = Mat6::Zero();  ///< Of the registration alone, about its centre, object axes.
    Mat6 white = Mat6::Zero();       ///< What changes from frame to frame.
    Mat6 to_model = Mat6::Zero();    ///< Relative to the model.
    Mat6 reported = Mat6::Zero();    ///< With the drift of the model since its first view.
    Mat6 twist_unobserved = Mat6::Zero();  ///< Of the twist, along what no surface tells.
    Mat6 unobserved_o = Mat6::Zero();      ///< The same as this frame says it, in object axes.
    Mat6 free_turn_o = Mat6::Zero();
    bool complete = true;  ///< The frame tells of all directions.
    bool unheld = false;   ///< Along one that it does not tell of the object may lie elsewhere.
    Mat6 free_shift_o = Mat6::Zero();  ///< Along what, as far as in a second, object axes.
    float unobserved_s = 0.0F;
    Mat6 registered_o = Mat6::Zero();  ///< Of the registration, of the origin, object axes.
    float outline_m = 0.0F;            ///< What all of an outline is off by, at the object.
    float piece_m2 = 0.0F;             ///< Variance of the place of new surface.
  };

  void Begin(const DepthFrame& frame, Estimate& estimate) noexcept;
  [[nodiscard]] Status Check(const DepthFrame& frame) const noexcept;
  [[nodiscard]] DepthReader UsableDepth(const DepthFrame& frame) const noexcept;
  [[nodiscard]] ModelAgreement AgreementWith(const DepthFrame& frame,
                                             const PoseObjectFromCamera& T_oc) const noexcept;
  [[nodiscard]] Status Observe(const DepthFrame& frame, Estimate& estimate,
                               StageStopwatch& stopwatch, bool doubtful) noexcept;
  void StartAt(StampNs stamp_ns, const PoseObjectFromCamera& T_oc, float variance) noexcept;
  void StartObject(const DepthFrame& frame) noexcept;
  [[nodiscard]] bool IsRoom(const DepthFrame& frame) const noexcept;
  void StartField(const DepthFrame& frame) noexcept;
  [[nodiscard]] Aligned Register(const DepthFrame& frame, Estimate& estimate) noexcept;
  [[nodiscard]] Status Conclude(const DepthFrame& frame, Status observed, const Aligned& aligned,
                                Estimate& estimate) noexcept;
  [[nodiscard]] bool IsTurnFree(StampNs stamp_ns) const noexcept;
  [[nodiscard]] FreeShift NextFreeShift() noexcept;
  [[nodiscard]] Aligned FindShift(Registration<Limits>& registration, const Aligned& aligned,
                                  RobustScale scale) noexcept;
  [[nodiscard]] Aligned FindTurn(const DepthFrame& frame, Registration<Limits>& registration,
                                 const Aligned& aligned, RobustScale scale, float& score) noexcept;
  void Forget(Handles& forgotten, Estimate& estimate) noexcept;
  template <class Marked>
  void ForgetAll(const Marked& marked, Estimate& estimate) noexcept;
  void ForgetFoundTurnFree(Estimate& estimate) noexcept;
  void ForgetFoundShiftFree(Estimate& estimate) noexcept;
  [[nodiscard]] bool FitsModel(const Vec3& center_c) const noexcept;
  void Follow(StampNs stamp_ns, const Aligned& aligned, const PoseCovariance& covariance,
              bool found_again, Estimate& estimate) noexcept;
  [[nodiscard]] bool LooksElsewhere(const DepthFrame& frame) const noexcept;
  [[nodiscard]] ModelPrior PriorOf(const DepthFrame& frame, bool doubtful) noexcept;
  [[nodiscard]] PoseSearchPrior SearchPrior(StampNs stamp_ns) const noexcept;
  [[nodiscard]] PoseCameraFromObject Predict(const DepthFrame& frame) const noexcept;
  [[nodiscard]] bool IsSameObjectFrame(const DepthFrame& frame,
                                       const PoseObjectFromCamera& T_oc) const noexcept;
  [[nodiscard]] Mat6 CoastedCovariance(StampNs stamp_ns) const noexcept;
  void Coast(StampNs stamp_ns, Estimate& estimate) const noexcept;
  [[nodiscard]] Mat6 Steadied(const Mat6& unobserved_o, const Mat6& free_turn_o) const noexcept;
  [[nodiscard]] Mat6 TwistCovariance(const TwistFilter& filter,
                                     const Mat6& pose_covariance) const noexcept;
  [[nodiscard]] bool IsHeldBy(RegistrationInformation known) const noexcept;
  [[nodiscard]] PoseCovariance CovarianceOf(const Aligned& aligned,
                                            const DepthFrame& frame) const noexcept;
  [[nodiscard]] bool IsForeign(const Vec3& x_o) const noexcept;
  void RememberView(const DepthFrame& frame) noexcept;
  void ForgetContradicted(const DepthFrame& frame, const PoseObjectFromCamera& T_oc,
                          Estimate& estimate) noexcept;
  [[nodiscard]] float ImageSpeed(const DepthFrame& frame) const noexcept;
  [[nodiscard]] bool TellsNothingNew(const DepthFrame& frame, Estimate& estimate) noexcept;
  Status Bridge(const DepthFrame& frame, Estimate& estimate) noexcept;
  [[nodiscard]] bool MayGoOn(const PixelAt& px, const DepthFrame& frame) const noexcept;
  [[nodiscard]] bool IsThinnerThanTolerance(const DepthFrame& frame) const noexcept;
  void FuseObservations(const DepthFrame& frame, Estimate& estimate) noexcept;
  void MoveTo(StampNs stamp_ns, const PoseObjectFromCamera& T_oc) noexcept;
  void Retrain(Estimate& estimate) noexcept;
  Status Refuse(Status status, const DepthFrame& frame, Estimate& estimate) noexcept;
  Status Finish(Status status, const DepthFrame& frame, Estimate& estimate) noexcept;
  void Forget() noexcept;
  void StartAnew() noexcept;
  void Report(const PoseCameraFromObject& T_co, Estimate& estimate) const noexcept;

  Config config_;
  ConfigIssue config_issue_;
  Counters totals_;
  bool started_ = false;  ///< An object frame exists.
  bool nearest_in_vain_ = false;
  std::uint8_t reset_counter_ = 0;
  std::uint32_t frame_index_ = 0;  ///< Frames since the object frame was started.
  ImageRepeats repeats_;
  bool has_stamp_ = false;
  LateStamps late_;
  StampNs last_stamp_ns_ = 0;
  PoseObjectFromCamera T_oc_;           ///< Latest registered or predicted pose.
  PoseObjectFromCamera T_oc_previous_;  ///< Of the last registered frame.

  Mat6 registered_covariance_ = Mat6::Zero();  ///< Of the last registered pose.
  float gradient_variance_rad2_ = 0.0F;  ///< Of the model's normals, as the last frames saw it.
  Mat6 unobserved_o_ = Mat6::Zero();  ///< What the surface did not tell of its twist, object axes.
  Mat6 free_turn_o_ = Mat6::Zero();   ///< What of it is a turn about an axis of the object's own.
  bool unheld_ = false;               ///< Nothing held the last registered pose in its place.
  PlaceSlip slip_;
  FirstView first_view_;
  FreeAxis free_axis_;
  int observed_frames_ = 0;  ///< In a row that told of all directions, up to kFramesUntilObserved.
  StampNs observed_ns_ = 0;  ///< When the surface last told the pose in all directions.

  typename Segmenter<Limits>::Mask object_mask_;
  MaskOverrun<typename Segmenter<Limits>::Mask> overrun_;
  ObjectContact contact_;
  StageScratch<Segmenter<Limits>, SurfaceSampler<Limits>, Registration<Limits>> scratch_;
  typename SurfaceSampler<Limits>::Samples samples_;
  typename Registration<Limits>::Edges edges_;
  SampledOutline outline_;  ///< That they are on.
  OutlineScale outline_scale_;
  KernelWidth kernel_width_;
  Field field_;
  EdgeMap<Limits::kMaxModelEdges> model_edges_;
  SeenSpace<Limits::kMaxSeenViews, Limits::kSeenCells> seen_;
  TwistFilter twist_filter_;
  PoseNoise pose_noise_;
  bool elsewhere_ = false;  ///< What was observed lies away from where the object is predicted.
  bool recognised_elsewhere_ = false;  ///< So does what recognition_ holds.
  bool in_view_ = false;  ///< Something was where it is predicted, when that was looked at last.
  int global_part_ = 0;   ///< Of a search in all directions, the next.
  int turn_part_ = 0;     ///< The same of a round about an axis.
  TrackingMonitor monitor_;
  Recognition recognition_;
};

// The library has the members of the shipped profiles' trackers. To declare so here would lay out
// all three in every file that includes this one, which costs a tenth of what Eigen does.

}  // namespace disflow
