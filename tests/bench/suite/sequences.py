# SPDX-License-Identifier: BSD-3-Clause
"""The simulated sequences of the accuracy table and what is asked of each."""

import dataclasses

from figures import Goal


@dataclasses.dataclass(frozen=True)
class Row:
    """One kind of sequence; every seed makes another motion, noise and view of it."""

    name: str
    scene: str  # What follows "sim:", but for the seed.
    goals: tuple = ()
    like: str = ""  # Row whose ADD-AUC this one shall come near to.
    mesh: bool = False  # The surface is judged too.
    timed: bool = False  # Run once more, alone, for the times.


# Points of ADD-AUC that a disturbance may cost.
NEAR = 0.6

# Shares of frames inside the 95 % bounds of the NEES, asked of every noisy sequence.
CONSISTENT = tuple(
    Goal(figure, relation, limit)
    for figure in ("pose_nees", "twist_nees")
    for relation, limit in ((">=", 80.0), ("<=", 99.0))
)

SURFACE = (
    Goal("f_1mm", ">=", 0.95),
    Goal("f_2mm", ">=", 0.99),
    Goal("chamfer", "<=", 0.5),
    Goal("normal_out", "<=", 5.0),
    Goal("normal_back", "<=", 5.0),
)

# Of the standard deviation that the surface states, on noisy sequences: within a factor of 1.5.
CALIBRATED = (Goal("error_over_std", ">=", 0.67), Goal("error_over_std", "<=", 1.5))

# Of the timed rows.
SPEED = (Goal("median_ms", "<=", 1.2), Goal("p99_ms", "<=", 2.5))
MEMORY_LIMIT_BYTES = 3 << 19  # 1.5 MiB


def _accuracy(add_auc, e_t, e_a, v, w):
    limits = {"e_t": e_t, "e_a": e_a, "v": v, "w": w}
    return (Goal("add_auc", ">=", add_auc),) + tuple(Goal(name, "<=", limit) for name, limit in limits.items())


def _row(thing, motion, noise, goals=(), extra="", label="", shown="", **more):
    """@param thing What follows "sim:". @param shown Its name on the page, if that is another one."""
    name = f"{shown or thing}, {motion}, {noise}" + (f", {label}" if label else "")
    scene = f"{thing}?motion={motion}&noise={noise}" + (f"&{extra}" if extra else "")
    if noise != "clean":
        goals = tuple(goals) + CONSISTENT
    return Row(name, scene, tuple(goals), **more)


def _add_auc(limit, v=None, w=None):
    goals = (Goal("add_auc", ">=", limit),)
    return goals + ((Goal("v", "<=", v), Goal("w", "<=", w)) if v else ())


# Of one full turn back to the start.
TURNED = (Goal("drift_m", "<=", 0.6), Goal("v", "<=", 0.8), Goal("w", "<=", 3.0))


def of_scanned(file):
    """Rows of a mesh that somebody scanned, in metres. @param file A pathlib.Path."""

    def row(motion, noise, goals=(), extra="", label="", **more):
        return _row(f"obj:{file}", motion, noise, goals, extra, label, shown=file.stem, **more)

    plain = f"{file.stem}, fast, stereo"
    return (
        row("fast", "stereo", _add_auc(98.7, 2.0, 12.0)),
        row("fast", "stereo", (), "mask=sloppy", "sloppy mask", like=plain),
        row("fast", "stereo", (), "mask=none", "no mask", like=plain),
        row("fast", "stereo-raw", _add_auc(97.8)),
        row("flying", "stereo", _add_auc(98.0)),
        row("fast", "tof", _add_auc(98.5)),
        row("fast", "d415", _add_auc(99.2, 1.3, 6.0)),
        row("rotate360", "d415", TURNED + CALIBRATED, mesh=True),
        row("fast", "clean", (Goal("add_auc", ">=", 99.92), Goal("e_a", "<=", 0.1))),
    )


def _rows():
    rows = []

    def add(*words, **more):
        rows.append(_row(*words, **more))

    disturbances = (
        ("mask=sloppy", "sloppy mask"),
        ("mask=none", "no mask"),
        ("occluder=arm", "arm in front"),
        ("drop=0.2", "20 % dropped"),
        ("camera=moving", "moving camera"),
    )
    # Cameras as they are come first, what no camera does comes last.
    for thing in ("box", "bottle", "rounded-box", "mug"):
        add(thing, "fast", "stereo", _add_auc(98.7, 2.0, 12.0))
    add("flat-box", "fast", "stereo", _add_auc(98.7))
    for thing in ("box", "bottle", "rounded-box", "mug"):
        add(thing, "fast", "stereo-raw", _add_auc(97.8))
    for thing in ("box", "bottle"):
        add(thing, "flying", "stereo", _add_auc(98.0))
    for extra, label in disturbances[:2]:
        for thing in ("box", "bottle"):
            add(thing, "fast", "stereo", (), extra, label, like=f"{thing}, fast, stereo")
    for thing in ("box", "bottle"):
        add(thing, "fast", "tof", _add_auc(98.5))
    add("box", "fast", "d415", _add_auc(99.2, 1.3, 6.0), timed=True)
    add("bottle", "fast", "d415", _add_auc(99.5, 1.3, 6.0), timed=True)
    for thing, limit in (("rounded-box", 99.2), ("mug", 99.2), ("flat-box", 99.3)):
        add(thing, "fast", "d415", _add_auc(limit))
    for thing in ("box", "bottle"):
        add(thing, "rotate360", "d415", TURNED + CALIBRATED, mesh=True)
    for extra, label in disturbances + (
        ("mask=leaking", "leaking mask"),
        ("mask_delay=2", "mask 2 frames late"),
        ("mask_grow_px=6", "mask too large"),
        ("mask_grow_px=-4", "mask too small"),
        ("mask_flicker=0.1", "flickering mask"),
        ("repeat=0.05&jitter_ms=3", "images repeated, stamps off"),
    ):
        for thing in ("box", "bottle"):
            timed = thing == "box" and extra == "mask=none"
            add(thing, "fast", "d415", (), extra, label, like=f"{thing}, fast, d415", timed=timed)
    add("box", "fast", "clean", _accuracy(99.85, 0.2, 0.05, 0.9, 3.0))
    add("bottle", "fast", "clean", _accuracy(99.95, 0.1, 0.08, 0.8, 3.0))
    for thing in ("box", "bottle"):
        add(thing, "flying", "clean", _add_auc(99.6))
    for extra, label in (("fps=15", "15 frames/s"), ("fps=15&mask=none", "15 frames/s, no mask")):
        for thing in ("box", "bottle"):
            add(thing, "flying", "clean", _add_auc(98.5), extra, label)
    for thing in ("box", "bottle"):
        add(thing, "rotate360", "clean", mesh=True)
    symmetric = (Goal("add_s_auc", ">=", 99.0), Goal("drift_m", "<=", 2.0))
    for noise in ("clean", "white"):
        for thing in ("can", "doughnut"):
            seen_seams = (Goal("add_auc", ">=", 99.0),) if (thing, noise) == ("can", "clean") else ()
            add(thing, "fast", noise, symmetric + seen_seams)
    add("box", "fast", "white", _accuracy(99.2, 0.9, 0.4, 1.8, 7.5))
    add("bottle", "fast", "white", _accuracy(99.6, 0.35, 0.5, 1.0, 9.0))
    for thing in ("box", "bottle"):
        add(thing, "flying", "white", _add_auc(98.8))
    drift = (Goal("drift_m", "<=", 0.3), Goal("drift_deg", "<=", 0.15))
    add("box", "rotate360", "white", drift + CALIBRATED, mesh=True)
    add("bottle", "rotate360", "white", drift + SURFACE + CALIBRATED, mesh=True)
    return tuple(rows)


ROWS = _rows()
