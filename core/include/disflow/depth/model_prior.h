// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "disflow/geometry/transform.h"

namespace disflow {

/// How an object touches what is around it.
struct ObjectContact {
  bool touches = false;     ///< It stands on something or leans against it.
  bool merged = false;      ///< And could not be told from that: what is new may not be its own.
  float turned_rad = 0.0F;  ///< By how much it has turned since it could; 0 if it can.
};

/// What is known of the object before a frame is segmented: its predicted pose and extent.
struct ModelPrior {
  bool known = false;
  bool doubtful = false;          ///< The prediction may be far off: the object was lost.
  bool anywhere = false;          ///< Without a mask it is looked for in all of the image.
  float unseen_s = 0.0F;          ///< How long ago it was seen last.
  PoseObjectFromCamera T_oc;      ///< Predicted.
  Vec3 box_min_m = Vec3::Zero();  ///< Axis-aligned bounds of the model, object frame.
  Vec3 box_max_m = Vec3::Zero();
  ObjectContact contact;  ///< In the last frame, but turned_rad: up to this one.
  /// How far the object may have moved in the image since its mask was made.
  float motion_px = 0.0F;
  /// Before it is known: what was nearest, and nothing else, was tried last, in vain.
  bool nearest_in_vain = false;
};

}  // namespace disflow
