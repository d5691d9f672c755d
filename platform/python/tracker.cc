// SPDX-License-Identifier: BSD-3-Clause
#include <pybind11/stl.h>

#include <array>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <unordered_map>

#include "arrays.h"

namespace disflow::python {
namespace {

using Matrix = py::array_t<float, py::array::c_style | py::array::forcecast>;
using Points = py::array_t<float, py::array::c_style | py::array::forcecast>;

const disflow_profile& ProfileOf(const std::string& name) {
  if (name == "micro") return disflow_micro;
  if (name == "edge") return disflow_edge;
  if (name == "dense") return disflow_dense;
  throw py::value_error("profile '" + name + "': micro, edge or dense is needed");
}

void Require(disflow_status status, const char* what) {
  if (status != DISFLOW_OK)
    throw std::runtime_error(std::string(what) + ": " + disflow_describe(status));
}

void RequireChoice(disflow_status status) {
  if (status != DISFLOW_OK) throw py::value_error("what is chosen lies in no image");
}

/// A view of a depth image. It is read where it is, so it must be laid out in rows.
void SetDepth(const py::array& depth, disflow_frame& frame) {
  const bool raw = py::isinstance<py::array_t<std::uint16_t>>(depth);
  if (depth.ndim() != 2 || (!raw && !py::isinstance<py::array_t<float>>(depth))) {
    throw py::type_error(
        "depth: a 2-D array of uint16 (units of unit_m) or float32 (metres) is needed");
  }
  if (depth.strides(1) != depth.itemsize() ||
      depth.strides(0) < depth.shape(1) * depth.itemsize()) {
    throw py::type_error(
        "depth: pixels of a row must follow each other; numpy.ascontiguousarray() makes it so");
  }
  frame.depth = depth.data();
  frame.depth_format = raw ? DISFLOW_DEPTH_UINT16 : DISFLOW_DEPTH_FLOAT32;
  frame.height_px = static_cast<std::int32_t>(depth.shape(0));
  frame.width_px = static_cast<std::int32_t>(depth.shape(1));
  frame.stride_bytes = depth.strides(0);
}

void SetMask(const py::array& mask, disflow_frame& frame) {
  const bool bytes =
      mask.itemsize() == 1 && std::string("bu").find(mask.dtype().kind()) != std::string::npos;
  if (mask.ndim() != 2 || !bytes || mask.strides(1) != 1 || mask.strides(0) < mask.shape(1)) {
    throw py::type_error(
        "mask: a 2-D array of uint8 or bool is needed, pixels of a row one after another");
  }
  if (mask.shape(0) != frame.height_px || mask.shape(1) != frame.width_px) {
    throw py::value_error("mask: must be as large as depth");
  }
  frame.mask = static_cast<const std::uint8_t*>(mask.data());
  frame.mask_stride_bytes = mask.strides(0);
}

/// What streams out of a model, gathered.
struct Mesh {
  std::vector<float> vertices, normals, std_m;
  std::vector<std::int32_t> triangles;
  std::map<std::array<float, 3>, std::int32_t> known;

  std::int32_t Add(const disflow_vertex& v) {
    const auto next = static_cast<std::int32_t>(std_m.size());
    const auto [at, is_new] =
        known.try_emplace({v.position_m[0], v.position_m[1], v.position_m[2]}, next);
    if (!is_new) return at->second;
    vertices.insert(vertices.end(), v.position_m, v.position_m + 3);
    normals.insert(normals.end(), v.normal, v.normal + 3);
    std_m.push_back(v.std_m);
    return next;
  }
};

/// Hands memory over to numpy, without a copy.
template <class T>
py::array_t<T> Give(std::vector<T>&& values, py::ssize_t columns) {
  auto owned = std::make_unique<std::vector<T>>(std::move(values));
  const auto rows = static_cast<py::ssize_t>(owned->size()) / columns;
  T* const data = owned->data();
  const py::capsule owner(owned.release(),
                          [](void* memory) { delete static_cast<std::vector<T>*>(memory); });
  if (columns == 1) return py::array_t<T>({rows}, data, owner);
  return py::array_t<T>({rows, columns}, data, owner);
}

/// A tracker in memory of its own. One call at a time; others wait.
class Tracker {
 public:
  Tracker(const std::string& profile, const std::map<std::string, float>& settings)
      : profile_(ProfileOf(profile)),
        memory_(std::make_unique<std::uint64_t[]>(disflow_tracker_bytes(&profile_) / 8 + 1)),
        workspace_(std::make_unique<std::uint64_t[]>(disflow_workspace_bytes(&profile_) / 8 + 1)) {
    std::vector<disflow_setting> list;
    for (const auto& [name, value] : settings) list.push_back({name.c_str(), value});
    disflow_setting_info refused{};
    const disflow_status status =
        disflow_create(&profile_, memory_.get(), disflow_tracker_bytes(&profile_), list.data(),
                       list.size(), &tracker_, &refused);
    if (status == DISFLOW_OK) return;
    const std::string name = refused.name != nullptr ? refused.name : "settings";
    if (status == DISFLOW_NOT_FOUND)
      throw py::key_error("there is no setting " + name + "; disflow.settings() lists all");
    throw py::value_error(name + ": allowed are " +
                          (refused.is_integer != 0 ? "whole numbers from " : "") +
                          std::to_string(refused.min) + " to " + std::to_string(refused.max) + " " +
                          (refused.unit != nullptr ? refused.unit : ""));
  }

  disflow_estimate Process(const py::array& depth, const std::array<float, 4>& camera,
                           std::int64_t stamp_ns, const std::optional<py::array>& mask,
                           std::uint8_t mask_label, float unit_m,
                           const std::optional<Matrix>& T_wc) {
    return Track(depth, camera, stamp_ns, mask, mask_label, unit_m, T_wc, nullptr);
  }
  disflow_estimate Fuse(const py::array& depth, const std::array<float, 4>& camera,
                        std::int64_t stamp_ns, const Matrix& T_oc,
                        const std::optional<py::array>& mask, std::uint8_t mask_label,
                        float unit_m) {
    const disflow_pose pose = PoseOf(T_oc, "T_oc");
    return Track(depth, camera, stamp_ns, mask, mask_label, unit_m, std::nullopt, &pose);
  }
  void Reset() {
    const std::lock_guard lock(mutex_);
    disflow_reset(tracker_);
  }

  void ChoosePixel(std::int32_t u_px, std::int32_t v_px, std::int32_t reach_px) {
    const std::lock_guard lock(mutex_);
    RequireChoice(disflow_choose_pixel(tracker_, u_px, v_px, reach_px));
  }
  void ChooseBox(std::int32_t x_px, std::int32_t y_px, std::int32_t width_px,
                 std::int32_t height_px) {
    const std::lock_guard lock(mutex_);
    RequireChoice(disflow_choose_box(tracker_, x_px, y_px, width_px, height_px));
  }

  py::tuple ExtractMesh(float resolution_m, float support_radius_m) {
    Mesh mesh;
    const auto keep = [](void* context, const disflow_vertex* three) {
      auto& to = *static_cast<Mesh*>(context);
      for (int i = 0; i < 3; ++i) to.triangles.push_back(to.Add(three[i]));
    };
    disflow_status status = DISFLOW_OK;
    {
      const py::gil_scoped_release release;
      const std::lock_guard lock(mutex_);
      status = disflow_surface(tracker_, resolution_m, support_radius_m, workspace_.get(),
                               disflow_workspace_bytes(&profile_), keep, &mesh);
    }
    if (status == DISFLOW_INVALID_CONFIG)
      throw py::value_error("resolution_m or support_radius_m cannot be used");
    if (status != DISFLOW_NOT_INITIALISED) Require(status, "mesh");
    return py::make_tuple(Give(std::move(mesh.vertices), 3), Give(std::move(mesh.triangles), 3),
                          Give(std::move(mesh.normals), 3), Give(std::move(mesh.std_m), 1));
  }

  py::tuple Samples() {
    struct Kept {
      std::vector<float> points, normals, std_m;
      std::vector<std::int32_t> observations;
    } kept;
    const auto keep = [](void* context, const disflow_vertex* v, std::int32_t observations) {
      auto& to = *static_cast<Kept*>(context);
      to.points.insert(to.points.end(), v->position_m, v->position_m + 3);
      to.normals.insert(to.normals.end(), v->normal, v->normal + 3);
      to.std_m.push_back(v->std_m);
      to.observations.push_back(observations);
    };
    const std::lock_guard lock(mutex_);
    (void)disflow_samples(tracker_, keep, &kept);
    return py::make_tuple(Give(std::move(kept.points), 3), Give(std::move(kept.normals), 3),
                          Give(std::move(kept.std_m), 1), Give(std::move(kept.observations), 1));
  }

  py::tuple Query(const Points& points_m, float support_radius_m) {
    if (points_m.ndim() != 2 || points_m.shape(1) != 3)
      throw py::value_error("points_m: an array of n x 3 is needed");
    const auto count = static_cast<std::size_t>(points_m.shape(0));
    std::vector<disflow_distance> answers(count);
    disflow_status status = DISFLOW_OK;
    {
      const float* const points = points_m.data();
      const py::gil_scoped_release release;
      const std::lock_guard lock(mutex_);
      status = disflow_query(tracker_, points, static_cast<std::int32_t>(count), support_radius_m,
                             workspace_.get(), disflow_workspace_bytes(&profile_), answers.data());
    }
    Require(status, "query");
    std::vector<float> distance, gradient, variance;
    py::array_t<bool> in_bounds(static_cast<py::ssize_t>(count));
    for (std::size_t i = 0; i < count; ++i) {
      const disflow_distance& a = answers[i];
      const bool finite = a.status == DISFLOW_OK;
      constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
      distance.push_back(finite ? a.distance_m : kNan);
      for (const float component : a.gradient) gradient.push_back(finite ? component : kNan);
      variance.push_back(finite ? a.variance_m2 : kNan);
      in_bounds.mutable_at(static_cast<py::ssize_t>(i)) = finite && a.in_bounds != 0;
    }
    return py::make_tuple(Give(std::move(distance), 1), Give(std::move(gradient), 3),
                          Give(std::move(variance), 1), in_bounds);
  }

  py::array_t<std::uint8_t> ObjectMask() {
    // The size is that of another thread's image, if one is at work.
    const std::lock_guard lock(mutex_);
    py::array_t<std::uint8_t> mask({height_px_, width_px_});
    if (mask.size() == 0) return mask;
    Require(disflow_object_mask(tracker_, mask.mutable_data(), static_cast<std::int32_t>(width_px_),
                                static_cast<std::int32_t>(height_px_), 0),
            "object_mask");
    return mask;
  }

  [[nodiscard]] const char* profile() const { return disflow_profile_name(&profile_); }
  [[nodiscard]] std::size_t bytes() const { return disflow_tracker_bytes(&profile_); }

 private:
  /// @param T_oc Null: the pose is looked for.
  disflow_estimate Track(const py::array& depth, const std::array<float, 4>& camera,
                         std::int64_t stamp_ns, const std::optional<py::array>& mask,
                         std::uint8_t mask_label, float unit_m, const std::optional<Matrix>& T_wc,
                         const disflow_pose* T_oc) {
    disflow_frame frame{};
    SetDepth(depth, frame);
    if (mask) SetMask(*mask, frame);
    frame.mask_label = mask_label;
    frame.unit_m = unit_m;
    frame.fx_px = camera[0];
    frame.fy_px = camera[1];
    frame.cx_px = camera[2];
    frame.cy_px = camera[3];
    frame.stamp_ns = stamp_ns;
    disflow_pose camera_pose{};
    if (T_wc) {
      camera_pose = PoseOf(*T_wc, "T_wc");
      frame.T_wc = &camera_pose;
    }
    disflow_estimate estimate{};
    const py::gil_scoped_release release;
    const std::lock_guard lock(mutex_);
    if (T_oc != nullptr) {
      (void)disflow_fuse(tracker_, &frame, T_oc, &estimate);
    } else {
      (void)disflow_process(tracker_, &frame, &estimate);
    }
    width_px_ = frame.width_px;
    height_px_ = frame.height_px;
    return estimate;
  }

  const disflow_profile& profile_;
  std::unique_ptr<std::uint64_t[]> memory_;
  std::unique_ptr<std::uint64_t[]> workspace_;
  disflow_tracker* tracker_ = nullptr;
  py::ssize_t width_px_ = 0;  ///< Of the last image.
  py::ssize_t height_px_ = 0;
  std::mutex mutex_;
};

}  // namespace

void BindTracker(py::module_& module) {
  using namespace py::literals;
  py::class_<Tracker>(module, "Tracker", "Tracks and reconstructs one rigid object.")
      .def(py::init<const std::string&, const std::map<std::string, float>&>(),
           "profile"_a = "edge", "settings"_a = std::map<std::string, float>{},
           "profile: 'micro', 'edge' or 'dense'. settings: name -> number, see disflow.settings().")
      .def("process", &Tracker::Process, "depth"_a, "camera"_a, "stamp_ns"_a, py::kw_only(),
           "mask"_a = py::none(), "mask_label"_a = 0, "unit_m"_a = 0.001F, "T_wc"_a = py::none(),
           "Tracks the object in the next frame.\n\n"
           "depth: uint16 (units of unit_m) or float32 (metres), read in place. camera: (fx, fy, "
           "cx, cy) in pixels.\n"
           "mask: uint8 or bool, the object not 0; with mask_label, the object's pixels have that "
           "value.\n"
           "T_wc: the camera's pose in the world, 4x4.")
      .def("fuse", &Tracker::Fuse, "depth"_a, "camera"_a, "stamp_ns"_a, "T_oc"_a, py::kw_only(),
           "mask"_a = py::none(), "mask_label"_a = 0, "unit_m"_a = 0.001F,
           "Adds a frame whose pose is known to the model; T_oc: the camera in the object's frame, "
           "4x4.")
      .def("reset", &Tracker::Reset, "Forgets the object; the next frame starts a new one.")
      .def(
          "choose_pixel", &Tracker::ChoosePixel, "u_px"_a, "v_px"_a, "reach_px"_a = 0,
          "Forgets the object; the next frame without a mask starts what lies at the pixel, or the "
          "nearest surface\nwithin reach_px of it.")
      .def("choose_box", &Tracker::ChooseBox, "x_px"_a, "y_px"_a, "width_px"_a, "height_px"_a,
           "The same with the nearest thing in a part of the image.")
      .def("mesh", &Tracker::ExtractMesh, "resolution_m"_a = 0.0025F, "support_radius_m"_a = 0.008F,
           "The surface: (vertices n x 3, triangles m x 3, normals n x 3, std_m n), object frame.")
      .def("samples", &Tracker::Samples,
           "What the model is made of: (points n x 3, normals n x 3, std_m n, observations n).")
      .def("query", &Tracker::Query, "points_m"_a, "support_radius_m"_a = 0.008F,
           "Distances to the surface: (distance_m n, gradient n x 3, variance_m2 n, in_bounds n); "
           "NaN for points that\n"
           "are not finite.")
      .def("object_mask", &Tracker::ObjectMask,
           "Which pixels of the last image were the object: 255, else 0.")
      .def_property_readonly("profile", &Tracker::profile)
      .def_property_readonly("bytes", &Tracker::bytes, "Memory of the tracker.");
}

}  // namespace disflow::python
