# SPDX-License-Identifier: BSD-3-Clause
"""Lost and found again: the camera sees nothing for seconds, while the object moves on in fast motion."""

import csv
import dataclasses

import pages
import runs

SHAPES = ("box", "rounded-box", "flat-box", "bottle", "spray-bottle", "bracket", "mug")
MASKS = {"given": "gt", "none": "none"}
NOISES = ("d415", "kinect", "tof")
BLANKS_S = (1, 2, 4)
BLANK_AT_S = 3
FPS = 30
WATCHED = 60  # Images after the blank time.
PROMPT = 16
RIGHT_M = 0.01  # ADD-S: of things that look alike any pose at which they do is right.


@dataclasses.dataclass(frozen=True)
class Case:
    """One blank time of a sequence."""

    shape: str
    mask: str
    noise: str
    blank_s: int
    seed: int

    @property
    def back(self):
        """The first image that shows something again."""
        return (BLANK_AT_S + self.blank_s) * FPS

    @property
    def job(self):
        options = f"motion=fast&noise={self.noise}&mask={MASKS[self.mask]}&frames={self.back + WATCHED}"
        blank = f"blank_at_s={BLANK_AT_S}&blank_s={self.blank_s}"
        return runs.Job("again", f"{self.shape}?{options}&{blank}", self.seed)


@dataclasses.dataclass(frozen=True)
class Outcome:
    """What became of a case: found, wrong, anew (started as another object), never, or lost before the blank time."""

    kind: str
    after: int = 0  # Images from the end of the blank time on, if found or wrong.


def cases(seeds):
    return [Case(shape, mask, noise, blank_s, seed) for mask in MASKS for noise in NOISES for shape in SHAPES
            for blank_s in BLANKS_S for seed in seeds]


def read_table(path):
    with open(path, encoding="utf-8", newline="") as file:
        return {int(row["frame"]): row for row in csv.DictReader(file)}


def outcome(case, frames, errors):
    """@param frames What disflow_track wrote, by frame. @param errors What disflow_eval wrote of each."""
    before = frames.get(BLANK_AT_S * FPS - 1)
    if before is None or before["status"] != "ok":
        return Outcome("before")
    for frame in range(case.back, case.back + WATCHED):
        row = frames.get(frame)
        if row is None or row["status"] != "ok":
            continue
        if row["reset_counter"] != before["reset_counter"]:
            return Outcome("anew")
        right = float(errors[frame]["add_s_m"]) <= RIGHT_M
        return Outcome("found" if right else "wrong", frame - case.back)
    return Outcome("never")


def measure(programs, seeds):
    """Runs everything. @return The outcomes by case."""
    every = {case.job: case for case in cases(seeds)}

    def work(job):
        programs.track(job)
        return outcome(every[job], read_table(programs.file(job, ".csv")), read_table(programs.file(job, ".frames.csv")))

    return {every[job]: result for job, result in runs.run_all(list(every), work).items()}


def page(outcomes, seeds):
    """The table, one line for each kind of mask and noise."""
    lines = []
    for mask in MASKS:
        for noise in NOISES:
            of_line = [result for case, result in outcomes.items() if (case.mask, case.noise) == (mask, noise)]
            kinds = [result.kind for result in of_line]
            promptly = sum(result.kind == "found" and result.after <= PROMPT for result in of_line)
            counts = [len(kinds), kinds.count("before"), promptly] + [kinds.count(kind) for kind in ("found", "wrong", "anew", "never")]
            lines.append([f"{mask}, {noise}"] + [str(count) for count in counts])
    head = ["mask, noise", "cases", "lost before", f"right within {PROMPT} images", f"within {WATCHED}", "wrong", "started anew", "never"]
    return (f"{pages.name_seeds(seeds).capitalize()}; {', '.join(SHAPES)}; blank for {', '.join(map(str, BLANKS_S))} s.\n\n"
            + pages.table(head, lines))
