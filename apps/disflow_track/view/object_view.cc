// SPDX-License-Identifier: BSD-3-Clause
#include "view/object_view.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "disflow/posix/monotonic_clock.h"
#include "disflow/types.h"
#include "view/view_messages.h"

namespace disflow::apps {
namespace {

constexpr std::int64_t kStatusInterval_ns = kSecond_ns / 2;
constexpr std::int64_t kSurfaceInterval_ns = kSecond_ns / 2;
/// Drawing the surface takes at most one part in so many of a processor's time.
constexpr std::int64_t kSurfaceShare = 4;
/// Beyond this a surface is drawn more coarsely: a telephone has to show it too.
constexpr std::size_t kMostVertices = 20'000;

}  // namespace

void ObjectView::Update(bool watched, bool ended, std::int64_t now_ns) {
  TakeResults();
  UpdateStatus(ended, now_ns);
  UpdateSettings();
  if (ModelSnapshot* const snapshot = requested_ ? reader_.snapshot() : nullptr) {
    Draw(*snapshot, now_ns);
    requested_ = false;
  }
  if (watched && !requested_) {
    reader_.RequestSnapshot();
    requested_ = true;
  }
}

void ObjectView::TakeResults() {
  results_.clear();
  while (reader_.Pop(newest_)) {
    results_.push_back(newest_);
    metrics_.Add(static_cast<std::size_t>(object_), newest_);
  }
  metrics_.SetLost(static_cast<std::size_t>(object_), reader_.lost());
  if (results_.empty()) return;
  counted_ += static_cast<int>(results_.size());
  board_.Append(EncodeFrames(object_, results_));
}

void ObjectView::UpdateStatus(bool ended, std::int64_t now_ns) {
  const bool paused = channel_.paused();
  const bool changed = paused != status_.paused || ended != status_.ended;
  if (!changed && now_ns - status_ns_ < kStatusInterval_ns) return;
  if (now_ns - counted_ns_ >= kSecond_ns) {
    const double seconds = static_cast<double>(now_ns - counted_ns_) * 1e-9;
    status_.frames_per_second = counted_ns_ == 0 ? 0.0 : counted_ / seconds;
    counted_ns_ = now_ns;
    counted_ = 0;
  }
  status_.paused = paused;
  status_.ended = ended;
  status_.not_shown = reader_.lost();
  status_ns_ = now_ns;
  Put(kStatus, EncodeText(ViewMessage::kStatus, object_, DescribeStatus(status_, newest_)));
}

void ObjectView::UpdateSettings() {
  const std::uint32_t version = channel_.settings().version();
  const bool wanted = settings_wanted_.exchange(false);
  if (!wanted && version == settings_version_) return;
  settings_version_ = version;
  Put(kSettings, EncodeText(ViewMessage::kSettings, object_,
                            DescribeRunningSettings(channel_.settings().Now())));
}

void ObjectView::Draw(ModelSnapshot& snapshot, std::int64_t now_ns) {
  const StampNs stamp_ns = snapshot.result().estimate.stamp_ns;
  Put(kFlow, EncodeFlow(object_, stamp_ns, snapshot.flow()));
  Put(kDepth, EncodeDepth(object_, snapshot.picture()));
  const bool is_new = snapshot.result().estimate.reset_counter != surface_reset_;
  if (is_new || now_ns >= surface_due_ns_) DrawSurface(snapshot, now_ns);
}

void ObjectView::DrawSurface(ModelSnapshot& snapshot, std::int64_t now_ns) {
  const float finest_m = DrawingOptions(snapshot.config().field, 0.0F).resolution_m;
  const std::uint8_t reset = snapshot.result().estimate.reset_counter;
  if (reset != surface_reset_) coarser_ = kCoarserAtFirst;
  surface_reset_ = reset;
  SurfaceMesh mesh;
  // An empty model gives an empty mesh.
  (void)snapshot.ExtractSurface(coarser_ * finest_m, mesh);
  const float share =
      static_cast<float>(mesh.vertices().size()) / static_cast<float>(kMostVertices);
  if (share > 1.0F) coarser_ *= 1.05F * std::sqrt(share);
  Put(kSurface, EncodeSurface(object_, snapshot.result().estimate.stamp_ns, mesh));
  const std::int64_t took_ns = posix::MonotonicClock().NowNs() - now_ns;
  surface_due_ns_ = now_ns + std::max(kSurfaceInterval_ns, kSurfaceShare * took_ns);
}

}  // namespace disflow::apps
