// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "disflow/config.h"
#include "disflow/depth/depth_frame.h"

namespace disflow::apps {

/// What somebody points at, so that it is tracked from the next frame on.
struct ObjectChoice {
  enum class Kind : std::uint8_t {
    kPixel,  ///< What lies at a place in the image.
    kBox,    ///< The nearest thing in a part of the image.
    kPoint,  ///< What lies at a point in space.
    kMask,   ///< What a mask shows.
  };

  Kind kind = Kind::kPixel;
  // Shares of the image's width and height, from its upper left corner: whoever points at a picture
  // need not know how many pixels the camera has.
  float u = 0.0F;
  float v = 0.0F;
  float reach = 0.0F;  ///< kPixel: surface this near counts as lying there; share of the width.
  float width = 0.0F;  ///< kBox.
  float height = 0.0F;
  Vec3 point_m = Vec3::Zero();  ///< kPoint.
  bool in_world = false;        ///< kPoint: in the frame of DepthFrame::T_wc, else in the camera's.
  std::vector<std::uint8_t> mask;  ///< kMask: row by row, the object not 0.
  int mask_width_px = 0;
  int mask_height_px = 0;
};

/// Where the choice is in a frame's image.
/// @return Nothing if it does not lie there, or if the mask is of another size.
[[nodiscard]] std::optional<ObjectStart> StartIn(const DepthFrame& frame,
                                                 const ObjectChoice& choice) noexcept;

/// Which masks show the object that was chosen.
struct ChosenMasks {
  bool used = false;
  std::uint8_t label = 0;  ///< As MaskView::label.
};

/// A mask that covers the place of the choice goes on showing the object; one that does not, or
/// that the frame comes without, shows something else.
/// @param before What held for the object before.
[[nodiscard]] ChosenMasks MasksOf(const DepthFrame& frame, const ObjectStart& start,
                                  const ChosenMasks& before) noexcept;

}  // namespace disflow::apps
