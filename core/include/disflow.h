/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef DISFLOW_H
#define DISFLOW_H

/** @file
 * DisFlow for C99, and for every language that can call C. The same tracker as disflow::Tracker, in
 * memory of the caller: nothing here allocates, throws, starts threads or keeps global state.
 *
 * Lengths are metres, angles radians, times nanoseconds of a monotonic clock, pixels are counted
 * from the centre of the first one. Camera axes: x right, y down, z forward. Two trackers may be
 * used by two threads at the same time; one tracker may not. Pointers must not be NULL unless said.
 */

#include <stddef.h>
#include <stdint.h>

/* Names and types as C has them. */
/* NOLINTBEGIN(readability-identifier-naming,modernize-use-using,modernize-avoid-c-arrays) */
#ifdef __cplusplus
extern "C" {
#endif

/** Result of a call; the numbers of disflow::Status, docs/wire-format.md lists them all. */
typedef int32_t disflow_status;
enum {
  DISFLOW_OK = 0,
  DISFLOW_INVALID_CONFIG = 1,
  DISFLOW_INVALID_INTRINSICS = 2,
  DISFLOW_INVALID_IMAGE_SIZE = 3,
  DISFLOW_IMAGE_TOO_LARGE = 4,
  DISFLOW_MASK_SIZE_MISMATCH = 5,
  DISFLOW_EMPTY_MASK = 6,
  DISFLOW_NO_VALID_DEPTH = 7,
  DISFLOW_TOO_FEW_SAMPLES = 8,
  DISFLOW_STAMP_NOT_INCREASING = 9,
  DISFLOW_INVALID_TRANSFORM = 10,
  DISFLOW_NOT_INITIALISED = 16, /**< No model yet; or a pointer is NULL. */
  DISFLOW_REGISTRATION_FAILED = 17,
  DISFLOW_OUT_OF_BOUNDS = 18,
  DISFLOW_CAPACITY_EXCEEDED = 19, /**< Memory too small, or not at a multiple of 8 bytes. */
  DISFLOW_REPEATED_IMAGE = 20,
  DISFLOW_NOT_FOUND = 33 /**< There is no setting of that name. */
};
/** @return A short English description; static storage, never NULL. */
const char* disflow_describe(disflow_status status);

/** "major.minor.patch" of this header. */
#define DISFLOW_VERSION_TEXT "0.1.0"
/** The same of the library that is linked; static storage. */
const char* disflow_version(void);

/** Capacities of a tracker (docs/memory.md). A program that names one does not link the others. */
typedef struct disflow_profile disflow_profile;
extern const disflow_profile disflow_micro; /**< Cortex-M: images up to 240 x 180. */
extern const disflow_profile disflow_edge;  /**< Cortex-A: up to 1280 x 720. */
extern const disflow_profile disflow_dense; /**< PC: up to 1920 x 1200. */

/** Bytes that are enough for a tracker on every target, for static memory:
 * `static uint64_t memory[DISFLOW_EDGE_BYTES / 8];` */
#define DISFLOW_MICRO_BYTES (401u * 1024u)
#define DISFLOW_EDGE_BYTES (1281u * 1024u)
#define DISFLOW_DENSE_BYTES (11u * 1024u * 1024u + 1024u)
/** Bytes that are enough for the workspace of queries and surfaces, of every profile. */
#define DISFLOW_WORKSPACE_BYTES (56u * 1024u)

const char* disflow_profile_name(const disflow_profile* profile);
size_t disflow_tracker_bytes(const disflow_profile* profile);
size_t disflow_workspace_bytes(const disflow_profile* profile);
int32_t disflow_max_width_px(const disflow_profile* profile);
int32_t disflow_max_height_px(const disflow_profile* profile);

/** One of the settings of docs/settings.md by its dotted name, e.g. {"sampler.border_px", 2}. */
typedef struct disflow_setting {
  const char* name;
  float value;
} disflow_setting;

/** What there is to know of a setting; texts in static storage. */
typedef struct disflow_setting_info {
  const char* name;
  const char* unit;
  const char* meaning;
  float default_value;
  float min; /**< Allowed range, both ends included. */
  float max;
  int32_t is_integer;
} disflow_setting_info;
int32_t disflow_setting_count(void);
/** @return DISFLOW_OUT_OF_BOUNDS if there is no setting of that index. */
disflow_status disflow_describe_setting(int32_t index, disflow_setting_info* info);

/** A tracker of one rigid object. To end it, forget it and reuse its memory. */
typedef struct disflow_tracker disflow_tracker;

/** Makes a tracker.
 * @param memory At a multiple of 8 bytes; the caller's as long as the tracker is used.
 * @param settings Those that shall not have their defaults; NULL if settings_count is 0.
 * @param refused NULL, or receives the setting that was refused, with its allowed range; its name
 * is NULL if that was not the reason.
 * @return DISFLOW_CAPACITY_EXCEEDED, DISFLOW_NOT_FOUND (unknown name), DISFLOW_INVALID_CONFIG (out
 * of range, or no whole number); *tracker is then NULL. */
disflow_status disflow_create(const disflow_profile* profile, void* memory, size_t memory_bytes,
                              const disflow_setting* settings, size_t settings_count,
                              disflow_tracker** tracker, disflow_setting_info* refused);

/** A rigid-body motion: x_to = rotation * x_from + position. The quaternion has unit length. */
typedef struct disflow_pose {
  float position_m[3];
  float quaternion_xyzw[4];
} disflow_pose;

enum {
  DISFLOW_DEPTH_UINT16 = 0, /**< Raw units of unit_m; 0 = no data. */
  DISFLOW_DEPTH_FLOAT32 = 1 /**< Metres; 0, negative, NaN and infinity = no data. */
};

/** One depth image with all that is known about it. Zero it first: `disflow_frame frame = {0};`.
 * Pixels are read in place, row by row, first row on top, and only during the call. */
typedef struct disflow_frame {
  const void* depth;
  int32_t width_px;
  int32_t height_px;
  ptrdiff_t stride_bytes; /**< From one row to the next; 0 = rows follow each other. */
  int32_t depth_format;   /**< Any other than these two is refused: DISFLOW_INVALID_IMAGE_SIZE. */
  float unit_m;           /**< Metres per unit of DISFLOW_DEPTH_UINT16; 0 = 0.001. */
  float fx_px;            /**< Pinhole camera without distortion. */
  float fy_px;
  float cx_px;
  float cy_px;
  int64_t stamp_ns; /**< Capture time, never the time of arrival. */
  /** NULL, or as many pixels as depth, those of the object not 0. */
  const uint8_t* mask;
  ptrdiff_t mask_stride_bytes; /**< 0 = rows follow each other. */
  uint8_t mask_label;          /**< Not 0: the object's pixels are those of this value. */
  const disflow_pose* T_wc;    /**< NULL, or the camera's pose in the world. */
} disflow_frame;

enum {
  DISFLOW_INITIALISING = 0,
  DISFLOW_TRACKING = 1,
  DISFLOW_DEGRADED = 2, /**< Use the covariance. */
  DISFLOW_LOST = 3,     /**< The pose is only predicted; do not act on it. */
  DISFLOW_RECOVERED = 4
};
enum {
  DISFLOW_MEASURED = 0,  /**< For control, and for other filters to fuse. */
  DISFLOW_PREDICTED = 1, /**< For displays and short gaps; never to be fused. */
  DISFLOW_REFUSED = 2    /**< Nothing is known at this time. */
};
enum { DISFLOW_WEAK_NONE = 0, DISFLOW_WEAK_TRANSLATION = 1, DISFLOW_WEAK_ROTATION = 2 };

/** What was dropped and why; the members are explained at disflow::Counters. */
typedef struct disflow_counters {
  uint32_t frames;
  uint32_t frames_rejected;
  uint32_t frames_unregistered;
  uint32_t images_repeated;
  uint32_t pixels_out_of_range;
  uint32_t runs_dropped;
  uint32_t blocks_sparse;
  uint32_t blocks_grazing;
  uint32_t blocks_flying;
  uint32_t samples_dropped;
  uint32_t residuals_unmatched;
  uint32_t residuals_truncated;
  uint32_t residuals_normal_mismatch;
  uint32_t observations_rejected;
  uint32_t observations_out_of_bounds;
  uint32_t samples_refused;
  uint32_t clusters_evicted;
  uint32_t clusters_forgotten;
  uint32_t edges_refused;
  uint32_t candidates_dropped;
} disflow_counters;

/** All that one frame yields; explained at disflow::Estimate. Matrices are row by row. */
typedef struct disflow_estimate {
  int64_t stamp_ns; /**< What pose and twist are for. */
  disflow_status status;
  int32_t state;              /**< DISFLOW_INITIALISING ... DISFLOW_RECOVERED */
  int32_t kind;               /**< DISFLOW_MEASURED, DISFLOW_PREDICTED, DISFLOW_REFUSED */
  disflow_pose T_co;          /**< The object in the camera's frame. */
  disflow_pose T_wo;          /**< The object in the world. */
  int32_t has_T_wo;           /**< 1: T_wo is valid. */
  float linear_mps[3];        /**< Of the object frame's origin, camera axes. */
  float angular_rps[3];       /**< Camera axes. */
  float pose_covariance[36];  /**< Of (position [m], rotation vector [rad]), camera axes. */
  float twist_covariance[36]; /**< Of (linear_mps, angular_rps). */
  int32_t weak_kind;          /**< DISFLOW_WEAK_...: what is hardly observed. */
  float weak_axis[3];         /**< Unit vector, camera axes. */
  float weak_std;             /**< Along or about it, m or rad. */
  int32_t quality;            /**< 0 = not usable, 100 = best. */
  int32_t reset_counter;      /**< Changes when the object frame starts anew. */
  float score;
  float conflict;
  float visible;
  int32_t samples;
  int32_t inliers;
  int32_t edge_inliers;
  int32_t hypotheses;
  int32_t iterations;
  float rms_m;
  float inverse_depth_std_per_m; /**< Sensor noise of 1/z that was used. */
  disflow_counters rejected;     /**< Of this frame alone. */
} disflow_estimate;

/** Tracks the object in the next frame: disflow::Tracker::Process().
 * @param estimate Always written completely.
 * @return The same as estimate->status. */
disflow_status disflow_process(disflow_tracker* tracker, const disflow_frame* frame,
                               disflow_estimate* estimate);

/** Adds a frame whose pose is known (turntable, robot arm) to the model: Tracker::Fuse().
 * @param T_oc The camera in the object's frame. */
disflow_status disflow_fuse(disflow_tracker* tracker, const disflow_frame* frame,
                            const disflow_pose* T_oc, disflow_estimate* estimate);

/** Forgets the object; the next frame starts a new one. */
void disflow_reset(disflow_tracker* tracker);

/** Forgets the object for another one: the next frame starts what lies at a pixel, or the nearest
 * surface within reach_px of it; disflow::Tracker::Choose(). For frames without a mask.
 * @return DISFLOW_INVALID_CONFIG, and nothing changes, if a number is out of range. */
disflow_status disflow_choose_pixel(disflow_tracker* tracker, int32_t u_px, int32_t v_px,
                                    int32_t reach_px);
/** The same with the nearest thing in a part of the image, whose upper left pixel is x_px, y_px. */
disflow_status disflow_choose_box(disflow_tracker* tracker, int32_t x_px, int32_t y_px,
                                  int32_t width_px, int32_t height_px);

/** Which pixels of the last frame were taken for the object, as 255 and 0.
 * @param mask height_px rows of width_px bytes each, stride_bytes apart (0 = width_px). */
disflow_status disflow_object_mask(const disflow_tracker* tracker, uint8_t* mask, int32_t width_px,
                                   int32_t height_px, ptrdiff_t stride_bytes);

/** A point of the model, object frame. */
typedef struct disflow_vertex {
  float position_m[3];
  float normal[3]; /**< Outward. */
  float std_m;     /**< How far off it may be along its normal, one sigma. */
} disflow_vertex;

/** Receives a triangle: three vertices, counter-clockwise seen from outside. */
typedef void (*disflow_triangle_sink)(void* context, const disflow_vertex* vertices);
/** Receives a sample of the model and how many observations were averaged in it. */
typedef void (*disflow_sample_sink)(void* context, const disflow_vertex* sample,
                                    int32_t observations);

/** Streams the model's surface; see disflow::ExtractSurface().
 * @param resolution_m Edge of a sampling cube at most; 0 = 2.5 mm. A model that is coarser than set
 *     (field.fit_to_object) is drawn no finer than a sixteenth of its cells.
 * @param support_radius_m Surface farther than this from what was seen stays open; 0 = 8 mm. As
 * much farther as the model is coarser than set.
 * @param workspace At a multiple of 8 bytes, at least disflow_workspace_bytes(). */
disflow_status disflow_surface(const disflow_tracker* tracker, float resolution_m,
                               float support_radius_m, void* workspace, size_t workspace_bytes,
                               disflow_triangle_sink sink, void* context);

/** Streams the samples that the model is made of. @return How many. */
int32_t disflow_samples(const disflow_tracker* tracker, disflow_sample_sink sink, void* context);

/** What the model knows of a point; see disflow::DistanceQuery. */
typedef struct disflow_distance {
  disflow_status status; /**< DISFLOW_OUT_OF_BOUNDS: a coordinate is not finite or beyond 1e6 m. */
  int32_t in_bounds;     /**< 1: seen surface is near. */
  float distance_m;      /**< To the surface, positive outside. */
  float gradient[3];     /**< Unit direction in which the distance grows. */
  float variance_m2;
} disflow_distance;

/** Distances of points to the model's surface.
 * @param points_m Three numbers per point, object frame.
 * @param support_radius_m Surface is taken as known up to this far from a sample; 0 = 8 mm. As much
 *     farther as the model is coarser than set.
 * @param workspace As for disflow_surface().
 * @param distances One per point, always written.
 * @return DISFLOW_NOT_INITIALISED if there is no model. */
disflow_status disflow_query(const disflow_tracker* tracker, const float* points_m,
                             int32_t point_count, float support_radius_m, void* workspace,
                             size_t workspace_bytes, disflow_distance* distances);

#ifdef __cplusplus
}
#endif
/* NOLINTEND(readability-identifier-naming,modernize-use-using,modernize-avoid-c-arrays) */

#endif /* DISFLOW_H */
