// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>

#include "disflow/config.h"
#include "disflow/depth/depth_frame.h"
#include "disflow/depth/depth_reader.h"
#include "disflow/depth/mask_band.h"
#include "disflow/depth/model_prior.h"
#include "disflow/depth/pixel_mask.h"
#include "disflow/depth/pixel_runs.h"
#include "disflow/depth/plane_removal.h"
#include "disflow/depth/surface_vote.h"
#include "disflow/depth/valley_cut.h"
#include "disflow/estimate.h"

namespace disflow {

class ModelGate;

/// The part of the image that the settings leave.
[[nodiscard]] PixelBox RegionOfInterest(const DepthFrame& frame,
                                        const SegmenterConfig& config) noexcept;

/// The region and half of it more on every side: what a table does beyond the region tells it from
/// a face that ends there, even if the region is drawn too tightly.
[[nodiscard]] PixelBox Surroundings(const PixelBox& region, const DepthFrame& frame) noexcept;

/// Decides which pixels are the object. The depth image is cut into connected surfaces within reach
/// of the predicted model (or, before there is a model, within range and region of interest); the
/// model and the mask, if one is given, say which of them are the object. A given mask is believed
/// within its tolerance, see mask_band.h.
template <class Limits>
class Segmenter {
 public:
  using Mask = PixelMask<Limits::kMaxImageWidth, Limits::kMaxImageHeight>;

  /// @param explains explains(x_c): whether known surface of the predicted model is near a point of
  /// the camera frame. Only called if prior.known.
  /// @param overrun Where the object's surfaces go on beyond the mask's tolerance. Empty without a
  /// mask.
  template <class Explains>
  [[nodiscard]] Status Segment(const DepthFrame& frame, const SegmenterConfig& config,
                               const ModelPrior& prior, Explains&& explains, Mask& object,
                               MaskOverrun<Mask>& overrun, Counters& counters) noexcept;

  /// How the object of the last image touched what is around it; nothing, under a mask.
  [[nodiscard]] const ObjectContact& contact() const noexcept { return contact_; }
  /// Whether what was drawn lies away from where the object is predicted, see ModelPrior::anywhere.
  [[nodiscard]] bool elsewhere() const noexcept { return elsewhere_; }

 private:
  using Surfaces = PixelRuns<Limits::kMaxRuns, Limits::kMaxImageWidth>;
  static constexpr int kMinPixels = 30;  ///< Of a surface that may be the object.
  /// The mask is evidence too, so the prediction may be farther off.
  static constexpr float kMaskMarginFactor = 2.0F;

  /// How surfaces are looked for.
  struct Manner {
    float margins = 1.0F;     ///< So many margins about the predicted model.
    bool cut = false;         ///< Surfaces end where they fold towards the camera.
    bool whole_face = false;  ///< As far as a whole face of the object may reach out of the model.
  };

  /// Cuts the image into surfaces and chooses among them.
  template <class Explains>
  void Look(const Manner& manner, const DepthFrame& frame, const SegmenterConfig& config,
            const ModelPrior& prior, Explains& explains, const Mask& mask) noexcept;

  /// The same without a mask, in the manner that the object's surroundings ask for, and draws what
  /// was chosen.
  /// @return The runs that were dropped.
  template <class Explains>
  [[nodiscard]] std::uint32_t LookAround(const DepthFrame& frame, const SegmenterConfig& config,
                                         const ModelPrior& prior, Explains& explains,
                                         Mask& object) noexcept;

  /// Draws the surface that is as large as the model and nearest to where that is predicted.
  /// @return Whether there is one.
  template <class Explains>
  [[nodiscard]] bool LookAnywhere(const DepthFrame& frame, const SegmenterConfig& config,
                                  const ModelPrior& prior, Explains& explains,
                                  Mask& object) noexcept;

  /// Connected surfaces of what could be the object.
  void BuildSurfaces(const DepthFrame& frame, const SegmenterConfig& config,
                     const ModelPrior& prior, const Mask& mask) noexcept;
  void BuildFirstSurfaces(const DepthFrame& frame, const SegmenterConfig& config,
                          const DepthReader& depth) noexcept;
  template <class Gate>
  void Connect(const DepthFrame& frame, const SegmenterConfig& config, const DepthReader& depth,
               int fewest_pixels, const Gate& gate) noexcept;

  [[nodiscard]] ModelGate GateOf(const DepthFrame& frame, const SegmenterConfig& config,
                                 const ModelPrior& prior) const noexcept;

  /// Counts where surfaces end for no other reason than that the object cannot be beyond.
  void FindEnds(const DepthFrame& frame, const SegmenterConfig& config,
                const ModelPrior& prior) noexcept;

  /// Whether a surface that may be the object's goes on where the object cannot be.
  [[nodiscard]] bool ObjectGoesOn() noexcept;

  template <class Explains>
  void ChooseSurfaces(const DepthFrame& frame, const SegmenterConfig& config,
                      const ModelPrior& prior, Explains& explains, const Mask& mask) noexcept;

  /// Under a mask. What the mask covers of a surface counts, however far it goes on outside: an
  /// object that touches its table is one surface with it.
  template <class Explains>
  void ChooseMasked(const DepthFrame& frame, const SegmenterConfig& config, const ModelPrior& prior,
                    Explains& explains, const Mask& mask) noexcept;

  /// Before a model exists and without a mask: what lies under the seed pixel, or is nearest and
  /// ends.
  [[nodiscard]] int ChooseFirst(const DepthFrame& frame, const SegmenterConfig& config) noexcept;

  /// Asks the model about every few points of a run.
  template <class Explains>
  static void Probe(const DepthReader& depth, const PinholeCamera& camera, Explains& explains,
                    const PixelRun& run, SurfaceVote& vote) noexcept;
  template <class Explains>
  static void ProbePixel(const DepthReader& depth, const PinholeCamera& camera, Explains& explains,
                         int u, int v, SurfaceVote& vote) noexcept;
  /// The same, of what the mask covers: on a grid, so that runs of any length count alike.
  template <class Explains>
  static void ProbeMasked(const DepthReader& depth, const PinholeCamera& camera, Explains& explains,
                          const PixelRun& run, const Mask& mask, SurfaceVote& vote) noexcept;

  /// visit(v, u_begin, u_end)
  template <class Visitor>
  void ForEachChosenRun(const Visitor& visit) noexcept {
    surfaces_.ForEachRun([&](int c, const PixelRun& run) {
      if (c != Surfaces::kNoComponent && vote(c).chosen) visit(run.v, run.u_begin, run.u_end);
    });
  }

  /// Draws the object anew from the chosen surfaces: those parts that the mask covers, or that the
  /// model explains and the mask's tolerance allows.
  template <class Explains>
  void Redraw(const DepthFrame& frame, const ModelPrior& prior, Explains& explains,
              Mask& object) noexcept;

  [[nodiscard]] SurfaceVote& vote(int component) noexcept {
    return votes_[static_cast<std::size_t>(component)];
  }

  /// What may come into view at once, of half the diagonal of the model's bounds.
  static constexpr float kFacePerSize = 0.6F;
  /// An object that moves otherwise than predicted reaches out of the margin, not out of two.
  static constexpr float kFarMargins = 2.0F;
  /// Sensors lose single pixels; holes shall not count as the object's outline.
  static constexpr int kBridgedGapPx = 3;
  static constexpr int kProbeStepPx = 8;
  static constexpr int kClosingPx = 2;

  Surfaces surfaces_;
  PlaneRemoval planes_;
  ValleyCut<Limits::kMaxImageWidth> valleys_;
  MaskBand<Mask> band_;
  PixelBox box_;
  Manner manner_;
  ObjectContact contact_;
  bool elsewhere_ = false;
  std::array<SurfaceVote, static_cast<std::size_t>(Surfaces::kMaxComponents)> votes_;
};

}  // namespace disflow
