#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Runs disflow_track for many simulated minutes and watches its memory and descriptors: ./dev test --soak.

Exit status: 0 nothing grew and nothing was found, 1 something did.
"""
import argparse
import os
import subprocess
import sys
import tempfile
import time

_FPS = 30


def status_of(pid):
    """Resident kilobytes and open descriptors of a process; None when it has ended."""
    try:
        with open(f"/proc/{pid}/status", encoding="ascii") as file:
            fields = dict(line.split(":", 1) for line in file if ":" in line)
        if "VmRSS" not in fields:
            return None
        return int(fields["VmRSS"].split()[0]), len(os.listdir(f"/proc/{pid}/fd"))
    except (FileNotFoundError, ProcessLookupError):
        return None


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--program", default="build/release/bin/disflow_track")
    parser.add_argument("--minutes", type=float, default=30, help="of simulated stream")
    parser.add_argument("--speed", type=float, default=4, help="times real time at most")
    parser.add_argument("--valgrind", action="store_true")
    arguments = parser.parse_args()
    frames = int(arguments.minutes * 60 * _FPS)
    with tempfile.TemporaryDirectory() as folder:
        # Small images: the loops, counters and buffers are the same, and a sanitizer keeps pace. The stamps of the stream
        # run faster than its name says, so that it is live and at several times real time.
        image = "width=160&height=90" if arguments.valgrind else "width=320&height=180&noise=white"
        sensor = f"sim:bottle?{image}&frames={frames}&fps={_FPS * arguments.speed:g}&motion=moderate&drop=0.01"
        command = [arguments.program, "--sensor", sensor, "--rate", "live", "--headless", "--link",
                   "udp://127.0.0.1:9", "--csv", f"{folder}/run.csv"]
        if arguments.valgrind:
            command = ["valgrind", "--error-exitcode=99", "--leak-check=full", "--errors-for-leak-kinds=definite",
                       "--track-fds=no", "-q"] + command
        with open(f"{folder}/log", "w+", encoding="utf-8") as log:
            start = time.monotonic()
            process = subprocess.Popen(command, stderr=log, stdout=log)
            samples = []
            while process.poll() is None:
                sample = status_of(process.pid)
                if sample:
                    samples.append(sample)
                time.sleep(0.2)
            seconds = time.monotonic() - start
            log.seek(0)
            text = log.read()
        rows = sum(1 for _ in open(f"{folder}/run.csv", encoding="ascii")) - 1
    print(text.rstrip())
    # The first fifth is the start: pages that are touched for the first time. Valgrind opens files to write its report.
    steady = samples[len(samples) // 5:-60 if arguments.valgrind else -1]
    if process.returncode != 0 or len(steady) < 5:
        print(f"soak: ended with {process.returncode} after {seconds:.0f} s", file=sys.stderr)
        return 1
    grown_kb = max(s[0] for s in steady[len(steady) // 2:]) - max(s[0] for s in steady[:len(steady) // 2])
    descriptors = sorted({s[1] for s in steady})
    print(f"soak: {frames / _FPS / 60:.1f} simulated minutes in {seconds:.0f} s, {rows} frames tracked, "
          f"{steady[-1][0]} kB resident, grown by {grown_kb} kB, descriptors {descriptors}")
    # A page or two of the C library's own is no leak; one allocation per frame would be.
    if grown_kb > 256 or len(descriptors) > 1 or rows < 100:
        print("soak: memory or descriptors grew, or too little was tracked", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
