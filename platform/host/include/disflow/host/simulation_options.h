// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "disflow/depth/depth_frame.h"
#include "disflow/hal/fault.h"
#include "disflow/host/uri.h"

namespace disflow::host {

enum class ObjectKind : std::uint8_t {
  kBox,
  kBottle,
  kCan,
  kDoughnut,
  kRoundedBox,
  kFlatBox,
  kMug,
  kBowl,
  kTube,
  kSuperellipsoid,
  kScrewdriver,
  kBracket,
  kSprayBottle,
  kObjFile
};
enum class MotionKind : std::uint8_t {
  kStatic,
  kModerate,   ///< Peaks of 0.2 m/s and 90 deg/s.
  kFast,       ///< Peaks of 0.6 m/s and 270 deg/s.
  kRotate360,  ///< One full turn about a nearly vertical axis, back to the start.
  kFlying,     ///< Peaks of 1.2 m/s and 500 deg/s with velocity jumps between frames.
  kLeaving,    ///< Out of the view after a second, back a second later.
};
enum class NoiseKind : std::uint8_t {
  kClean,
  kWhite,  ///< Spread of a D415, independent from pixel to pixel and frame to frame.
  kD415,   ///< The same spread, correlated in space and time; fattened outlines.
  kKinect,
  kTof,        ///< Time of flight.
  kStereo,     ///< Rendered infrared images, matched and refined; needs OpenCV.
  kStereoRaw,  ///< The same, badly matched.
};
enum class OccluderKind : std::uint8_t {
  kNone,
  kArm,      ///< A forearm passes in front and hides up to half of the object.
  kCurtain,  ///< Hides everything from 1.0 to 1.5 s.
  kHand,     ///< Touches the object from 1 to 3 s and moves along with it.
};
enum class SupportKind : std::uint8_t {
  kNone,
  kTable,  ///< The object's lowest point rests on a table top for a second; then it is lifted off.
};
enum class CameraKind : std::uint8_t { kStatic, kMoving };
enum class MaskKind : std::uint8_t {
  kGt,
  kSloppy,   ///< See SloppyMask.
  kLeaking,  ///< Takes in a piece of what is beside the object: table, wall, hand.
  kNone
};

/// How many objects may move before the camera at once.
inline constexpr std::size_t kMaxSimulatedObjects = 4;

struct SimulatedShape {
  ObjectKind object = ObjectKind::kBox;
  std::string obj_file;  ///< With ObjectKind::kObjFile.
};

/// What the simulated camera sees and how well.
struct SimulationOptions {
  ObjectKind object = ObjectKind::kBox;
  std::string obj_file;                 ///< With ObjectKind::kObjFile.
  std::vector<SimulatedShape> further;  ///< Objects behind it, one behind the other.
  double edge_mm = 0.0;    ///< Radius of the edges of rounded and flat boxes; 0 = 4 and 2 mm.
  double bulge_mm = 0.0;   ///< By which the faces of boxes stand out in the middle.
  double uneven_mm = 0.0;  ///< Standard deviation of all surfaces from the drawn ones.
  MotionKind motion = MotionKind::kModerate;
  NoiseKind noise = NoiseKind::kClean;
  std::uint64_t seed = 1;
  int frames = 300;  ///< Moments at which the camera takes an image, dropped ones included.
  double fps = 30.0;
  int width_px = 640;
  int height_px = 360;
  double focal_px = 0.0;  ///< 0 = as Fast-YCB's camera at this width.
  OccluderKind occluder = OccluderKind::kNone;
  SupportKind support = SupportKind::kNone;
  /// The object that is not there from 1 to 2 s, from 1 on; 0 = none.
  int hide = 0;
  /// The object's centre comes no nearer than this; 0: as near as all of it stays in view.
  double distance_m = 0.0;
  double drop = 0.0;    ///< Share of frames that are lost; never the first.
  double repeat = 0.0;  ///< Share of frames that show the image before them again; never the first.
  double jitter_ms = 0.0;   ///< Stamps are off by up to this, and by less than half a period.
  double blank_s = 0.0;     ///< For so long the images have no depth and the masks no pixels.
  double blank_at_s = 3.0;  ///< From then on.
  CameraKind camera = CameraKind::kStatic;
  MaskKind mask = MaskKind::kGt;
  int mask_delay = 0;         ///< The mask is that of so many frames before.
  int mask_grow_px = 0;       ///< The mask reaches too far by this, or not far enough (< 0).
  double mask_flicker = 0.0;  ///< Share of masks that are missing, or miss a large piece.
  DepthFormat format = DepthFormat::kFloat32;
};

/// Square pixels, principal point at half the size.
[[nodiscard]] PinholeCamera SimulatedCamera(const SimulationOptions& options);

/// Sets the option that people call `key`; see SimulationOptionsHelp().
/// @return kInvalidUri naming the key and what is allowed.
[[nodiscard]] hal::Fault SetSimulationOption(std::string_view key, std::string_view value,
                                             SimulationOptions& options);

/// @param name box, bottle, can, ... (the message of what is refused lists them) or obj:FILE;
/// several joined by +, the nearest first.
[[nodiscard]] hal::Fault SetSimulationObject(std::string_view name, SimulationOptions& options);

/// Reads `sim:OBJECT?key=value&...`.
/// @param options Unchanged unless the result is ok.
[[nodiscard]] hal::Fault ParseSimulationUri(const Uri& uri, SimulationOptions& options);

/// "box", "bottle", ... for file names; OBJ files are called by their file name. Of several the
/// first.
[[nodiscard]] std::string ObjectName(const SimulationOptions& options);
/// The names of all objects, each another one: of two boxes the second is "box2".
[[nodiscard]] std::vector<std::string> ObjectNames(const SimulationOptions& options);
/// All objects, the nearest first.
[[nodiscard]] std::vector<SimulatedShape> ObjectShapes(const SimulationOptions& options);

/// @return Every name that SetSimulationObject() takes; obj:FILE is none.
[[nodiscard]] std::vector<std::string_view> ListSimulationObjects();

/// What people are told of an option.
struct SimulationOptionText {
  std::string_view key;
  std::string allowed;  ///< Values, or their range.
};
/// @return Every option that SetSimulationOption() takes.
[[nodiscard]] std::vector<SimulationOptionText> ListSimulationOptions();
/// The keys with their allowed values, one per line.
[[nodiscard]] std::string SimulationOptionsHelp();

}  // namespace disflow::host
