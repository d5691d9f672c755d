// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "disflow/config.h"
#include "disflow/estimate.h"

namespace disflow {

/// Judges every frame: initialising, tracking, degraded, lost, recovered, and a quality from 0 to
/// 100.
class TrackingMonitor {
 public:
  /// What one frame offered as evidence.
  struct Evidence {
    bool registered = false;
    bool in_view = false;            ///< Surface was observed that may be the object's.
    float score = 0.0F;              ///< Share of observed samples that the model explains.
    float conflict = 0.0F;           ///< Share of the model's visible points that are not there.
    float resolved_conflict = 0.0F;  ///< The same without what is narrower than cameras resolve.
    float visible = 0.0F;            ///< Share of the model's front that is in view and not hidden.
    int inliers = 0;
    int points = 0;               ///< Samples that were registered.
    float position_std_m = 0.0F;  ///< In the worst direction, as reported.
    float rotation_std_rad = 0.0F;
    /// The same relative to the model, wherever that is.
    float position_to_model_std_m = 0.0F;
    float rotation_to_model_std_rad = 0.0F;
  };

  void Start(const MonitorConfig& config, StampNs stamp_ns) noexcept;
  /// What was started from is known to be the object: its pose was given.
  void Confirm() noexcept { confirmed_ = true; }
  /// Only this share of what the first frame showed became part of the model: no more than that can
  /// be explained by it at first.
  void Expect(float share) noexcept {
    usual_.score = share;
    usual_.inlier_share = share;
  }
  /// Whether that is so, or a frame has agreed with it since.
  [[nodiscard]] bool confirmed() const noexcept { return confirmed_; }
  /// From now on.
  void Adjust(const MonitorConfig& config) noexcept { config_ = config; }
  /// Whether a registration result is good enough to be believed at all. After frames that were
  /// not, more is asked for: the pose was searched for instead of followed.
  [[nodiscard]] bool Accepts(const Evidence& evidence, StampNs stamp_ns) const noexcept;
  /// Whether the model at a pose explains the frame about as well as usual, whatever else the model
  /// claims.
  [[nodiscard]] bool Explains(const Evidence& evidence) const noexcept;
  void Update(const Evidence& evidence, StampNs stamp_ns) noexcept;

  [[nodiscard]] TrackingState state() const noexcept { return state_; }
  [[nodiscard]] std::uint8_t quality() const noexcept { return quality_; }
  /// Whether the prediction for a frame is doubtful: the last frames could not be registered, or
  /// none came for a long time.
  [[nodiscard]] bool Doubts(StampNs stamp_ns) const noexcept {
    return missed_ > 0 || IsOverdue(stamp_ns);
  }
  /// Whether nothing has been registered for a long time, whatever the reason.
  [[nodiscard]] bool IsOverdue(StampNs stamp_ns) const noexcept {
    return SpanNs(last_registered_ns_, stamp_ns) > kLongGap_ns;
  }
  /// Whether the last pose, though followed, may have slid: the image contradicts it.
  [[nodiscard]] bool contradicted() const noexcept { return contradicted_; }
  /// Frames in a row, up to now, that could not be registered.
  [[nodiscard]] int missed() const noexcept { return missed_; }
  /// Frames that showed something in which the object was looked for in vain, since it was lost.
  [[nodiscard]] int searched() const noexcept { return searched_; }
  /// Whether a pose that may be any is beyond doubt: the model explains the frame as well as it did
  /// before the loss, the frame contradicts the model as little, and no direction is left open.
  [[nodiscard]] bool Recognises(const Evidence& evidence) const noexcept;
  /// Whether a pose that may be any is near enough to that to be looked at again.
  [[nodiscard]] bool Suspects(const Evidence& evidence) const noexcept;
  /// Something has been in view for so long without being recognised that the object should be
  /// started anew. While nothing is in view its model is kept, unless no frame ever agreed with it:
  /// what one frame showed alone was no object, and there is nothing to lose.
  [[nodiscard]] bool ShouldRestart() const noexcept;

 private:
  static constexpr int kInitialFrames = 5;
  static constexpr int kRecoveryFrames = 5;
  static constexpr StampNs kLongGap_ns = 150'000'000;

  /// Averages over the frames that were tracked, beginning with what a perfect sensor shows.
  struct Usual {
    float score = 1.0F;
    float conflict = 0.0F;
    float inlier_share = 1.0F;

    void Follow(const Evidence& evidence) noexcept;
  };

  [[nodiscard]] bool ExplainsUsually(const Evidence& evidence, float inliers) const noexcept;
  [[nodiscard]] bool Trusts(const Evidence& evidence) const noexcept;
  [[nodiscard]] TrackingState AfterRegistered(const Evidence& evidence) const noexcept;
  [[nodiscard]] std::uint8_t Grade(const Evidence& evidence) const noexcept;

  MonitorConfig config_{};
  Usual usual_;
  TrackingState state_ = TrackingState::kInitialising;
  std::uint8_t quality_ = 0;
  bool contradicted_ = false;
  bool confirmed_ = false;
  int frames_in_state_ = 0;
  int missed_ = 0;
  int searched_ = 0;
  StampNs searched_ns_ = 0;  ///< How long.
  StampNs updated_ns_ = 0;
  StampNs last_registered_ns_ = 0;
};

}  // namespace disflow
