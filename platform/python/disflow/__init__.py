# SPDX-License-Identifier: BSD-3-Clause
"""Pose, twist and shape of a moving object from depth images, in fixed memory.

    import disflow
    tracker = disflow.Tracker()
    estimate = tracker.process(depth, (fx, fy, cx, cy), stamp_ns)
    if estimate.kind == 'measured':
        print(estimate.T_co, estimate.linear_mps, estimate.pose_covariance)
    vertices, triangles, normals, std_m = tracker.mesh()

Metres, radians, nanoseconds; camera axes: x right, y down, z forward.
"""
from ._disflow import Estimate, Tracker, __version__, settings

__all__ = ['Estimate', 'Tracker', 'settings', '__version__']
