// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/status.h"

namespace disflow {

const char* Describe(Status status) noexcept {
  switch (status) {
    case Status::kOk:
      return "ok";
    case Status::kInvalidConfig:
      return "a setting is outside its range";
    case Status::kInvalidIntrinsics:
      return "camera intrinsics are not those of a pinhole camera";
    case Status::kInvalidImageSize:
      return "image width, height or stride is not usable";
    case Status::kImageTooLarge:
      return "the image is larger than the profile's capacity";
    case Status::kMaskSizeMismatch:
      return "mask and depth image differ in size";
    case Status::kEmptyMask:
      return "the mask marks no pixel";
    case Status::kNoValidDepth:
      return "no pixel of the object has a usable depth";
    case Status::kTooFewSamples:
      return "too few surface samples on the object";
    case Status::kStampNotIncreasing:
      return "the capture stamp does not increase";
    case Status::kInvalidTransform:
      return "a given transform is not a finite rigid-body motion";
    case Status::kNotInitialised:
      return "no object model exists yet";
    case Status::kRegistrationFailed:
      return "the frame could not be registered to the model";
    case Status::kOutOfBounds:
      return "outside of the mapped volume";
    case Status::kRepeatedImage:
      return "the depth image is the last one once more";
    case Status::kCapacityExceeded:
      return "a fixed-size store is full";
    case Status::kInvalidUri:
      return "the address cannot be parsed";
    case Status::kNotFound:
      return "not found";
    case Status::kUnsupported:
      return "no usable format";
    case Status::kPermissionDenied:
      return "permission denied";
    case Status::kBusy:
      return "in use by another program";
    case Status::kDeviceLost:
      return "the device vanished";
    case Status::kTimeout:
      return "timed out";
    case Status::kEndOfStream:
      return "end of the sequence";
    case Status::kTruncated:
      return "ends too early";
    case Status::kCorrupt:
      return "contents contradict the format";
    case Status::kIoError:
      return "reading or writing failed";
    case Status::kWouldBlock:
      return "the link cannot take more bytes now";
    case Status::kNotOpen:
      return "not open";
  }
  return "unknown status";
}

}  // namespace disflow
