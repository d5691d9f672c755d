# SPDX-License-Identifier: BSD-3-Clause
"""What a frame costs: instructions by stage, counted by callgrind, not timed."""

import csv
import dataclasses
import json
import pathlib
import shutil
import subprocess

import pages
import runs

START = 5  # First frames, in which the model is made and the velocity is not known.
MOST_GROWTH = 0.05  # Of a median, until the check fails.
SEED = 11


@dataclasses.dataclass(frozen=True)
class Row:
    """A sequence and who tracks it. Micro sees what its memory holds: images of 213 by 120 pixels."""

    thing: str
    noise: str
    mask: str  # "gt" or "none".
    profile: str = "edge"

    @property
    def size_px(self):
        return (213, 120) if self.profile == "micro" else (640, 360)

    @property
    def name(self):
        mask = "mask given" if self.mask == "gt" else "no mask"
        return f"{self.thing}, {self.noise}, {mask}, {self.profile.capitalize()}"


ROWS = tuple(
    Row(thing, noise, mask, profile)
    for profile in ("edge", "micro", "dense")
    for thing in ("box", "bottle")
    for noise, mask in (("d415", "gt"), ("d415", "none"), ("stereo", "gt"))
    # Matched windows of nine pixels tell next to nothing of an object that is 60 pixels wide.
    if not (noise == "stereo" and profile == "micro")
    # Enough to tell what its memory costs.
    if profile != "dense" or (noise, mask) == ("d415", "gt")
)
# Sequences on stereo take a minute each to make.
QUICK_ROWS = tuple(row for row in ROWS if row.noise == "d415" and row.mask == "gt" and row.profile != "dense")


def total_of(path):
    """The instructions that one file of callgrind's counted."""
    with open(path, encoding="utf-8") as file:
        for line in file:
            if line.startswith(("totals:", "summary:")):
                return int(line.split()[1])
    raise RuntimeError(f"{path}: has no line 'totals:'; was it written by callgrind?")


def read_counts(table, dumps):
    """@param table Lines of frame_cost: which stages a frame went through.
    @param dumps Callgrind's files in the order of the marks, of which each frame has one more for its beginning.
    @return frame by frame: stage -> instructions."""
    totals = iter([total_of(path) for path in dumps])
    frames = []
    try:
        for line in csv.DictReader(table):
            stages = {name: int(count) for name, count in line.items() if name not in ("frame", "status")}
            next(totals)
            frames.append({name: sum([next(totals) for _ in range(count)]) for name, count in stages.items()})
    except StopIteration:
        raise RuntimeError("callgrind wrote fewer files than there were marks") from None
    return frames


def spread_of(values):
    """Median, 99th percentile and largest after the start; in instructions."""
    ordered = sorted(values)
    return {
        "median": ordered[len(ordered) // 2],
        "p99": ordered[len(ordered) * 99 // 100],
        "most_later": max(values[START:], default=0),
    }


def summarise(frames):
    """stage -> spread; the frame as a whole is "frame"."""
    summary = {stage: spread_of([frame[stage] for frame in frames]) for stage in frames[0]}
    summary["frame"] = spread_of([sum(frame.values()) for frame in frames])
    return summary


def count(programs, row, frames):
    """Tracks a recorded sequence under callgrind."""
    if shutil.which("valgrind") is None:
        raise RuntimeError("valgrind is missing; ./dev bench cost installs it")
    folder = programs.out_dir / "sequences" / runs.Job(row.name, "", SEED).stem
    dumps = folder / "callgrind"
    shutil.rmtree(folder, ignore_errors=True)
    try:
        programs.call("disflow_sim", "--object", row.thing, "--motion", "fast", "--noise", row.noise, "--seed", SEED,
                      "--frames", frames, "--width", row.size_px[0], "--height", row.size_px[1], folder)
        dumps.mkdir()
        mask = "?mask=gt" if row.mask == "gt" else "?mask=none"
        done = subprocess.run(
            ["valgrind", "--tool=callgrind", "--instr-atstart=no", f"--callgrind-out-file={dumps}/out",
             programs.bin_dir / "frame_cost", "--sensor", f"replay:{folder}{mask}", "--profile", row.profile],
            capture_output=True, text=True, check=False)
        if done.returncode != 0:
            raise RuntimeError(f"frame_cost ended with {done.returncode}: {done.stderr.strip()}")
        if not any(line.split(",")[1] == "ok" for line in done.stdout.splitlines()[1:]):
            raise RuntimeError(f"{row.name}: not one frame was tracked")
        files = sorted(dumps.glob("out.*"), key=lambda path: int(path.suffix[1:]))
        return summarise(read_counts(done.stdout.splitlines(), files))
    finally:
        shutil.rmtree(folder, ignore_errors=True)


def measure(programs, rows, frames):
    """row name -> stage -> spread"""
    return {row.name: count(programs, row, frames) for row in rows}


def _millions(instructions):
    return f"{instructions * 1e-6:.2f}"


def page(results, commit, frames):
    """What stands between the markers of docs/performance.md."""
    stages = [stage for stage in next(iter(results.values())) if stage != "frame"]
    head = ["sequence"] + [f"{stage}" for stage in stages] + ["frame", "99th percentile", f"most after frame {START}", "p99 / median"]
    lines = []
    for name, of_row in results.items():
        frame = of_row["frame"]
        lines.append([name] + [_millions(of_row[stage]["median"]) for stage in stages] + [
            f"**{_millions(frame['median'])}**", _millions(frame["p99"]), _millions(frame["most_later"]),
            f"{frame['p99'] / frame['median']:.2f}"])
    return "\n\n".join([
        f"Millions of x86-64 instructions per frame: medians by stage and of the whole, commit {commit}, seed {SEED}, {frames} frames in "
        "fast motion, built by gcc as `./dev build` does.",
        pages.table(head, lines),
    ])


def grown(results, stored):
    """@return (row name, stored median, median) of the rows that cost more than they may."""
    found = []
    for name, of_row in results.items():
        if name not in stored:
            continue
        before, now = stored[name]["frame"]["median"], of_row["frame"]["median"]
        if now > (1.0 + MOST_GROWTH) * before:
            found.append((name, before, now))
    return found


def check(results, path):
    """Compares with the figures that are stored in the tree. @return Lines to print. @throws RuntimeError if a row has grown."""
    stored = json.loads(path.read_text(encoding="utf-8"))["rows"]
    known = [name for name in results if name in stored]
    if not known:
        raise RuntimeError(f"{path}: has none of the rows that were measured")
    lines = [f"{name}: {_millions(results[name]['frame']['median'])} M instructions, "
             f"stored {_millions(stored[name]['frame']['median'])} M" for name in known]
    if bad := grown(results, stored):
        said = "; ".join(f"{name}: {_millions(now)} M, stored {_millions(before)} M" for name, before, now in bad)
        raise RuntimeError(f"a median frame costs over {100 * MOST_GROWTH:.0f} % more than {path.name} says: {said}. "
                           "If it is worth it, ./dev bench cost stores the new figures")
    return lines


def commit_of(root):
    done = subprocess.run(["git", "-C", root, "describe", "--always", "--dirty"], capture_output=True, text=True, check=False)
    return done.stdout.strip() or "unknown"


def write_json(path, results, frames, commit):
    shown = {"unit": "instructions", "commit": commit, "frames": frames, "rows": results}
    pathlib.Path(path).write_text(json.dumps(shown, indent=1, ensure_ascii=False) + "\n", encoding="utf-8")
