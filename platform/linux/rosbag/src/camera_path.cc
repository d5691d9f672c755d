// SPDX-License-Identifier: BSD-3-Clause
#include "camera_path.h"

#include "disflow/posix/shown_text.h"

namespace disflow::posix {
namespace {

using hal::Fault;

/// Adds what a topic's next message says.
Fault AddNext(TopicStream& stream, bool fixed, RosTransforms& transforms) {
  BagMessage message;
  Fault fault = stream.Next(message);
  if (!fault.ok()) return fault;
  std::vector<RosTransform> said;
  fault = ReadTransforms(message, said);
  for (const RosTransform& transform : said) transforms.Add(transform, fixed);
  return fault;
}

bool IsDamaged(const Fault& fault) {
  return fault.status == Status::kCorrupt || fault.status == Status::kTruncated;
}

}  // namespace

Fault CameraPath::Open(const std::vector<std::filesystem::path>& files, const std::string& world,
                       const std::string& camera) {
  world_ = world;
  camera_ = camera;
  fixed_.emplace(world, camera);
  Fault fault = stream_.Open(files, "/tf_static");
  while (fault.ok() || IsDamaged(fault)) fault = AddNext(stream_, /*fixed=*/true, *fixed_);
  return fault.status == Status::kEndOfStream ? Restart(files) : fault;
}

Fault CameraPath::Restart(const std::vector<std::filesystem::path>& files) {
  transforms_ = fixed_;
  history_.emplace(hal::CameraPoseHistory::Settings{});
  if (const Fault fault = stream_.Open(files, "/tf"); !fault.ok()) return fault;
  const Fault fault = Take();
  if (fault.status != Status::kEndOfStream) return fault;
  return hal::MakeFault(Status::kNotFound, "%s: its /tf and /tf_static do not lead from %s to %s",
                        files.front().c_str(), ShownText(world_, 64).c_str(),
                        ShownText(camera_, 64).c_str());
}

Fault CameraPath::Take() {
  for (next_.reset(); !next_;) {
    const Fault fault = AddNext(stream_, /*fixed=*/false, *transforms_);
    if (!fault.ok() && !IsDamaged(fault)) return fault;
    // After every message: each is a moment of its own.
    next_ = transforms_->Camera();
  }
  return {};
}

Fault CameraPath::Accompany(DepthFrame& frame) {
  // A pose beyond the frame is needed, to interpolate; one that is far ahead has a wrong stamp and
  // must not keep the others back.
  constexpr std::uint64_t kFar_ns = 10'000'000'000;
  bool beyond = false;
  while (next_ && !beyond) {
    const std::uint64_t ahead_ns = hal::SpanNs(frame.stamp_ns, next_->ros_ns);
    beyond = ahead_ns > 0 && ahead_ns < kFar_ns;
    // Those that it refuses are no loss but their own.
    (void)history_->Add(next_->ros_ns, next_->T_wc, /*reset_counter=*/0, frame.stamp_ns);
    const Fault fault = Take();
    if (!fault.ok() && fault.status != Status::kEndOfStream) return fault;
  }
  frame.has_T_wc = history_->At(frame.stamp_ns, frame.T_wc) == Status::kOk;
  return {};
}

}  // namespace disflow::posix
