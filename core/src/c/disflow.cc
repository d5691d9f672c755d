// SPDX-License-Identifier: BSD-3-Clause
#include "disflow.h"

#include "binding.h"
#include "conversions.h"
#include "settings.h"

namespace {

using disflow::Status;

disflow_status Code(Status status) noexcept { return static_cast<disflow_status>(status); }

/// Whether scratch memory will do.
disflow_status CheckWorkspace(const disflow_tracker& tracker, const void* workspace,
                              std::size_t bytes) noexcept {
  if (workspace == nullptr) return DISFLOW_NOT_INITIALISED;
  const bool enough = bytes >= tracker.workspace_bytes() && disflow::c::IsAligned(workspace);
  return enough ? DISFLOW_OK : DISFLOW_CAPACITY_EXCEEDED;
}

class CallTriangles final : public disflow::TriangleSink {
 public:
  CallTriangles(disflow_triangle_sink sink, void* context) noexcept
      : sink_(sink), context_(context) {}

 private:
  void DoOnTriangle(const disflow::SurfaceVertex& a, const disflow::SurfaceVertex& b,
                    const disflow::SurfaceVertex& c) noexcept override {
    const disflow_vertex vertices[3] = {disflow::c::VertexOf(a), disflow::c::VertexOf(b),
                                        disflow::c::VertexOf(c)};
    sink_(context_, vertices);
  }
  disflow_triangle_sink sink_;
  void* context_;
};

class CallSamples final : public disflow::SampleSink {
 public:
  CallSamples(disflow_sample_sink sink, void* context) noexcept : sink_(sink), context_(context) {}

 private:
  void DoOnSample(const disflow::SurfaceVertex& sample, int observations) noexcept override {
    const disflow_vertex vertex = disflow::c::VertexOf(sample);
    sink_(context_, &vertex, observations);
  }
  disflow_sample_sink sink_;
  void* context_;
};

}  // namespace

const char* disflow_describe(disflow_status status) {
  const bool fits = status >= 0 && status <= 255;
  return disflow::Describe(static_cast<Status>(fits ? status : 255));
}

const char* disflow_version(void) { return DISFLOW_VERSION_TEXT; }

const char* disflow_profile_name(const disflow_profile* profile) { return profile->name; }
std::size_t disflow_tracker_bytes(const disflow_profile* profile) { return profile->tracker_bytes; }
std::size_t disflow_workspace_bytes(const disflow_profile* profile) {
  return profile->workspace_bytes;
}
std::int32_t disflow_max_width_px(const disflow_profile* profile) { return profile->max_width_px; }
std::int32_t disflow_max_height_px(const disflow_profile* profile) {
  return profile->max_height_px;
}

disflow_status disflow_create(const disflow_profile* profile, void* memory,
                              std::size_t memory_bytes, const disflow_setting* settings,
                              std::size_t settings_count, disflow_tracker** tracker,
                              disflow_setting_info* refused) {
  if (refused != nullptr) *refused = {};
  if (tracker == nullptr) return DISFLOW_NOT_INITIALISED;
  *tracker = nullptr;
  if (profile == nullptr || memory == nullptr) return DISFLOW_NOT_INITIALISED;
  if (memory_bytes < profile->tracker_bytes || !disflow::c::IsAligned(memory)) {
    return DISFLOW_CAPACITY_EXCEEDED;
  }
  disflow::Config config;
  const Status status = disflow::c::Apply(settings, settings_count, config, refused);
  if (status != Status::kOk) return Code(status);
  *tracker = profile->make(memory, config);
  return DISFLOW_OK;
}

disflow_status disflow_process(disflow_tracker* tracker, const disflow_frame* frame,
                               disflow_estimate* estimate) {
  if (tracker == nullptr || frame == nullptr || estimate == nullptr) return DISFLOW_NOT_INITIALISED;
  disflow::Estimate result;
  tracker->Process(disflow::c::FrameOf(*frame), result);
  *estimate = disflow::c::EstimateOf(result);
  return estimate->status;
}

disflow_status disflow_fuse(disflow_tracker* tracker, const disflow_frame* frame,
                            const disflow_pose* T_oc, disflow_estimate* estimate) {
  if (tracker == nullptr || frame == nullptr || T_oc == nullptr || estimate == nullptr) {
    return DISFLOW_NOT_INITIALISED;
  }
  disflow::Estimate result;
  tracker->Fuse(disflow::c::FrameOf(*frame),
                disflow::c::TransformOf<disflow::Object, disflow::Camera>(*T_oc), result);
  *estimate = disflow::c::EstimateOf(result);
  return estimate->status;
}

void disflow_reset(disflow_tracker* tracker) {
  if (tracker != nullptr) tracker->Reset();
}

disflow_status disflow_choose_pixel(disflow_tracker* tracker, std::int32_t u_px, std::int32_t v_px,
                                    std::int32_t reach_px) {
  if (tracker == nullptr) return DISFLOW_NOT_INITIALISED;
  if (u_px < 0 || v_px < 0) return DISFLOW_INVALID_CONFIG;
  disflow::ObjectStart start;
  start.seed_u_px = u_px;
  start.seed_v_px = v_px;
  start.seed_reach_px = reach_px;
  return Code(tracker->Choose(start));
}

disflow_status disflow_choose_box(disflow_tracker* tracker, std::int32_t x_px, std::int32_t y_px,
                                  std::int32_t width_px, std::int32_t height_px) {
  if (tracker == nullptr) return DISFLOW_NOT_INITIALISED;
  // 0 would be the whole image.
  if (width_px <= 0 || height_px <= 0) return DISFLOW_INVALID_CONFIG;
  disflow::ObjectStart start;
  start.roi_x_px = x_px;
  start.roi_y_px = y_px;
  start.roi_width_px = width_px;
  start.roi_height_px = height_px;
  return Code(tracker->Choose(start));
}

disflow_status disflow_object_mask(const disflow_tracker* tracker, std::uint8_t* mask,
                                   std::int32_t width_px, std::int32_t height_px,
                                   std::ptrdiff_t stride_bytes) {
  if (tracker == nullptr || mask == nullptr) return DISFLOW_NOT_INITIALISED;
  if (width_px <= 0 || height_px <= 0 || (stride_bytes != 0 && stride_bytes < width_px)) {
    return DISFLOW_INVALID_IMAGE_SIZE;
  }
  const std::ptrdiff_t stride = stride_bytes != 0 ? stride_bytes : width_px;
  for (std::int32_t v = 0; v < height_px; ++v)
    tracker->WriteMaskRow(v, {mask + v * stride, static_cast<std::size_t>(width_px)});
  return DISFLOW_OK;
}

disflow_status disflow_surface(const disflow_tracker* tracker, float resolution_m,
                               float support_radius_m, void* workspace, std::size_t workspace_bytes,
                               disflow_triangle_sink sink, void* context) {
  if (tracker == nullptr || sink == nullptr) return DISFLOW_NOT_INITIALISED;
  const disflow_status usable = CheckWorkspace(*tracker, workspace, workspace_bytes);
  if (usable != DISFLOW_OK) return usable;
  disflow::SurfaceOptions options;
  if (resolution_m != 0.0F) options.resolution_m = resolution_m;
  if (support_radius_m != 0.0F) options.support_radius_m = support_radius_m;
  CallTriangles triangles(sink, context);
  return Code(tracker->ExtractSurface(options, workspace, triangles));
}

std::int32_t disflow_samples(const disflow_tracker* tracker, disflow_sample_sink sink,
                             void* context) {
  if (tracker == nullptr || sink == nullptr) return 0;
  CallSamples samples(sink, context);
  return tracker->StreamSamples(samples);
}

disflow_status disflow_query(const disflow_tracker* tracker, const float* points_m,
                             std::int32_t point_count, float support_radius_m, void* workspace,
                             std::size_t workspace_bytes, disflow_distance* distances) {
  if (tracker == nullptr || points_m == nullptr || distances == nullptr) {
    return DISFLOW_NOT_INITIALISED;
  }
  const disflow_status usable = CheckWorkspace(*tracker, workspace, workspace_bytes);
  if (usable != DISFLOW_OK) return usable;
  const float radius_m =
      support_radius_m != 0.0F ? support_radius_m : disflow::SurfaceOptions{}.support_radius_m;
  return Code(tracker->Query(points_m, point_count, radius_m, workspace, distances));
}
