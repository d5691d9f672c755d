#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Runs docs/examples/track.c in the emulator and compares what it prints with the host's: MACHINE IMAGE HOST_PROGRAM"""
import re
import subprocess
import sys

import emulated

TOLERANCE = 2e-4  # m and quaternion's parts; sums are taken in another order
TRIANGLES = 0.01  # share by which their number may differ


def run(command):
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, timeout=500)
    if done.returncode != 0:
        sys.exit(f'{command[0]}: ended with {done.returncode}\n{done.stdout}')
    return [line.split() for line in done.stdout.splitlines() if re.match(r'\d+ \d|surface: ok', line)]


machine, image, host_program = sys.argv[1:4]
board = run(emulated.command(machine, image))
host = run([host_program])
if len(board) != len(host) or len(host) < 31:
    sys.exit(f'{len(board)} lines on the board, {len(host)} on the host')
farthest = 0.0
for ours, theirs in zip(board[:-1], host[:-1]):
    if ours[:2] != theirs[:2]:
        sys.exit(f'frame and status differ: {ours[:2]} and {theirs[:2]}')
    farthest = max([farthest] + [abs(float(a) - float(b)) for a, b in zip(ours[2:], theirs[2:])])
triangles = [int(lines[-1][2]) for lines in (board, host)]
print(f'{len(host) - 1} frames, farthest apart {farthest:.1g}; triangles {triangles[0]} and {triangles[1]}')
sys.exit(0 if farthest < TOLERANCE and abs(triangles[0] - triangles[1]) < TRIANGLES * triangles[1] else 1)
