// SPDX-License-Identifier: BSD-3-Clause
#include <Eigen/Geometry>

#include "arrays.h"

namespace disflow::python {
namespace {

const char* StateName(const disflow_estimate& estimate) {
  static constexpr const char* kNames[] = {"initialising", "tracking", "degraded", "lost",
                                           "recovered"};
  return kNames[estimate.state];
}
const char* KindName(const disflow_estimate& estimate) {
  static constexpr const char* kNames[] = {"measured", "predicted", "refused"};
  return kNames[estimate.kind];
}
const char* WeakName(const disflow_estimate& estimate) {
  static constexpr const char* kNames[] = {"none", "translation", "rotation"};
  return kNames[estimate.weak_kind];
}

py::dict Rejected(const disflow_estimate& estimate) {
  const disflow_counters& c = estimate.rejected;
  py::dict all;
  all["frames"] = c.frames;
  all["frames_rejected"] = c.frames_rejected;
  all["frames_unregistered"] = c.frames_unregistered;
  all["images_repeated"] = c.images_repeated;
  all["pixels_out_of_range"] = c.pixels_out_of_range;
  all["runs_dropped"] = c.runs_dropped;
  all["blocks_sparse"] = c.blocks_sparse;
  all["blocks_grazing"] = c.blocks_grazing;
  all["blocks_flying"] = c.blocks_flying;
  all["samples_dropped"] = c.samples_dropped;
  all["residuals_unmatched"] = c.residuals_unmatched;
  all["residuals_truncated"] = c.residuals_truncated;
  all["residuals_normal_mismatch"] = c.residuals_normal_mismatch;
  all["observations_rejected"] = c.observations_rejected;
  all["observations_out_of_bounds"] = c.observations_out_of_bounds;
  all["samples_refused"] = c.samples_refused;
  all["clusters_evicted"] = c.clusters_evicted;
  all["clusters_forgotten"] = c.clusters_forgotten;
  all["edges_refused"] = c.edges_refused;
  all["candidates_dropped"] = c.candidates_dropped;
  return all;
}

/// A property that looks into the estimate itself.
template <class Member>
auto ViewOf(Member member, std::vector<py::ssize_t> shape) {
  return [member, shape](const py::object& self) {
    return View<float>(&member(self.cast<const disflow_estimate&>()), shape, self);
  };
}

std::string Repr(const disflow_estimate& e) {
  return std::string("<disflow.Estimate ") + KindName(e) + ", " + StateName(e) + ", position " +
         std::to_string(e.T_co.position_m[0]) + " " + std::to_string(e.T_co.position_m[1]) + " " +
         std::to_string(e.T_co.position_m[2]) + " m, quality " + std::to_string(e.quality) + ">";
}

}  // namespace

py::array_t<float> MatrixOf(const disflow_pose& pose) {
  const float* const q = pose.quaternion_xyzw;
  Eigen::Matrix<float, 4, 4, Eigen::RowMajor> matrix =
      Eigen::Matrix<float, 4, 4, Eigen::RowMajor>::Identity();
  matrix.topLeftCorner<3, 3>() = Eigen::Quaternionf(q[3], q[0], q[1], q[2]).toRotationMatrix();
  matrix.topRightCorner<3, 1>() = Eigen::Map<const Eigen::Vector3f>(pose.position_m);
  return py::array_t<float>({4, 4}, matrix.data());
}

disflow_pose PoseOf(const py::array_t<float, py::array::c_style | py::array::forcecast>& matrix,
                    const char* name) {
  constexpr float kTolerance = 1e-3F;
  const std::string needed = std::string(name) + ": a 4x4 matrix of a rigid-body motion is needed";
  if (matrix.ndim() != 2 || matrix.shape(0) != 4 || matrix.shape(1) != 4)
    throw py::value_error(needed);
  const Eigen::Map<const Eigen::Matrix<float, 4, 4, Eigen::RowMajor>> m(matrix.data());
  const Eigen::Matrix3f rotation = m.topLeftCorner<3, 3>();
  // Written so that NaN is none.
  const bool rigid = (rotation * rotation.transpose()).isIdentity(kTolerance) &&
                     rotation.determinant() > 0.0F &&
                     m.row(3).isApprox(Eigen::RowVector4f(0, 0, 0, 1), kTolerance) && m.allFinite();
  if (!rigid) throw py::value_error(needed);
  const Eigen::Quaternionf q = Eigen::Quaternionf(rotation).normalized();
  return {{m(0, 3), m(1, 3), m(2, 3)}, {q.x(), q.y(), q.z(), q.w()}};
}

void BindEstimate(py::module_& module) {
  using E = disflow_estimate;
  py::class_<E>(module, "Estimate",
                "All that one frame yields. Arrays look into it, nothing is copied.")
      .def_property_readonly(
          "status", [](const E& e) { return e.status; }, "0 = the frame was registered.")
      .def_property_readonly("status_text", [](const E& e) { return disflow_describe(e.status); })
      .def_property_readonly("ok", [](const E& e) { return e.status == DISFLOW_OK; })
      .def_property_readonly("kind", &KindName, "'measured', 'predicted' or 'refused'.")
      .def_property_readonly("state", &StateName,
                             "'initialising', 'tracking', 'degraded', 'lost' or 'recovered'.")
      .def_property_readonly("stamp_ns", [](const E& e) { return e.stamp_ns; })
      .def_property_readonly(
          "T_co", [](const E& e) { return MatrixOf(e.T_co); },
          "The object's pose in the camera's frame, 4x4.")
      .def_property_readonly(
          "T_wo",
          [](const E& e) -> py::object {
            if (e.has_T_wo == 0) return py::none();
            return MatrixOf(e.T_wo);
          },
          "The object's pose in the world, 4x4, or None.")
      .def_property_readonly(
          "position_m",
          ViewOf([](const E& e) -> const float& { return e.T_co.position_m[0]; }, {3}))
      .def_property_readonly(
          "quaternion_xyzw",
          ViewOf([](const E& e) -> const float& { return e.T_co.quaternion_xyzw[0]; }, {4}))
      .def_property_readonly(
          "linear_mps", ViewOf([](const E& e) -> const float& { return e.linear_mps[0]; }, {3}),
          "Velocity of the object frame's origin, camera axes.")
      .def_property_readonly(
          "angular_rps", ViewOf([](const E& e) -> const float& { return e.angular_rps[0]; }, {3}))
      .def_property_readonly(
          "pose_covariance",
          ViewOf([](const E& e) -> const float& { return e.pose_covariance[0]; }, {6, 6}),
          "Of (position, rotation vector), camera axes.")
      .def_property_readonly(
          "twist_covariance",
          ViewOf([](const E& e) -> const float& { return e.twist_covariance[0]; }, {6, 6}),
          "Of (linear_mps, angular_rps).")
      .def_property_readonly("weak", &WeakName,
                             "'none', 'translation' or 'rotation': what is hardly observed.")
      .def_property_readonly("weak_axis",
                             ViewOf([](const E& e) -> const float& { return e.weak_axis[0]; }, {3}))
      .def_property_readonly("weak_std", [](const E& e) { return e.weak_std; })
      .def_property_readonly(
          "quality", [](const E& e) { return e.quality; }, "0 = not usable, 100 = best.")
      .def_property_readonly("reset_counter", [](const E& e) { return e.reset_counter; })
      .def_property_readonly("score", [](const E& e) { return e.score; })
      .def_property_readonly("conflict", [](const E& e) { return e.conflict; })
      .def_property_readonly("visible", [](const E& e) { return e.visible; })
      .def_property_readonly("samples", [](const E& e) { return e.samples; })
      .def_property_readonly("inliers", [](const E& e) { return e.inliers; })
      .def_property_readonly("edge_inliers", [](const E& e) { return e.edge_inliers; })
      .def_property_readonly("hypotheses", [](const E& e) { return e.hypotheses; })
      .def_property_readonly("iterations", [](const E& e) { return e.iterations; })
      .def_property_readonly("rms_m", [](const E& e) { return e.rms_m; })
      .def_property_readonly("inverse_depth_std_per_m",
                             [](const E& e) { return e.inverse_depth_std_per_m; })
      .def_property_readonly("rejected", &Rejected,
                             "What was dropped in this frame and why, counted.")
      .def("__repr__", &Repr);
}

}  // namespace disflow::python
