# SPDX-License-Identifier: BSD-3-Clause
"""Everyday things that the simulator cannot draw: drawn with OpenSCAD (tests/bench/things), turned into meshes for it.

The simulator's own shapes were there when the method was made. Of these, half are to choose by and half to report.
"""

import math
import pathlib
import subprocess

FOLDER = pathlib.Path(__file__).resolve().parents[1] / "things"
TUNING = ("airplane", "banana", "drill", "gamepad", "pitcher", "scissors")
REPORTED = ("brick", "hammer", "padlock", "shoe", "teapot", "wrench")

# Distances are judged at the vertices, so that flat faces need some of their own.
LONGEST_EDGE_M = 0.02


def read_off(text):
    """@return vertices as drawn, triangles as indices"""
    lines = [line.partition("#")[0].split() for line in text.replace("OFF", "", 1).splitlines()]
    (vertices, faces, *_), *lines = ([float(word) for word in line] for line in lines if line)
    points = [tuple(line[:3]) for line in lines[: int(vertices)]]
    triangles = []
    for count, *rest in lines[int(vertices) : int(vertices + faces)]:
        # A colour may follow.
        first, *corners = (int(index) for index in rest[: int(count)])
        triangles += [(first, *pair) for pair in zip(corners, corners[1:])]
    return points, triangles


def centred(points, unit_m):
    """@return the same in metres, about the middle of their box"""
    middle = [(min(values) + max(values)) / 2 for values in zip(*points)]
    return [tuple(unit_m * (x - m) for x, m in zip(point, middle)) for point in points]


def refined(points, triangles, longest_m):
    """Halves edges until none is longer; neighbours halve the same ones, so that what was closed stays closed."""
    points, middles = list(points), {}

    def is_long(a, b):
        return math.dist(points[a], points[b]) > longest_m

    def middle(a, b):
        edge = (min(a, b), max(a, b))
        if edge not in middles:
            middles[edge] = len(points)
            points.append(tuple((x + y) / 2 for x, y in zip(points[a], points[b])))
        return middles[edge]

    done, waiting = [], list(triangles)
    while waiting:
        a, b, c = waiting.pop()
        long = sum((is_long(a, b), is_long(b, c), is_long(c, a)))
        # Turned until the only long edge is the first, or the only short one the last.
        while (long == 1 and not is_long(a, b)) or (long == 2 and is_long(c, a)):
            a, b, c = b, c, a
        if long == 0:
            done.append((a, b, c))
        elif long == 1:
            waiting += [(a, middle(a, b), c), (middle(a, b), b, c)]
        elif long == 2:
            waiting += [(middle(a, b), b, middle(b, c)), (a, middle(a, b), middle(b, c)), (a, middle(b, c), c)]
        else:
            ab, bc, ca = middle(a, b), middle(b, c), middle(c, a)
            waiting += [(a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca)]
    return points, done


def obj_text(points, triangles):
    return "".join([f"v {x:.7f} {y:.7f} {z:.7f}\n" for x, y, z in points]
                   + [f"f {a + 1} {b + 1} {c + 1}\n" for a, b, c in triangles])


def draw(names, folder):
    """Writes a mesh in metres of each. @return its files"""
    folder.mkdir(parents=True, exist_ok=True)
    files = []
    for name in names:
        source = next(FOLDER.glob(f"*/{name}.scad"))
        file = folder / f"{name}.obj"
        changed = max(path.stat().st_mtime for path in (source, FOLDER / "solids.scad"))
        if not file.exists() or file.stat().st_mtime < changed:
            drawn = folder / f"{name}.off"
            done = subprocess.run(["openscad", "-q", "-o", drawn, source], stdin=subprocess.DEVNULL, capture_output=True, text=True)
            if done.returncode != 0:
                raise RuntimeError(f"openscad cannot draw {source}: {done.stderr.strip()}")
            points, triangles = read_off(drawn.read_text(encoding="utf-8"))
            file.write_text(obj_text(*refined(centred(points, 0.001), triangles, LONGEST_EDGE_M)), encoding="utf-8")
        files.append(file)
    return files
