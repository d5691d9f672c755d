# SPDX-License-Identifier: BSD-3-Clause
"""The tracker beside ICP of PCL: the same frames, the same given masks, the same run, one thread."""

import dataclasses
import datetime
import json
import pathlib
import shutil
import statistics

import figures
import pages
import runs
from figures import Figure, Summary

OBJECTS = ("box", "bottle", "rounded-box", "flat-box", "mug", "spray-bottle", "superellipsoid", "bracket",
           "screwdriver", "tube", "bowl", "can", "doughnut")
# A turn of theirs is hard or impossible to see, so that only the distance to the nearest point tells.
TURNING = ("screwdriver", "tube", "bowl", "can", "doughnut")
NOISES = ("stereo", "d415", "clean")
QUICK_OBJECTS = OBJECTS[:2]
QUICK_NOISES = NOISES[1:]

TRACKER = "DisFlow"


@dataclasses.dataclass(frozen=True)
class Setting:
    """One way to run a peer."""

    voxel_mm: int
    distance_mm: int
    neighbours: int
    flatness: float = 0.0  # Of generalised ICP alone.

    @property
    def words(self):
        words = ["--voxel", self.voxel_mm / 1000, "--distance", self.distance_mm / 1000, "--neighbours", self.neighbours]
        return words + (["--flatness", self.flatness] if self.flatness else [])

    def show(self):
        text = f"{self.voxel_mm}/{self.distance_mm}/{self.neighbours}"
        return f"{text}/{self.flatness:g}" if self.flatness else text


@dataclasses.dataclass(frozen=True)
class Peer:
    title: str
    method: str  # As peer_trackers calls it.
    settings: tuple


PEERS = (
    Peer("GICP", "gicp",
         (Setting(3, 10, 20, 0.001), Setting(4, 10, 20, 0.01), Setting(4, 20, 10, 0.03))),
    Peer("point-to-plane", "point-to-plane", (Setting(3, 10, 20), Setting(4, 10, 20), Setting(4, 5, 10))),
)

# What peer_trackers says of a run.
COSTS = {
    "mean_ms": Figure("mean", "ms", 1, ("mean_ms",)),
    "median_ms": Figure("median", "ms", 1, ("median_ms",)),
    "allocations": Figure("allocations", "per frame", 0, ("allocations_per_frame",)),
    "memory": Figure("memory", "MB", 1, ("memory_bytes",), 1e-6),
}
ACCURACIES = {name: figures.FIGURES[name] for name in ("add_auc", "add_s_auc", "e_t", "e_a", "v", "w", "lost")}
SHOWN = {**ACCURACIES, **COSTS}


@dataclasses.dataclass(frozen=True)
class Row:
    name: str
    thing: str  # As disflow_sim --object takes it.
    noise: str


def rows(quick, obj_files=(), only=()):
    """@param obj_files Scanned meshes, in addition. @param only As main.py's --only."""
    things = list(QUICK_OBJECTS if quick else OBJECTS) + [str(file) for file in obj_files]
    noises = QUICK_NOISES if quick else NOISES
    made = [Row(f"{pathlib.Path(thing).stem}, fast, {noise}", thing, noise) for thing in things for noise in noises]
    return [row for row in made if not only or any(text in row.name for text in only)]


def judged_by(name):
    """@param name Of a row. @return The figure by which its methods are compared."""
    return "add_s_auc" if name.split(",")[0] in TURNING else "add_auc"


def best(by_setting, figure="add_auc"):
    """@param by_setting setting -> seed -> figures. @return The setting with the highest mean of a figure and its summary."""
    summaries = {setting: Summary(seeds) for setting, seeds in by_setting.items()}
    return max(summaries.items(), key=lambda item: item[1].mean(figure))


def judge_velocities(plain, extrapolated):
    """The figures of a run with the better v and the better ω, each for itself, of two and of three poses."""
    judged = dict(plain)
    for name in ("v", "w"):
        known = [run[name] for run in (plain, extrapolated) if run[name] is not None]
        judged[name] = min(known, default=None)
    return judged


class Sequence:
    """A recorded sequence that all methods read, gone afterwards: one takes as much as a gigabyte for every 1000 frames."""

    def __init__(self, programs, row, seed, frames):
        self.folder = programs.out_dir / "sequences" / runs.Job(row.name, row.noise, seed).stem
        shutil.rmtree(self.folder, ignore_errors=True)
        programs.call("disflow_sim", "--object", row.thing, "--motion", "fast", "--noise", row.noise, "--seed", seed,
                      "--frames", frames, self.folder)

    def __enter__(self):
        return self.folder

    def __exit__(self, *_):
        shutil.rmtree(self.folder, ignore_errors=True)


def run_method(programs, sequence, method, words=()):
    """@return Figures of accuracy and cost of one method on a recorded sequence."""
    stem = programs.out_dir / "runs" / "-".join([sequence.name, method, *(str(word).strip("-") for word in words)])
    csv, extrapolated = f"{stem}.csv", f"{stem}-extrapolated.csv"
    call = ["--sensor", f"replay:{sequence}", "--csv", csv, "--method", method, *words]
    call += ["--csv-extrapolated", extrapolated] if words else []
    cost = json.loads(programs.call("peer_trackers", *call))
    judged = _judge(programs, sequence, csv)
    if words:
        judged = judge_velocities(judged, _judge(programs, sequence, extrapolated))
    judged.update({name: figure.read(cost) for name, figure in COSTS.items()})
    return {name: judged[name] for name in SHOWN}


def _judge(programs, sequence, csv):
    report = pathlib.Path(csv).with_suffix(".json")
    programs.call("disflow_eval", sequence, "--csv", csv, "--json", report,
                  "--frames", pathlib.Path(csv).with_suffix(".frames.csv"))
    return figures.read_all(json.loads(report.read_text(encoding="utf-8")))


def measure(programs, wanted, seeds, frames):
    """Everything one after another, so that times are those of a processor of one's own.
    @return row name -> title of a method -> setting -> seed -> figures."""
    results = {}
    for row in wanted:
        of_row = results.setdefault(row.name, {})
        for seed in seeds:
            with Sequence(programs, row, seed, frames) as sequence:
                of_row.setdefault(TRACKER, {}).setdefault("", {})[seed] = run_method(programs, sequence, "disflow")
                for peer in PEERS:
                    for setting in peer.settings:
                        run = run_method(programs, sequence, peer.method, setting.words)
                        of_row.setdefault(peer.title, {}).setdefault(setting.show(), {})[seed] = run
        # What was measured so far is kept if the rest fails.
        write_json(programs.out_dir / "peers.json", results)
    return results


def _line(name, title, setting, summary, bold):
    """@param bold Figure to stress, or None."""
    cells = [f"**{figure.show(summary.mean(key))}**" if key == bold else figure.show(summary.mean(key))
             for key, figure in SHOWN.items()]
    return [name, title + (f" {setting}" if setting else "")] + cells


def _judge_row(name, of_row):
    """@return title -> what the methods of a row are compared by."""
    figure = judged_by(name)
    return {title: best(by_setting, figure)[1].mean(figure) for title, by_setting in of_row.items()}


def ahead(results):
    """@return (row, title of the peer, points) where a peer is better than the tracker."""
    found = []
    for name, of_row in results.items():
        judged = _judge_row(name, of_row)
        found += [(name, peer.title, judged[peer.title] - judged[TRACKER]) for peer in PEERS
                  if judged[peer.title] > judged[TRACKER]]
    return found


def means(results):
    """@return noise -> title -> mean over its rows of what they are judged by."""
    collected = {}
    for name, of_row in results.items():
        of_noise = collected.setdefault(name.split(", ")[-1], {})
        for title, value in _judge_row(name, of_row).items():
            of_noise.setdefault(title, []).append(value)
    return {noise: {title: statistics.fmean(values) for title, values in of_noise.items()}
            for noise, of_noise in collected.items()}


def page(results, seeds, frames, today, remark=""):
    """What stands between the markers of docs/results.md."""
    lines = []
    for name, of_row in results.items():
        judged = _judge_row(name, of_row)
        for title, by_setting in of_row.items():
            setting, summary = best(by_setting, judged_by(name))
            bold = judged_by(name) if judged[title] == max(judged.values()) else None
            lines.append(_line(name if title == TRACKER else "", title, setting, summary, bold))
    head = ["sequence", "method"] + [f"{figure.title} {figure.unit}".strip() for figure in SHOWN.values()]
    wins = ahead(results)
    said = "; ".join(f"{name}: {title} by {gain:.2f}" for name, title, gain in wins) or "nowhere"
    titles = [TRACKER] + [peer.title for peer in PEERS]
    return "\n\n".join([
        f"Measured on {today:%Y-%m-%d}, {pages.name_seeds(seeds)}, {frames} frames each{', ' + remark if remark else ''}. "
        f"Rows are judged by ADD-AUC, those of {', '.join(TURNING)} by ADD-S-AUC, since a turn of theirs is hard or impossible to see; "
        "the highest is bold. Of each peer that setting is shown, row by row, which is judged best: voxel mm / farthest correspondence mm / "
        "neighbours of a normal / for GICP the flatness of its discs. All settings: [peers.json](peers.json).",
        pages.table(["mean over the shapes"] + titles,
                    [[noise] + [f"{of_noise[title]:.2f}" for title in titles] for noise, of_noise in means(results).items()]),
        f"A peer is above the tracker in {len({win[0] for win in wins})} of {len(results)} rows (points): {said}.",
        pages.table(head, lines),
    ])


def write_json(path, results):
    shown = {"units": {name: figure.unit for name, figure in SHOWN.items()}, "rows": results}
    path.write_text(json.dumps(shown, indent=1, ensure_ascii=False) + "\n", encoding="utf-8")


def today():
    return datetime.date.today()
