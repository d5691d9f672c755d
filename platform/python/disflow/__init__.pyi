# SPDX-License-Identifier: BSD-3-Clause
from typing import Any, Mapping, Optional, Sequence, Tuple

import numpy as np
import numpy.typing as npt

__version__: str

Floats = npt.NDArray[np.float32]

def settings() -> dict[str, dict[str, Any]]: ...

class Estimate:
    status: int
    status_text: str
    ok: bool
    kind: str
    state: str
    stamp_ns: int
    T_co: Floats
    T_wo: Optional[Floats]
    position_m: Floats
    quaternion_xyzw: Floats
    linear_mps: Floats
    angular_rps: Floats
    pose_covariance: Floats
    twist_covariance: Floats
    weak: str
    weak_axis: Floats
    weak_std: float
    quality: int
    reset_counter: int
    score: float
    conflict: float
    visible: float
    samples: int
    inliers: int
    edge_inliers: int
    hypotheses: int
    iterations: int
    rms_m: float
    inverse_depth_std_per_m: float
    rejected: dict[str, int]

class Tracker:
    profile: str
    bytes: int
    def __init__(self, profile: str = ..., settings: Mapping[str, float] = ...) -> None: ...
    def process(self, depth: npt.NDArray[Any], camera: Sequence[float], stamp_ns: int, *,
                mask: Optional[npt.NDArray[Any]] = ..., mask_label: int = ..., unit_m: float = ...,
                T_wc: Optional[npt.ArrayLike] = ...) -> Estimate: ...
    def fuse(self, depth: npt.NDArray[Any], camera: Sequence[float], stamp_ns: int, T_oc: npt.ArrayLike, *,
             mask: Optional[npt.NDArray[Any]] = ..., mask_label: int = ..., unit_m: float = ...) -> Estimate: ...
    def reset(self) -> None: ...
    def choose_pixel(self, u_px: int, v_px: int, reach_px: int = ...) -> None: ...
    def choose_box(self, x_px: int, y_px: int, width_px: int, height_px: int) -> None: ...
    def mesh(self, resolution_m: float = ..., support_radius_m: float = ...
             ) -> Tuple[Floats, npt.NDArray[np.int32], Floats, Floats]: ...
    def samples(self) -> Tuple[Floats, Floats, Floats, npt.NDArray[np.int32]]: ...
    def query(self, points_m: npt.ArrayLike, support_radius_m: float = ...
              ) -> Tuple[Floats, Floats, Floats, npt.NDArray[np.bool_]]: ...
    def object_mask(self) -> npt.NDArray[np.uint8]: ...
