# SPDX-License-Identifier: BSD-3-Clause
"""Figures of merit: where they are in a report of disflow_eval, how they are shown, what is asked of them."""

import dataclasses
import statistics


@dataclasses.dataclass(frozen=True)
class Figure:
    """One number of a run."""

    title: str
    unit: str
    digits: int
    path: tuple  # Keys in the JSON report of disflow_eval.
    scale: float = 1.0  # From the report's unit to the shown one.

    def read(self, report):
        """The number in the shown unit; None if the report lacks it."""
        value = report
        for key in self.path:
            value = value.get(key) if isinstance(value, dict) else None
        return None if value is None else self.scale * value

    def show(self, value):
        return "–" if value is None else f"{value:.{self.digits}f}"


FIGURES = {
    "add_auc": Figure("ADD-AUC", "%", 2, ("add_auc_percent",)),
    "add_s_auc": Figure("ADD-S-AUC", "%", 2, ("add_s_auc_percent",)),
    "e_t": Figure("e_t", "mm", 2, ("translation_m", "rmse"), 1e3),
    "e_a": Figure("e_a", "°", 2, ("rotation_deg", "rmse")),
    "v": Figure("v", "cm/s", 2, ("linear_velocity_mps", "rmse"), 1e2),
    "w": Figure("ω", "°/s", 2, ("angular_velocity_degps", "rmse")),
    "drift_m": Figure("final drift", "mm", 2, ("final_drift_m",), 1e3),
    "drift_deg": Figure("final drift", "°", 2, ("final_drift_deg",)),
    "lost": Figure("frames lost", "", 1, ("frames", "lost")),
    "false_tracking": Figure("longest false “tracking”", "frames", 0, ("longest_false_tracking_frames",)),
    "pose_nees": Figure("pose: frames inside", "%", 1, ("pose_consistency", "share_inside_2_5_to_97_5"), 1e2),
    "twist_nees": Figure("twist: frames inside", "%", 1, ("twist_consistency", "share_inside_2_5_to_97_5"), 1e2),
    "pose_nees_mean": Figure("pose: mean NEES", "", 1, ("pose_consistency", "nees_mean")),
    "twist_nees_mean": Figure("twist: mean NEES", "", 1, ("twist_consistency", "nees_mean")),
    "median_ms": Figure("median", "ms", 2, ("time_ms", "total", "median")),
    "p99_ms": Figure("99th percentile", "ms", 2, ("time_ms", "total", "p99")),
    "f_1mm": Figure("F at 1 mm", "", 3, ("surface", "seen", "f_1mm")),
    "f_2mm": Figure("F at 2 mm", "", 3, ("surface", "seen", "f_2mm")),
    "chamfer": Figure("Chamfer", "mm", 3, ("surface", "seen", "chamfer_m"), 1e3),
    "normal_out": Figure("normals, mesh to model", "°", 2, ("surface", "seen", "mesh_to_model_normal_deg")),
    "normal_back": Figure("normals, model to mesh", "°", 2, ("surface", "seen", "model_to_mesh_normal_deg")),
    "stated_std": Figure("stated", "mm", 3, ("surface", "calibration", "std_m"), 1e3),
    "std_error": Figure("true", "mm", 3, ("surface", "calibration", "error_m"), 1e3),
    "error_over_std": Figure("true / stated", "", 2, ("surface", "calibration", "error_over_std")),
    "within_1_std": Figure("within 1 σ", "%", 1, ("surface", "calibration", "share_within_1_std"), 1e2),
    "within_2_std": Figure("within 2 σ", "%", 1, ("surface", "calibration", "share_within_2_std"), 1e2),
    "within_3_std": Figure("within 3 σ", "%", 1, ("surface", "calibration", "share_within_3_std"), 1e2),
}

# For a run that lost the object at once or gave no report: its AUC is zero, the rest is not known.
FAILED = {name: 0.0 if name in ("add_auc", "add_s_auc") else None for name in FIGURES}


def read_all(report):
    return {name: figure.read(report) for name, figure in FIGURES.items()}


# The strict ones are for figures that another system has to be better than.
SIGNS = {"<=": "≤", ">=": "≥", "<": "<", ">": ">"}


@dataclasses.dataclass(frozen=True)
class Goal:
    """What the mean of a figure over the seeds shall reach."""

    figure: str
    relation: str  # One of the keys of SIGNS.
    limit: float

    def is_met(self, value):
        if value is None:
            return False
        if self.relation == ">":
            return value > self.limit
        if self.relation == "<":
            return value < self.limit
        # What is shown decides, so that no table contradicts itself.
        shown = round(value, FIGURES[self.figure].digits)
        return shown <= self.limit if self.relation == "<=" else shown >= self.limit

    def show(self):
        return f"{SIGNS[self.relation]} {self.limit:.4g}"


class Summary:
    """The figures of one row over its seeds."""

    def __init__(self, runs):
        self.runs = runs  # seed -> {figure: value}

    def values(self, figure):
        return [run[figure] for run in self.runs.values() if run[figure] is not None]

    def mean(self, figure):
        # A mean over the lucky seeds alone would flatter.
        values = self.values(figure)
        return statistics.fmean(values) if values and len(values) == len(self.runs) else None

    def least(self, figure):
        return min(self.values(figure), default=None)

    def greatest(self, figure):
        return max(self.values(figure), default=None)
