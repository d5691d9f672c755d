// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "flow_cloud.h"
#include "objects/depth_picture.h"
#include "objects/object_choice.h"
#include "program/frame_result.h"
#include "surface_mesh.h"

/// @file
/// What the live view sends to browsers, byte by byte as docs/view.md says.

namespace disflow::apps {

using ViewBytes = std::vector<std::uint8_t>;

enum class ViewMessage : std::uint8_t {
  kHello = 1,
  kStatus = 2,
  kFrames = 3,
  kSurface = 4,
  kFlow = 5,
  kDepth = 6,
  kSettings = 7,
};

/// What a browser asks for; the first byte of its message, the second is the object.
enum class ViewCommand : std::uint8_t {
  kReset = 1,
  kPause = 2,
  kResume = 3,
  kChoose = 4,
  kSet = 5
};

/// Of ViewCommand::kChoose and kSet.
inline constexpr std::size_t kViewLongCommandBytes = 14;

inline constexpr int kViewFormat = 1;
/// Of a frame's record.
inline constexpr std::uint16_t kFrameRecordBytes = 160;
/// Arrows beyond these are left out evenly.
inline constexpr std::size_t kShownFlowSamples = 300;

/// @param json Its text, see view_texts.h.
[[nodiscard]] ViewBytes EncodeText(ViewMessage kind, int object, std::string_view json);
[[nodiscard]] ViewBytes EncodeFrames(int object, std::span<const FrameResult> results);
[[nodiscard]] ViewBytes EncodeSurface(int object, StampNs stamp_ns, const SurfaceMesh& mesh);
[[nodiscard]] ViewBytes EncodeFlow(int object, StampNs stamp_ns, const FlowCloud& flow);
[[nodiscard]] ViewBytes EncodeDepth(int object, const DepthPicture& picture);

/// What ViewCommand::kChoose points at: a place or a box in the image.
/// @return Nothing if the message is too short.
[[nodiscard]] std::optional<ObjectChoice> DecodeChoice(
    std::span<const std::uint8_t> command) noexcept;

/// A setting and the value that somebody wants it to have.
struct ViewSetting {
  std::uint16_t number = 0;  ///< Its place in VisitFields().
  double value = 0.0;
};

/// What ViewCommand::kSet sets.
/// @return Nothing if the message is too short.
[[nodiscard]] std::optional<ViewSetting> DecodeSetting(
    std::span<const std::uint8_t> command) noexcept;

}  // namespace disflow::apps
