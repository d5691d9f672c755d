# SPDX-License-Identifier: BSD-3-Clause
"""Several objects at once, passing in front of each other: how each is tracked and what a frame of all costs."""

import collections
import csv
import json
import re

import figures
import pages
import runs
from figures import FIGURES, Summary

# The nearest first; a name and its number in the masks follow from the place.
SCENES = {
    "two": ("box", "bottle"),
    "four, small in front": ("bottle", "bottle", "box", "box"),
    "four, large in front": ("box", "bottle", "box", "bottle"),
}
NOISES = ("clean", "d415")
THREADS = (1, 2)

# Why a frame gives no pose when next to nothing of the object is seen.
UNSEEN = ("empty_mask", "no_valid_depth", "too_few_samples")


def names_of(shapes):
    """As the simulated camera calls them: of two boxes the second is box2."""
    seen = collections.Counter()
    names = []
    for shape in shapes:
        seen[shape] += 1
        names.append(shape if seen[shape] == 1 else f"{shape}{seen[shape]}")
    return names


def job_of(shapes, noise, seed):
    return runs.Job("objects", f"{'+'.join(shapes)}?motion=moderate&noise={noise}", seed)


def track(programs, shapes, job, threads):
    """Tracks all objects of a scene. @return What disflow_track says at its end."""
    words = ["--sensor", job.address, "--csv", programs.file(job, ".csv"), "--headless", "--threads", threads]
    for label, name in enumerate(names_of(shapes), start=1):
        words += ["--object", f"name={name},label={label}"]
    return programs.call("disflow_track", *words, stream="stderr")


def judge(programs, job, name):
    """The figures of one object, and how often it could not be seen."""
    stem = programs.file(job, "")
    trajectory, report = stem.with_name(f"{stem.name}-{name}.csv"), stem.with_name(f"{stem.name}-{name}.json")
    programs.call("disflow_eval", job.address, "--object", name, "--csv", trajectory, "--json", report)
    read = figures.read_all(json.loads(report.read_text(encoding="utf-8")))
    with open(trajectory, encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))
    read["unseen"] = sum(row["status"] in UNSEEN for row in rows)
    read["restarts"] = int(rows[-1]["reset_counter"])
    return read


def read_times(text):
    """Median and 99th percentile of a whole frame in ms."""
    found = re.search(r"all \d+ objects, .*median ([\d.]+) ms, 99 % below ([\d.]+) ms", text)
    if found is None:
        raise RuntimeError("disflow_track did not say how long frames took")
    return float(found[1]), float(found[2])


def measure(programs, seeds):
    """Runs everything. @return The tables."""
    jobs = {job_of(shapes, noise, seed): shapes for shapes in SCENES.values() for noise in NOISES for seed in seeds}

    def work(job):
        track(programs, jobs[job], job, THREADS[0])
        return {name: judge(programs, job, name) for name in names_of(jobs[job])}

    results = runs.run_all(list(jobs), work)
    lines = []
    for title, shapes in SCENES.items():
        for noise in NOISES:
            for name in names_of(shapes):
                summary = Summary({seed: results[job_of(shapes, noise, seed)][name] for seed in seeds})
                line = [f"{title}, {noise}: {name}"]
                line += [FIGURES[figure].show(summary.mean(figure)) for figure in ("add_auc", "add_s_auc")]
                line.append(FIGURES["add_auc"].show(summary.least("add_auc")))
                line += [f"{summary.mean(count):.1f}" for count in ("lost", "unseen", "restarts")]
                lines.append(line)
    head = ["objects, nearest first", "ADD-AUC %", "ADD-S-AUC %", "worst seed: ADD-AUC %", "frames without a pose",
            "of them unseen", "restarts"]
    seed_text = pages.name_seeds(seeds)
    text = f"Means over {seed_text}, 300 frames each.\n\n" + pages.table(head, lines)
    times = []
    for title, shapes in SCENES.items():
        for noise in NOISES:
            # Alone and one after another, so that nothing else takes the processors.
            measured = [read_times(track(programs, shapes, job_of(shapes, noise, seeds[0]), n)) for n in THREADS]
            times.append([f"{title}, {noise}"] + [f"{value:.2f}" for pair in measured for value in pair])
    head = ["a frame of all objects, ms"] + [f"{n} thread{'s' if n > 1 else ''}: {what}"
                                             for n in THREADS for what in ("median", "99 %")]
    return text + "\n" + pages.table(head, times)
