// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// disflow._disflow: disflow.h for Python, with numpy arrays.

#include "arrays.h"

namespace disflow::python {
namespace {

/// All settings of docs/settings.md: name -> (default, min, max, unit, meaning).
py::dict Settings() {
  py::dict all;
  for (std::int32_t i = 0; i < disflow_setting_count(); ++i) {
    disflow_setting_info info{};
    (void)disflow_describe_setting(i, &info);
    const auto number = [&](float value) -> py::object {
      if (info.is_integer != 0) return py::int_(static_cast<long>(value));
      return py::float_(static_cast<double>(value));
    };
    py::dict entry;
    entry["default"] = number(info.default_value);
    entry["min"] = number(info.min);
    entry["max"] = number(info.max);
    entry["unit"] = info.unit;
    entry["meaning"] = info.meaning;
    all[info.name] = entry;
  }
  return all;
}

PYBIND11_MODULE(_disflow, module) {
  module.doc() = "Pose, twist and shape of a moving object from depth images, in fixed memory.";
  module.attr("__version__") = disflow_version();
  module.def("settings", &Settings,
             "All settings: name -> dict with default, min, max, unit and meaning.");
  BindEstimate(module);
  BindTracker(module);
}

}  // namespace
}  // namespace disflow::python
