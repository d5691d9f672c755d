# SPDX-License-Identifier: BSD-3-Clause
"""The accuracy table: all rows, checked against their goals."""

import json

import figures
import pages
import runs
import sequences
from figures import FIGURES, Goal, Summary

MET = "✓"
MISSED = "✗"
TSDF = "TSDF baseline"
TIME_REPEATS = 3


class Results:
    """Everything that one run of the suite measured."""

    def __init__(self, rows, seeds):
        self.rows = rows
        self.seeds = seeds
        self.summaries = {}  # row name -> Summary
        self.baseline = {}  # row name -> Summary of the TSDF mesh from the same poses
        self.times = {}  # row name -> Summary, run alone
        self.tracker_bytes = 0
        self.checks = []  # (what, value shown, goal shown, met)

    def mean(self, row_name, figure):
        return self.summaries[row_name].mean(figure)

    def check(self, what, value, goal):
        met = goal.is_met(value)
        figure = FIGURES[goal.figure]
        self.checks.append((f"{what}: {figure.title}", f"{figure.show(value)} {figure.unit}".strip(), goal.show(), met))
        return met

    def json(self):
        def means(summaries):
            return {
                name: {
                    "mean": {figure: summary.mean(figure) for figure in FIGURES},
                    "seeds": {str(seed): run for seed, run in summary.runs.items()},
                }
                for name, summary in summaries.items()
            }

        return {
            "units": {name: figure.unit for name, figure in FIGURES.items()},
            "rows": means(self.summaries),
            "tsdf_baseline": means(self.baseline),
            "times": means(self.times),
            "tracker_bytes": self.tracker_bytes,
            "goals": [dict(zip(("what", "value", "goal", "met"), check)) for check in self.checks],
        }


def measure(programs, rows, seeds):
    """Runs everything."""
    results = Results(rows, seeds)
    jobs = {runs.Job(row.name, row.scene, seed, mesh=row.mesh): row for row in rows for seed in seeds}
    by_row = {row.name: {} for row in rows}
    for job, run in runs.run_all(list(jobs), programs.track).items():
        by_row[job.name][job.seed] = run
    results.summaries = {name: Summary(run) for name, run in by_row.items()}
    _measure_baseline(programs, results, [job for job, row in jobs.items() if row.mesh])
    _measure_times(programs, results)
    results.tracker_bytes = programs.tracker_bytes("Edge")
    _check_goals(results)
    return results


def _measure_times(programs, results):
    """One run at a time, since two on one processor disturb each other, and the fastest of several, since other
    programs only ever add to a time."""
    jobs = {
        runs.Job(f"{row.name}, alone {repeat}", row.scene, results.seeds[0]): row.name
        for row in results.rows
        if row.timed
        for repeat in range(TIME_REPEATS)
    }
    repeats = {}
    for job, run in runs.run_all(list(jobs), programs.track, parallel=1).items():
        repeats.setdefault(jobs[job], []).append(run)
    for name, measured in repeats.items():
        fastest = min(measured, key=lambda run: run["median_ms"])
        results.times[name] = Summary({results.seeds[0]: fastest})


def _measure_baseline(programs, results, jobs):
    """Fuses the same images with the same poses by a truncated signed distance function."""
    if not programs.has("tsdf_baseline"):
        return

    def fuse(job):
        mesh = programs.file(job, "-tsdf.ply")
        programs.call("tsdf_baseline", job.address, programs.file(job, ".csv"), mesh)
        return programs.judge(job, mesh, "-tsdf")

    by_row = {}
    for job, run in runs.run_all(jobs, fuse).items():
        by_row.setdefault(job.name, {})[job.seed] = run
    results.baseline = {name: Summary(run) for name, run in by_row.items()}


def _goals_of(results, row):
    """The row's own goals and those that follow from other rows."""
    yield from row.goals
    if row.like in results.summaries:
        plain = results.mean(row.like, "add_auc")
        if plain is not None:
            yield Goal("add_auc", ">=", round(plain - sequences.NEAR, FIGURES["add_auc"].digits))
    if row.name in results.baseline:
        for surface in sequences.SURFACE:
            limit = results.baseline[row.name].mean(surface.figure)
            if limit is not None:
                yield Goal(surface.figure, surface.relation[0], limit)


def _check_goals(results):
    for row in results.rows:
        for goal in _goals_of(results, row):
            results.check(row.name, results.mean(row.name, goal.figure), goal)
    for name, summary in results.times.items():
        for goal in sequences.SPEED:
            results.check(name, summary.mean(goal.figure), goal)
    limit = sequences.MEMORY_LIMIT_BYTES
    met = results.tracker_bytes <= limit
    results.checks.append(("tracker memory, Edge", f"{results.tracker_bytes} bytes", f"≤ {limit}", met))


def _cell(results, row, figure):
    """A value with the goals that it has to meet."""
    value = results.mean(row.name, figure)
    text = FIGURES[figure].show(value)
    goals = [goal for goal in _goals_of(results, row) if goal.figure == figure]
    if not goals:
        return text
    met = all(goal.is_met(value) for goal in goals)
    wanted = ", ".join(goal.show() for goal in goals)
    return f"{text} ({wanted}) {MET}" if met else f"**{text}** ({wanted}) {MISSED}"


def _tracking_table(results):
    head = ["sequence"]
    columns = ["add_auc", "add_s_auc", "e_t", "e_a", "v", "w", "drift_m", "drift_deg"]
    for name in columns:
        figure = FIGURES[name]
        head.append(f"{figure.title} {figure.unit}".strip())
    head[2:2] = ["worst seed"]
    head += ["frames lost", "longest false"]
    lines = []
    for row in results.rows:
        summary = results.summaries[row.name]
        line = [row.name] + [_cell(results, row, name) for name in columns]
        line[2:2] = [FIGURES["add_auc"].show(summary.least("add_auc"))]
        line += [f"{sum(summary.values('lost')):.0f}", FIGURES["false_tracking"].show(summary.greatest("false_tracking"))]
        lines.append(line)
    return pages.table(head, lines)


def _consistency_table(results):
    lines = []
    for row in results.rows:
        summary = results.summaries[row.name]
        line = [row.name]
        for kind in ("pose", "twist"):
            share = f"{kind}_nees"
            spread = f"{FIGURES[share].show(summary.least(share))} to {FIGURES[share].show(summary.greatest(share))}"
            line += [_cell(results, row, share), spread, _cell(results, row, share + "_mean")]
        lines.append(line)
    head = ["sequence", "pose: frames inside %", "seeds from, to", "mean NEES"]
    head += ["twist: frames inside %", "seeds from, to", "mean NEES"]
    return pages.table(head, lines)


def _surface_table(results):
    names = [goal.figure for goal in sequences.SURFACE]
    head = ["surface, seen part"] + [f"{FIGURES[name].title} {FIGURES[name].unit}".strip() for name in names]
    lines = []
    for row in results.rows:
        if not row.mesh:
            continue
        lines.append([row.name] + [_cell(results, row, name) for name in names])
        if row.name in results.baseline:
            baseline = results.baseline[row.name]
            lines.append([f"the same, {TSDF}"] + [FIGURES[name].show(baseline.mean(name)) for name in names])
    return pages.table(head, lines)


def _calibration_table(results):
    names = ["stated_std", "std_error", "error_over_std", "within_1_std", "within_2_std", "within_3_std"]
    head = ["standard deviation, seen part"] + [f"{FIGURES[name].title} {FIGURES[name].unit}".strip() for name in names]
    lines = [[row.name] + [_cell(results, row, name) for name in names] for row in results.rows if row.mesh]
    return pages.table(head, lines)


def _time_table(results):
    lines = []
    for name, summary in results.times.items():
        line = [name]
        for goal in sequences.SPEED:
            value = summary.mean(goal.figure)
            mark = MET if goal.is_met(value) else MISSED
            line.append(f"{FIGURES[goal.figure].show(value)} ({goal.show()}) {mark}")
        lines.append(line)
    return pages.table(["time per frame", "median ms", "99th percentile ms"], lines)


def summary_line(results):
    met = sum(check[3] for check in results.checks)
    return f"{met} of {len(results.checks)} goals met."


def missed_goals(results):
    return [f"{what} {value} ({goal})" for what, value, goal, met in results.checks if not met]


def page(results, plots):
    """What stands between the markers of docs/results.md."""
    seeds = pages.name_seeds(results.seeds)
    fits = results.tracker_bytes <= sequences.MEMORY_LIMIT_BYTES
    parts = [
        f"Means over {seeds}; in parentheses the goal, {MET} met, {MISSED} missed. **{summary_line(results)}** "
        "“Longest false” is the longest stretch of frames that were reported as “tracking” though off by more than "
        "2 cm or 10° (the turn of a can or doughnut about its axis included), in the worst seed. "
        "“Frames lost” counts images that repeat the one before as well; they are predicted, not measured. "
        "All figures, seed by seed: [results.json](results.json).",
        "### Tracking",
        _tracking_table(results),
        "### Consistency",
        "Share of frames whose normalised squared error (NEES) lies between the 2.5 % and 97.5 % bounds of a truthful "
        "covariance, 1.24 and 14.45. A mean NEES above 6 says that the covariance is too small, below 6 too large.",
        _consistency_table(results),
    ]
    if any(row.mesh for row in results.rows):
        parts += ["### Surface"]
        if results.baseline:
            parts += [f"The {TSDF} fuses the same images with the same poses (Open3D, 2 mm voxels)."]
        parts += [
            _surface_table(results),
            "How far the standard deviation that every vertex states is from the vertices' true distances to the model, both "
            "as root mean squares, and how many vertices lie within it. Of a truthful one it would be 68.3, 95.4 and 99.7 %.",
            _calibration_table(results),
        ]
    parts += [
        "### Time and memory",
        f"`Tracker<profiles::Edge>` is {results.tracker_bytes} bytes (≤ {sequences.MEMORY_LIMIT_BYTES}) "
        f"{MET if fits else MISSED}.",
    ]
    if results.times:
        parts += [
            f"Times of one run at a time, the fastest of {TIME_REPEATS}, reading the frame not included:",
            _time_table(results),
        ]
    parts += [f"![{title}]({file})" for file, title in plots]
    return "\n\n".join(part.strip() for part in parts)


def write_json(path, results):
    path.write_text(json.dumps(results.json(), indent=1, ensure_ascii=False) + "\n", encoding="utf-8")
