/* SPDX-License-Identifier: BSD-3-Clause */
/* Tracks a box that moves before a wall, from C99, in static memory:
 *   gcc -std=c99 -O2 track.c -ldisflow_core -lm && ./a.out
 * The same source runs on a Cortex-M7. A real program gets its depth images from a camera. */
#include <disflow.h>
#include <math.h>
#include <stdio.h>

enum { WIDTH = 160, HEIGHT = 120, FRAMES = 30 };
static const float focal_px = 150.0f;
static const float half_box_m[3] = {0.07f, 0.05f, 0.06f};

static uint64_t tracker_memory[DISFLOW_MICRO_BYTES / 8];
static uint64_t workspace[DISFLOW_WORKSPACE_BYTES / 8];
static float depth_m[HEIGHT][WIDTH];

/* The box at time t: turned about an axis that is fixed to it, and moved. */
static void box_at(float t_s, float rotation[3][3], float position_m[3]) {
  const float turn_rad = 0.6f + 0.8f * t_s, tilt_rad = 0.5f;
  const float ca = cosf(turn_rad), sa = sinf(turn_rad), cb = cosf(tilt_rad), sb = sinf(tilt_rad);
  const float r[3][3] = {{ca, 0, sa}, {sa * sb, cb, -ca * sb}, {-sa * cb, sb, ca * cb}};
  for (int i = 0; i < 9; ++i) rotation[i / 3][i % 3] = r[i / 3][i % 3];
  position_m[0] = -0.03f + 0.15f * t_s;
  position_m[1] = 0.05f * t_s;
  position_m[2] = 0.42f + 0.1f * t_s;
}

/* Depth along a ray with z = 1: the box, or the wall behind it. */
static float trace(const float ray[3], const float rotation[3][3], const float position_m[3]) {
  const float wall_m = 1.2f;
  float near_m = 0.0f, far_m = wall_m;
  for (int axis = 0; axis < 3; ++axis) {
    float slope = 0.0f, start_m = 0.0f;
    for (int i = 0; i < 3; ++i) {
      slope += rotation[i][axis] * ray[i];
      start_m -= rotation[i][axis] * position_m[i];
    }
    const float a_m = (-half_box_m[axis] - start_m) / slope;
    const float b_m = (half_box_m[axis] - start_m) / slope;
    near_m = fmaxf(near_m, fminf(a_m, b_m));
    far_m = fminf(far_m, fmaxf(a_m, b_m));
  }
  return near_m < far_m ? near_m : wall_m;
}

static void draw(float t_s) {
  float rotation[3][3], position_m[3];
  box_at(t_s, rotation, position_m);
  for (int v = 0; v < HEIGHT; ++v) {
    for (int u = 0; u < WIDTH; ++u) {
      const float ray[3] = {((float)u - 80.0f) / focal_px, ((float)v - 60.0f) / focal_px, 1.0f};
      depth_m[v][u] = trace(ray, (const float(*)[3])rotation, position_m);
    }
  }
}

static void count(void* context, const disflow_vertex* vertices) {
  (void)vertices;
  ++*(int*)context;
}

int main(void) {
  const disflow_setting settings[] = {{"segmenter.max_range_m", 1.0f}};
  disflow_tracker* tracker = NULL;
  disflow_setting_info refused;
  disflow_status status = disflow_create(&disflow_micro, tracker_memory, sizeof(tracker_memory),
                                         settings, 1, &tracker, &refused);
  if (status != DISFLOW_OK) {
    printf("%s: %s\n", refused.name ? refused.name : "tracker", disflow_describe(status));
    return 1;
  }
  disflow_estimate estimate;
  for (int i = 0; i < FRAMES; ++i) {
    const float t_s = (float)i / 30.0f;
    draw(t_s);
    disflow_frame frame = {0};
    frame.depth = depth_m;
    frame.depth_format = DISFLOW_DEPTH_FLOAT32;
    frame.width_px = WIDTH;
    frame.height_px = HEIGHT;
    frame.fx_px = frame.fy_px = focal_px;
    frame.cx_px = 80.0f;
    frame.cy_px = 60.0f;
    frame.stamp_ns = (int64_t)1000000000 + (int64_t)i * 1000000000 / 30;
    status = disflow_process(tracker, &frame, &estimate);
    const disflow_pose* pose = &estimate.T_co;
    printf("%d %d %.5f %.5f %.5f %.5f %.5f %.5f %.5f %.4f %.4f %.4f\n", i, (int)status,
           (double)pose->position_m[0], (double)pose->position_m[1], (double)pose->position_m[2],
           (double)pose->quaternion_xyzw[0], (double)pose->quaternion_xyzw[1],
           (double)pose->quaternion_xyzw[2], (double)pose->quaternion_xyzw[3],
           (double)estimate.linear_mps[0], (double)estimate.linear_mps[1],
           (double)estimate.linear_mps[2]);
  }
  int triangles = 0;
  status = disflow_surface(tracker, 0.0f, 0.0f, workspace, sizeof(workspace), count, &triangles);
  printf("surface: %s, %d triangles\n", disflow_describe(status), triangles);
  return status == DISFLOW_OK && estimate.kind == DISFLOW_MEASURED ? 0 : 1;
}
