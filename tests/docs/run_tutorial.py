#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Runs a tutorial as a reader does: every ```sh block of the page, in order, in one shell that starts in the tree's root.

usage: run_tutorial.py PAGE.md

The first command that fails ends it, and is named with its line on the page. `console` blocks show what needs another machine
and are not run.
"""

import contextlib
import os
import pathlib
import re
import signal
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
PATIENCE_S = 1200  # The first build included.


def blocks(page):
    """(first line's number on the page, text) of every ```sh block."""
    found = []
    inside = None
    for number, line in enumerate(page.read_text(encoding="utf-8").splitlines(), 1):
        if inside is None and line == "```sh":
            inside = (number + 1, [])
        elif inside is not None and line == "```":
            found.append((inside[0], "\n".join(inside[1])))
            inside = None
        elif inside is not None:
            inside[1].append(line)
    if inside is not None:
        sys.exit(f"{page}: the block that begins in line {inside[0]} has no end")
    return found


def script(page):
    """The blocks as one script that says what it runs and where it failed."""
    lines = ["set -euo pipefail", "block=0", f"trap 's=$?; [ $s = 0 ] || echo \"{page.name}: failed in the block of line $block\" >&2' EXIT"]
    for number, text in blocks(page):
        shown = re.sub(r"<<'CODE'.*?\nCODE", "<<'CODE' ...", text, flags=re.DOTALL)
        lines += [f"block={number}", "cat <<'SHOWN'"] + [f"$ {line}" for line in shown.splitlines()] + ["SHOWN", text]
    return "\n".join(lines) + "\n"


def main():
    page = pathlib.Path(sys.argv[1])
    if not blocks(page):
        sys.exit(f"{page}: no command to run")
    shell = subprocess.Popen(["bash", "-c", script(page)], cwd=ROOT, stdin=subprocess.DEVNULL, start_new_session=True)
    try:
        sys.exit(shell.wait(PATIENCE_S))
    finally:
        # What a command that failed has left in the background.
        with contextlib.suppress(ProcessLookupError):
            os.killpg(shell.pid, signal.SIGKILL)


main()
