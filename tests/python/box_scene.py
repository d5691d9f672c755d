# SPDX-License-Identifier: BSD-3-Clause
"""A box that moves before a wall, drawn with numpy."""
import numpy as np

WIDTH, HEIGHT, FOCAL = 320, 240, 300.0
CAMERA = (FOCAL, FOCAL, 160.0, 120.0)
HALF_BOX_M = np.array([0.07, 0.05, 0.06])
WALL_M = 1.2


def pose_at(t_s):
    """The box in the camera's frame, 4x4."""
    a, b = 0.6 + 0.8 * t_s, 0.5
    turn = np.array([[np.cos(a), 0, np.sin(a)], [0, 1, 0], [-np.sin(a), 0, np.cos(a)]])
    tilt = np.array([[1, 0, 0], [0, np.cos(b), -np.sin(b)], [0, np.sin(b), np.cos(b)]])
    T_co = np.eye(4)
    T_co[:3, :3] = tilt @ turn
    T_co[:3, 3] = [-0.03 + 0.15 * t_s, 0.05 * t_s, 0.42 + 0.1 * t_s]
    return T_co


def depth_at(t_s):
    """Metres, float32."""
    T_co = pose_at(t_s)
    u, v = np.meshgrid(np.arange(WIDTH), np.arange(HEIGHT))
    rays = np.stack([(u - CAMERA[2]) / FOCAL, (v - CAMERA[3]) / FOCAL, np.ones_like(u, float)], -1)
    slope = rays @ T_co[:3, :3]
    start = -T_co[:3, 3] @ T_co[:3, :3]
    near = ((-np.sign(slope) * HALF_BOX_M - start) / slope).max(-1)
    far = ((np.sign(slope) * HALF_BOX_M - start) / slope).min(-1)
    return np.where(near < far, near, WALL_M).astype(np.float32)


def stamp_at(frame):
    return 1_000_000_000 + frame * 1_000_000_000 // 30
