// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Sequences of frames that no camera gives: images of anything, masks of another size, intrinsics
/// and camera poses without sense, stamps that jump. Whatever comes, the tracker answers with
/// numbers that are finite, with a status that there is, and in the memory that it has.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <memory>
#include <span>
#include <vector>

#include "disflow/tracker.h"
#include "file_in_memory.h"

namespace {

using namespace disflow;
using fuzz::Require;

struct ImageSize {
  int width_px = 0;
  int height_px = 0;
};

/// With sanitizers a frame of this size takes tens of milliseconds.
constexpr int kMaxFrames = 8;
constexpr ImageSize kLargest{127, 97};

/// Of long runs: enough to lose an object, to search it and to start again, more than once.
constexpr int kMaxLongFrames = 200;
constexpr int kMostRepeats = 100;
constexpr ImageSize kLargestOfLong{63, 47};

/// The fuzzer's bytes as numbers; zeros when they have come to their end.
class Choices {
 public:
  explicit Choices(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}
  [[nodiscard]] bool empty() const { return bytes_.empty(); }

  template <class T>
  T Next() {
    T value{};
    const std::size_t size = std::min(sizeof(T), bytes_.size());
    if (size > 0) std::memcpy(&value, bytes_.data(), size);
    bytes_ = bytes_.subspan(size);
    return value;
  }
  /// 0 to bound - 1.
  int Below(int bound) { return Next<std::uint8_t>() % bound; }
  /// One in so many.
  bool Seldom(int one_in) { return Below(one_in) == one_in - 1; }

  /// A number that breaks what was not written for it, or any.
  float AnyFloat() {
    constexpr std::array<float, 10> kHard = {0.0F,
                                             -1.0F,
                                             1e-38F,
                                             1e-30F,
                                             1e30F,
                                             std::numeric_limits<float>::max(),
                                             std::numeric_limits<float>::denorm_min(),
                                             std::numeric_limits<float>::infinity(),
                                             -std::numeric_limits<float>::infinity(),
                                             std::numeric_limits<float>::quiet_NaN()};
    const auto choice = static_cast<std::size_t>(Below(12));
    return choice < kHard.size() ? kHard[choice] : Next<float>();
  }

 private:
  std::span<const std::uint8_t> bytes_;
};

/// A camera that is out of order in every way in which a frame can be.
class BrokenCamera {
 public:
  BrokenCamera(Choices& choices, ImageSize largest) : choices_(choices), largest_(largest) {}

  void ChooseSize() {
    constexpr int kSmallest_px = 8;
    width_ = kSmallest_px + choices_.Below(largest_.width_px + 1 - kSmallest_px);
    height_ = kSmallest_px + choices_.Below(largest_.height_px + 1 - kSmallest_px);
  }
  /// Moves the body in images to come, a little in depth too: the same image once more would be
  /// taken for one.
  void Move(int right_px, int down_px) {
    moved_right_px_ += right_px;
    moved_down_px_ += down_px;
    ++moves_;
  }

  DepthFrame Next() {
    if (width_ == 0 || choices_.Seldom(16)) ChooseSize();
    DepthFrame frame;
    DrawImage(frame);
    ChooseMask(frame);
    frame.camera = {120.0F, 120.0F, 0.5F * static_cast<float>(width_),
                    0.5F * static_cast<float>(height_)};
    if (choices_.Seldom(12)) {
      frame.camera = {choices_.AnyFloat(), choices_.AnyFloat(), choices_.AnyFloat(),
                      choices_.AnyFloat()};
    }
    stamp_ns_ = choices_.Seldom(8) ? choices_.Next<std::int64_t>() : stamp_ns_ + 33'333'333;
    frame.stamp_ns = stamp_ns_;
    ChoosePose(frame);
    return frame;
  }

 private:
  /// A body before a wall, with rectangles of anything in it.
  void DrawImage(DepthFrame& frame) {
    const float wall_m = 1.5F;
    const float body_m = 0.4F + 0.002F * static_cast<float>(choices_.Below(256)) +
                         0.0005F * static_cast<float>(moves_ % 3);
    const float bend = 0.0005F * static_cast<float>(choices_.Below(32) - 16);
    const int left = std::clamp(choices_.Below(width_) + moved_right_px_, 0, width_);
    const int top = std::clamp(choices_.Below(height_) + moved_down_px_, 0, height_);
    const int right = std::min(width_, left + choices_.Below(100));
    const int bottom = std::min(height_, top + choices_.Below(80));
    depth_.assign(static_cast<std::size_t>(width_ * height_), wall_m);
    const float middle = 0.5F * static_cast<float>(left + right);
    for (int v = top; v < bottom; ++v) {
      for (int u = left; u < right; ++u) {
        const float across = static_cast<float>(u) - middle;
        At(u, v) = body_m + bend * across + 0.01F * bend * across * across;
      }
    }
    for (int i = choices_.Below(6); i > 0; --i) Spoil();
    frame.depth = {depth_.data(), width_, height_,
                   static_cast<std::ptrdiff_t>(sizeof(float)) * width_, DepthFormat::kFloat32};
    if (choices_.Seldom(6)) GiveRaw(frame);
  }
  void Spoil() {
    const int left = choices_.Below(width_);
    const int top = choices_.Below(height_);
    const int right = std::min(width_, left + 1 + choices_.Below(24));
    const int bottom = std::min(height_, top + 1 + choices_.Below(24));
    const float value = choices_.AnyFloat();
    const bool rough = choices_.Seldom(3);
    for (int v = top; v < bottom; ++v) {
      for (int u = left; u < right; ++u)
        At(u, v) = rough ? 0.5F + 0.001F * static_cast<float>(choices_.Below(256)) : value;
    }
  }
  /// The same bytes as raw units, with a unit that may be anything.
  void GiveRaw(DepthFrame& frame) {
    frame.depth.format = DepthFormat::kUint16;
    frame.depth.stride_bytes = static_cast<std::ptrdiff_t>(sizeof(std::uint16_t)) * width_;
    frame.depth.unit_m = choices_.Seldom(4) ? choices_.AnyFloat() : 0.0001F;
  }
  void ChooseMask(DepthFrame& frame) {
    const int kind = choices_.Below(8);
    if (kind == 0) return;
    const int width = kind == 1 ? width_ + 1 : width_;
    mask_.assign(static_cast<std::size_t>(width * height_), 0);
    const int first = choices_.Below(height_);
    const int last = std::min(height_, first + choices_.Below(80));
    for (int v = first; v < last; ++v) {
      for (int u = width / 4; u < width; ++u) {
        mask_[static_cast<std::size_t>(v * width + u)] =
            kind == 2 ? choices_.Next<std::uint8_t>() : std::uint8_t{1};
      }
    }
    frame.mask = {mask_.data(), width, height_, width, 0};
    if (kind == 3) frame.mask.label = choices_.Next<std::uint8_t>();
    if (kind == 4) frame.mask = {nullptr, 0, 0, 0, 1};
  }
  void ChoosePose(DepthFrame& frame) {
    frame.has_T_wc = choices_.Seldom(4);
    if (!frame.has_T_wc) return;
    Vec3 position_m(0.1F, 0.0F, 0.0F);
    Mat3 rotation = Mat3::Identity();
    if (choices_.Seldom(2)) position_m[choices_.Below(3)] = choices_.AnyFloat();
    if (choices_.Seldom(2)) rotation(choices_.Below(3), choices_.Below(3)) = choices_.AnyFloat();
    frame.T_wc = Transform<World, Camera>(rotation, position_m);
  }
  float& At(int u, int v) { return depth_[static_cast<std::size_t>(v * width_ + u)]; }

  Choices& choices_;
  ImageSize largest_;
  int moved_right_px_ = 0;
  int moved_down_px_ = 0;
  int moves_ = 0;
  int width_ = 0;
  int height_ = 0;
  StampNs stamp_ns_ = 1'000'000'000;
  std::vector<float> depth_;
  std::vector<std::uint8_t> mask_;
};

void Check(const Estimate& estimate, Status status) {
  Require(estimate.status == status);
  Require(std::strlen(Describe(status)) > 0);
  Require(estimate.T_co.IsFinite());
  Require(estimate.twist.linear_mps.allFinite() && estimate.twist.angular_rps.allFinite());
  Require(estimate.quality <= 100);
  if (status != Status::kOk) return;
  Require(estimate.pose_covariance.allFinite() && estimate.twist_covariance.allFinite());
  Require(estimate.pose_covariance.diagonal().minCoeff() >= 0.0F);
  Require(estimate.twist_covariance.diagonal().minCoeff() >= 0.0F);
}

class Run {
 public:
  Run(Choices& choices, ImageSize largest) : choices_(choices), camera_(choices, largest) {
    Require(tracker_->config_issue().status() == Status::kOk);
  }

  /// Each frame is as its own bytes say.
  void TrackFrameByFrame() {
    for (int i = 0; i < kMaxFrames && !choices_.empty(); ++i) {
      if (i > 0) ResetSeldom();
      Track();
    }
  }

  /// The same bytes say what many frames are, of a body that moves: what takes its time happens.
  void TrackLong() {
    camera_.ChooseSize();
    for (int i = 0; i < kMaxLongFrames && !choices_.empty();) {
      const int end = std::min(kMaxLongFrames, i + 1 + choices_.Below(kMostRepeats));
      const int right_px = choices_.Below(5) - 2;
      const int down_px = choices_.Below(5) - 2;
      ResetSeldom();
      const Choices instruction = choices_;
      for (; i < end; ++i) {
        choices_ = instruction;
        camera_.Move(right_px, down_px);
        Track();
      }
    }
  }

 private:
  static Config Settings() {
    Config config;
    config.sampler.target_blocks = 150;
    config.registration.iterations = 3;
    return config;
  }
  void ResetSeldom() {
    if (choices_.Seldom(32)) tracker_->Reset();
  }
  void Track() {
    const DepthFrame frame = camera_.Next();
    Estimate estimate;
    const Status status = tracker_->Process(frame, estimate);
    Check(estimate, status);
  }

  Choices& choices_;
  BrokenCamera camera_;
  std::unique_ptr<Tracker<profiles::Micro>> tracker_ =
      std::make_unique<Tracker<profiles::Micro>>(Settings());
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Choices choices({data, size});
  if (choices.Seldom(32)) {
    Run(choices, kLargestOfLong).TrackLong();
  } else {
    Run(choices, kLargest).TrackFrameByFrame();
  }
  return 0;
}
