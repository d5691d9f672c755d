# SPDX-License-Identifier: BSD-3-Clause
"""Sequences by lot: shape, motion, camera, mask and everything else that may differ are drawn at once.

The rows of the accuracy table were there before the method was: whoever improves it looks at them. Here a number draws
a sequence, and there are as many as numbers, so that figures come from sequences that nobody has seen.
"""

import dataclasses
import json
import random
import re
import statistics

import figures
import pages
import runs
from figures import FIGURES, Summary

FRAMES = 200
# What is printed one by one: the share of sequences that went worst.
WORST = 0.15

# Things whose turn about an axis is hard or impossible to see are judged by ADD-S.
TURN_UNSEEN = ("can", "bowl", "tube", "doughnut", "superellipsoid")
SHAPES = (("box", 2), ("rounded-box", 2), ("flat-box", 2), ("bottle", 2), ("spray-bottle", 2), ("bracket", 1), ("mug", 1),
          ("screwdriver", 1), ("can", 1), ("bowl", 1), ("tube", 1), ("doughnut", 1), ("superellipsoid", 1))
MOTIONS = (("fast", 4), ("moderate", 3), ("flying", 1), ("rotate360", 1), ("static", 1))
NOISES = (("stereo", 2), ("d415", 2), ("tof", 2), ("kinect", 1), ("stereo-raw", 1), ("clean", 1))
RATES = (("30", 4), ("15", 2), ("60", 1), ("90", 1))
WIDTHS = (("640", 4), ("320", 1), ("424", 1), ("848", 1), ("1280", 1))
MASKS = (("mask=gt", 6), ("mask=none", 5), ("mask=sloppy", 2), ("mask=leaking", 2), ("mask_delay=2", 1), ("mask_grow_px=5", 1),
         ("mask_grow_px=-3", 1), ("mask_flicker=0.1", 1))
OCCLUDERS = (("none", 7), ("arm", 1), ("hand", 1), ("curtain", 1))
SUPPORTS = (("none", 8), ("table", 1))
CAMERAS = (("static", 4), ("moving", 1))
STREAMS = (("", 7), ("drop=0.1", 1), ("repeat=0.05", 1), ("jitter_ms=3", 1))


@dataclasses.dataclass(frozen=True)
class Ticket:
    """What a number has drawn."""

    number: int
    conditions: tuple  # (what, value as shown)
    scene: str  # What follows "sim:", but for the seed.

    def __getitem__(self, what):
        return dict(self.conditions)[what]

    @property
    def shown(self):
        """The scene, without the folder of a mesh."""
        return re.sub(r"^obj:[^?]*/", "obj:", self.scene)

    @property
    def figure(self):
        """Which figure says how well the sequence went."""
        return "add_s_auc" if self["shape"] in TURN_UNSEEN else "add_auc"


def _draw_one(chance, choices):
    # random() alone is promised to be the same in all versions of Python.
    left = chance.random() * sum(weight for _, weight in choices)
    for value, weight in choices:
        left -= weight
        if left < 0:
            return value
    return choices[-1][0]


def draw(number, meshes=()):
    """@param meshes Files of scanned things in place of the simulator's own."""
    chance = random.Random(number)
    shapes = tuple((f"obj:{file.resolve()}", 1) for file in meshes) or SHAPES
    shape = _draw_one(chance, shapes)
    motion, noise, rate, width = (_draw_one(chance, choices) for choices in (MOTIONS, NOISES, RATES, WIDTHS))
    mask, occluder, support, camera, stream = (
        _draw_one(chance, choices) for choices in (MASKS, OCCLUDERS, SUPPORTS, CAMERAS, STREAMS)
    )
    near, distance = chance.random() < 0.6, 0.7 + 0.6 * chance.random()
    edge, uneven = 1 + 9 * chance.random(), 0.4 * (chance.random() < 0.3)
    if noise.startswith("stereo") and width == "1280":
        width = "640"  # Matching takes minutes there.
    # What is as ever is left out: a scene is also the name of its files.
    options = [f"motion={motion}", f"noise={noise}", f"frames={FRAMES}", stream]
    options += [f"{name}={value}" for name, value, usual in (
        ("fps", rate, "30"), ("width", width, "640"), ("height", str(int(width) * 9 // 16), "360"), ("occluder", occluder, "none"),
        ("support", support, "none"), ("camera", camera, "static")) if value != usual]
    options += [mask] if mask != "mask=gt" else []
    options += [] if near else [f"distance_m={distance:.2f}"]
    options += [f"edge_mm={edge:.1f}"] if shape in ("rounded-box", "flat-box") else []
    options += [f"uneven_mm={uneven}"] if uneven else []
    conditions = {"shape": shape.rpartition("/")[2].removesuffix(".obj"), "motion": motion, "noise": noise, "images/s": rate, "width px": width,
                  "mask": mask.replace("mask=", ""), "in front": occluder, "on": support, "camera": camera,
                  "stream": stream or "whole", "distance": "near" if near else "0.7 to 1.3 m"}
    return Ticket(number, tuple(conditions.items()), f"{shape}?" + "&".join(option for option in options if option))


def job_of(ticket, settings=()):
    # Named by its settings, so that --continue does not take it for a run with others.
    return runs.Job(" ".join(("lot", *settings)), ticket.scene, ticket.number, tuple(settings))


def measure(programs, tickets, settings=()):
    """Runs everything. @return number -> figures"""
    results = runs.run_all([job_of(ticket, settings) for ticket in tickets], programs.track)
    return {ticket.number: results[job_of(ticket, settings)] for ticket in tickets}


def _lost(result):
    return FRAMES if result["lost"] is None else result["lost"]


def _middle(summary, figure):
    values = summary.values(figure)
    return FIGURES[figure].show(statistics.median(values) if values else None)


def _line(name, tickets, results):
    """What a group of sequences came to."""
    summary = Summary({ticket.number: results[ticket.number] for ticket in tickets})
    own = summary.runs.values()
    scores = [results[ticket.number][ticket.figure] for ticket in tickets]
    inside = [statistics.fmean(result[figure] or 0.0 for result in own) for figure in ("pose_nees", "twist_nees")]
    return [name, str(len(tickets)), f"{statistics.fmean(scores):.1f}", f"{statistics.median(scores):.1f}",
            f"{sum(score < 95 for score in scores)}", f"{statistics.fmean(map(_lost, own)):.1f}",
            *(_middle(summary, figure) for figure in ("e_t", "e_a", "v", "w")), *(f"{share:.0f}" for share in inside)]


HEAD = ["", "sequences", "AUC mean", "median", "below 95", f"lost of {FRAMES}", "e_t mm", "e_a °", "v cm/s", "ω °/s", "pose inside %",
        "twist inside %"]


def page(tickets, results):
    """Markdown: all, by condition, and those that went worst."""
    lines = [_line("all", tickets, results)]
    for what, _ in tickets[0].conditions:
        values = sorted({ticket[what] for ticket in tickets})
        lines += [_line(f"{what}: {value}", [t for t in tickets if t[what] == value], results) for value in values]
    worst = sorted(tickets, key=lambda ticket: results[ticket.number][ticket.figure])[: max(1, int(WORST * len(tickets)))]
    rows = [[f"{t.number}: `{t.shown}`", f"{results[t.number][t.figure]:.1f}", f"{results[t.number]['add_s_auc']:.1f}", f"{_lost(results[t.number]):.0f}"]
            for t in worst]
    numbers = pages.name_seeds([ticket.number for ticket in tickets])
    unseen = [shape for shape in TURN_UNSEEN if any(ticket["shape"] == shape for ticket in tickets)]
    judged = f"ADD, of {', '.join(unseen)} ADD-S" if unseen else "ADD"
    return (f"{len(tickets)} sequences of {FRAMES} images, {numbers}. AUC: {judged}. Means of AUC, lost and inside, "
            "medians of the rest; what never starts has an AUC of 0, all images lost and none inside.\n\n"
            + pages.table(HEAD, lines) + "\nThose that went worst:\n\n" + pages.table(["", "AUC", "ADD-S", "lost"], rows))


def compare(tickets, before, results):
    """Markdown: what has changed against a run before, and which sequences gained or lost a point."""
    both = [ticket for ticket in tickets if ticket.number in before]
    lines = [_line("before", both, before), _line("now", both, results)]
    gains = {t: results[t.number][t.figure] - before[t.number][t.figure] for t in both}
    moved = sorted((t for t in both if abs(gains[t]) > 1.0), key=gains.get)
    rows = [[f"{t.number}: `{t.shown}`", f"{before[t.number][t.figure]:.1f}", f"{results[t.number][t.figure]:.1f}"] for t in moved]
    return pages.table(HEAD, lines) + "\nBy more than a point:\n\n" + pages.table(["", "before", "now"], rows)


def write_json(path, results):
    path.write_text(json.dumps(results, indent=1) + "\n", encoding="utf-8")


def read_json(path):
    """@return number -> figures"""
    stored = json.loads(path.read_text(encoding="utf-8"))
    return {int(number): dict(figures.FAILED) | result for number, result in stored.items()}
