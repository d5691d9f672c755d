# SPDX-License-Identifier: BSD-3-Clause
"""Runs the project's programs: track a simulated sequence, judge the trajectory."""

import concurrent.futures
import contextlib
import dataclasses
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import threading

import figures


def _as_file_name(text):
    return re.sub(r"[^a-z0-9]+", "-", text.lower()).strip("-")


@dataclasses.dataclass(frozen=True)
class Job:
    """One sequence to track."""

    name: str  # Of the row or variant.
    scene: str
    seed: int
    settings: tuple = ()  # "name=value"
    mesh: bool = False

    @property
    def address(self):
        return f"sim:{self.scene}&seed={self.seed}"

    @property
    def stem(self):
        """A file name of its own."""
        return _as_file_name(f"{self.name}-{self.scene}-{self.seed}")

    @property
    def frames(self):
        """A name for its frames, which all variants of the settings share."""
        return _as_file_name(f"{self.scene}-{self.seed}")


class Programs:
    """The programs of one build and a folder for what they write."""

    def __init__(self, bin_dir, out_dir, resume=False, frames_dir=None):
        """@param resume Keep reports that are younger than the programs.
        @param frames_dir Keep the frames of every sequence here and take them from here."""
        self.bin_dir = pathlib.Path(bin_dir)
        self.resume = resume
        self.frames_dir = pathlib.Path(frames_dir) if frames_dir else None
        self.out_dir = pathlib.Path(out_dir)
        (self.out_dir / "runs").mkdir(parents=True, exist_ok=True)

    def file(self, job, ending):
        return self.out_dir / "runs" / (job.stem + ending)

    def has(self, program):
        return (self.bin_dir / program).exists()

    def call(self, program, *words, may_fail_with=(), stream="stdout"):
        """What a program says on one stream. A failure that is not expected ends the suite with its message."""
        done = subprocess.run(
            [self.bin_dir / program, *map(str, words)], capture_output=True, text=True, check=False
        )
        if done.returncode not in (0, *may_fail_with):
            raise RuntimeError(f"{program} ended with {done.returncode}: {done.stderr.strip()}")
        return None if done.returncode else getattr(done, stream)

    def _measured_before(self, report):
        """Figures of a run that ended before this one of the suite began; None without it."""
        programs = (self.bin_dir / name for name in ("disflow_track", "disflow_eval"))
        if not report.exists() or report.stat().st_mtime < max(program.stat().st_mtime for program in programs):
            return None
        try:
            return figures.read_all(json.loads(report.read_text(encoding="utf-8")))
        except json.JSONDecodeError:  # Broken off while it was written.
            return None

    @contextlib.contextmanager
    def _frames(self, job):
        """Where the frames of a sequence come from. A stereo camera takes a minute to be simulated, and a second to be
        tracked: frames that are kept give the same trajectory."""
        kept = self.frames_dir and self.frames_dir / job.frames
        if not kept:
            yield ("--sensor", job.address)
        elif kept.exists():
            yield ("--sensor", f"replay:{kept}")
        else:
            part = kept.with_name(f"{kept.name}.{os.getpid()}-{threading.get_ident()}.part")
            shutil.rmtree(part, ignore_errors=True)
            part.parent.mkdir(parents=True, exist_ok=True)
            yield ("--sensor", job.address, "--record", part)
            with contextlib.suppress(OSError):  # Another variant was quicker with the same sequence.
                part.rename(kept)
            shutil.rmtree(part, ignore_errors=True)

    def track(self, job):
        """Figures of a run; the trajectory, errors and mesh stay in the folder."""
        before = self._measured_before(self.file(job, ".json")) if self.resume else None
        if before:
            return before
        words = ["--csv", self.file(job, ".csv"), "--headless"]
        for setting in job.settings:
            words += ["--set", setting]
        if job.mesh:
            words += ["--mesh", self.file(job, ".ply")]
        # 3: not one frame could be tracked. That is a result, not an accident.
        with self._frames(job) as source:
            tracked = self.call("disflow_track", *source, *words, may_fail_with=(3,)) is not None
        if not tracked:
            return dict(figures.FAILED)
        return self.judge(job, self.file(job, ".ply") if job.mesh else None)

    def judge(self, job, mesh=None, ending=""):
        report = self.file(job, ending + ".json")
        words = [job.address, "--csv", self.file(job, ".csv"), "--json", report]
        words += ["--mesh", mesh] if mesh else ["--frames", self.file(job, ".frames.csv")]
        self.call("disflow_eval", *words)
        return figures.read_all(json.loads(report.read_text(encoding="utf-8")))

    def tracker_bytes(self, profile):
        """sizeof(Tracker<profile>), as disflow_footprint prints it."""
        lines = self.call("disflow_footprint").splitlines()
        columns = [cell.strip() for cell in lines[0].split("|")]
        for line in lines:
            if "Tracker" in line:
                return int(line.split("|")[columns.index(profile)])
        raise RuntimeError("disflow_footprint prints no row 'Tracker'")


def _show_progress(done, total):
    if sys.stderr.isatty():
        print(f"\r{done} of {total} runs", end="\n" if done == total else "", file=sys.stderr, flush=True)


def run_all(jobs, work, parallel=None):
    """Calls work(job) for all jobs, some at a time. @return job -> result, in the order of the jobs."""
    results = {}
    with concurrent.futures.ThreadPoolExecutor(parallel or os.cpu_count()) as pool:
        futures = {pool.submit(work, job): job for job in jobs}
        try:
            for future in concurrent.futures.as_completed(futures):
                results[futures[future]] = future.result()
                _show_progress(len(results), len(jobs))
        finally:
            pool.shutdown(cancel_futures=True)
    return {job: results[job] for job in jobs}
