// SPDX-License-Identifier: BSD-3-Clause
#include "program/status_token.h"

namespace disflow::apps {

const char* StatusToken(Status status) noexcept {
  switch (status) {
    case Status::kOk:
      return "ok";
    case Status::kInvalidConfig:
      return "invalid_config";
    case Status::kInvalidIntrinsics:
      return "invalid_intrinsics";
    case Status::kInvalidImageSize:
      return "invalid_image_size";
    case Status::kImageTooLarge:
      return "image_too_large";
    case Status::kMaskSizeMismatch:
      return "mask_size_mismatch";
    case Status::kEmptyMask:
      return "empty_mask";
    case Status::kNoValidDepth:
      return "no_valid_depth";
    case Status::kTooFewSamples:
      return "too_few_samples";
    case Status::kStampNotIncreasing:
      return "stamp_not_increasing";
    case Status::kInvalidTransform:
      return "invalid_transform";
    case Status::kNotInitialised:
      return "not_initialised";
    case Status::kRegistrationFailed:
      return "registration_failed";
    case Status::kOutOfBounds:
      return "out_of_bounds";
    case Status::kRepeatedImage:
      return "repeated_image";
    case Status::kCapacityExceeded:
      return "capacity_exceeded";
    case Status::kInvalidUri:
      return "invalid_uri";
    case Status::kNotFound:
      return "not_found";
    case Status::kUnsupported:
      return "unsupported";
    case Status::kPermissionDenied:
      return "permission_denied";
    case Status::kBusy:
      return "busy";
    case Status::kDeviceLost:
      return "device_lost";
    case Status::kTimeout:
      return "timeout";
    case Status::kEndOfStream:
      return "end_of_stream";
    case Status::kTruncated:
      return "truncated";
    case Status::kCorrupt:
      return "corrupt";
    case Status::kIoError:
      return "io_error";
    case Status::kWouldBlock:
      return "would_block";
    case Status::kNotOpen:
      return "not_open";
  }
  return "unknown";
}

}  // namespace disflow::apps
