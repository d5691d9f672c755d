#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Counts the deviations that docs/safety.md lists, and fails if it says other numbers: deviations.py BUILD [SOURCE.cc...]

BUILD holds a compile_commands.json that clang-tidy understands, as `./dev lint` leaves it. Each place counts once per check,
however often it is compiled; those in headers of core and hal count, others' do not.
"""
import collections
import concurrent.futures
import os
import pathlib
import re
import subprocess
import sys

_ROOT = pathlib.Path(__file__).resolve().parents[3]
_PAGE = _ROOT / "docs" / "safety.md"
_ROW = re.compile(r"^\| (D-[0-9]+) \| [^|]* \| `([a-z-]+)` \| ([0-9]+) \|", re.MULTILINE)
_FINDING = re.compile(r"^(/[^:\n]+:[0-9]+:[0-9]+): (?:warning|error): .* \[([^\]]+)\]$", re.MULTILINE)


def documented(page):
    """Findings by check."""
    return {check: int(count) for _, check, count in _ROW.findall(page)}


def counted(output, checks, root):
    """Findings by check in what clang-tidy says of many files."""
    places = collections.defaultdict(set)
    for place, names in _FINDING.findall(output):
        if os.path.normpath(place).startswith((f"{root}/core/", f"{root}/hal/")):
            for check in checks & set(names.split(",")):
                places[check].add(os.path.normpath(place))
    return {check: len(places[check]) for check in checks}


def sources():
    """Of core and hal, as the repository has them."""
    listing = subprocess.run(["git", "ls-files", "core/*.cc", "hal/*.cc"], cwd=_ROOT, check=True, capture_output=True, text=True)
    return listing.stdout.split()


def tidy(build, checks, source):
    command = ["clang-tidy", "--quiet", "-p", build, f"--checks=-*,{','.join(sorted(checks))}", "--warnings-as-errors=-*",
               "--header-filter=/(core|hal)/", str(_ROOT / source)]
    run = subprocess.run(command, check=False, capture_output=True, text=True)
    if "[clang-diagnostic-error]" in run.stdout or run.returncode != 0:
        raise SystemExit(f"clang-tidy cannot read {source}:\n{run.stdout[-2000:]}{run.stderr[-500:]}")
    return run.stdout


def main():
    build, *chosen = sys.argv[1:]
    expected = documented(_PAGE.read_text(encoding="utf-8"))
    checks = set(expected)
    with concurrent.futures.ThreadPoolExecutor(len(os.sched_getaffinity(0))) as pool:
        output = "".join(pool.map(lambda source: tidy(build, checks, source), chosen or sources()))
    found = counted(output, checks, _ROOT)
    for check, count in expected.items():
        print(f"{found[check]:5} {check}" + ("" if found[check] == count else f": docs/safety.md says {count}"))
    return 0 if found == expected else 1


if __name__ == "__main__":
    sys.exit(main())
