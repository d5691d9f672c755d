// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

/// @file
/// The one numbered list of results, shared by API, log and wire (docs/wire-format.md).

namespace disflow {

/// Result of an operation. The numbers are stable: they leave the board in telemetry.
enum class [[nodiscard]] Status : std::uint8_t{
    kOk = 0,

    // Core: configuration and input frames.
    kInvalidConfig = 1,      ///< A setting is outside its range, see Validate().
    kInvalidIntrinsics = 2,  ///< No lens has this focal length or principal point.
    /// No data; width, height or stride is zero, negative or inconsistent; or the unit_m of a
    /// 16-bit image is 0, negative or not finite.
    kInvalidImageSize = 3,
    kImageTooLarge = 4,       ///< The image exceeds the profile's kMaxImageWidth x kMaxImageHeight.
    kMaskSizeMismatch = 5,    ///< Mask and depth image differ in size.
    kEmptyMask = 6,           ///< The mask marks no pixel.
    kNoValidDepth = 7,        ///< No pixel of the object carries a usable depth.
    kTooFewSamples = 8,       ///< Too few surface samples survived rejection to start or to track.
    kStampNotIncreasing = 9,  ///< The capture stamp stood still or ran backwards.
    kInvalidTransform = 10,   ///< A given transform is not a finite rigid-body motion.

    // Core: tracking.
    kNotInitialised = 16,  ///< No object model exists yet.
    kRegistrationFailed =
        17,             ///< The frame could not be registered to the model; the pose is predicted.
    kOutOfBounds = 18,  ///< A query or sample lies outside of the mapped volume.
    kCapacityExceeded = 19,  ///< A fixed-size store is full; what was dropped is counted.
    kRepeatedImage = 20,     ///< The depth image is the last one once more; the pose is predicted.

    // Hal and platform: devices, files, links.
    kInvalidUri = 32,        ///< A device, sequence or link address cannot be parsed.
    kNotFound = 33,          ///< A file, folder, device or host does not exist.
    kUnsupported = 34,       ///< The device or file offers no format that can be used.
    kPermissionDenied = 35,  ///< The operating system refused access.
    kBusy = 36,              ///< A port or device is in use by another program.
    kDeviceLost = 37,        ///< The device vanished while in use.
    kTimeout = 38,           ///< Nothing arrived within the given time.
    kEndOfStream = 39,       ///< The sequence is over; not an error.
    kTruncated = 40,         ///< A file or message ends too early.
    kCorrupt = 41,           ///< A file or message contradicts its format or checksum.
    kIoError = 42,           ///< Reading or writing failed for another reason.
    kWouldBlock = 43,        ///< A link cannot take the bytes now; nothing was sent.
    kNotOpen = 44,           ///< The device, link or sequence is not open.
};

/// @return A short English description, static storage, never null.
[[nodiscard]] const char* Describe(Status status) noexcept;

/// A value, or the reason why there is none. `value` is meaningful only if ok().
template <class T>
struct [[nodiscard]] Expected {
  T value{};
  Status status = Status::kOk;

  [[nodiscard]] constexpr bool ok() const noexcept { return status == Status::kOk; }
};

}  // namespace disflow
