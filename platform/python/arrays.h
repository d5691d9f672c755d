// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <disflow.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <vector>

namespace disflow::python {

namespace py = pybind11;

/// A read-only array that looks into memory of a Python object, and keeps that alive.
template <class T>
[[nodiscard]] py::array View(const T* data, std::vector<py::ssize_t> shape,
                             const py::object& owner) {
  py::array array(py::dtype::of<T>(), std::move(shape), data, owner);
  array.attr("flags").attr("writeable") = false;
  return array;
}

/// A 4x4 matrix of a rigid-body motion.
[[nodiscard]] py::array_t<float> MatrixOf(const disflow_pose& pose);
/// @throws py::value_error if it is none. @param name For the message.
[[nodiscard]] disflow_pose PoseOf(
    const py::array_t<float, py::array::c_style | py::array::forcecast>& matrix, const char* name);

void BindEstimate(py::module_& module);
void BindTracker(py::module_& module);

}  // namespace disflow::python
