# SPDX-License-Identifier: BSD-3-Clause
"""What the tests of live cameras share: the guest's shell functions, and replays to compare with."""
import csv
import glob
import io
import json
import os
import shutil
import subprocess
import unittest

import setting
from kernel import Kernel, Unavailable

SCRIPT = """
camera() { rm -f /run/played; hil_usb_camera /frames --played /run/played "$@" & camera=$!; }
plugged() { for i in $(seq 100); do [ -e /dev/video0 ] && return; usleep 50000; done; }
played() { for i in $(seq 600); do [ -e /run/played ] && break; usleep 50000; done; usleep 500000; }
track() {
  name=$1; shift; plugged
  disflow_track --sensor "$@" --csv /out/$name.csv --headless --no-timing 2>/out/$name &
  track=$!; played; kill -INT $track; wait $track; echo "$name status $?"
}
unplug() { kill $camera; wait $camera; for i in $(seq 100); do [ -e /dev/video0 ] || return; usleep 50000; done; }
"""


def rows_of(text):
    return list(csv.DictReader(io.StringIO(text.decode())))


class GuestOutput:
    """What a test reads of the files that its guest left behind: a class's `out`."""
    out = {}

    def text(self, name):
        return self.out[name].decode()

    def rows(self, name):
        """The trajectory of a run that ended well."""
        self.assertIn(f"{name} status 0", self.text("log"), self.text(name))
        return rows_of(self.out[name + ".csv"])


def replay(sequence, name, rows, options=()):
    """Rows of a replay on this machine of what the guest saw: [(row, index of its frame)]."""
    folder = sequence.with_stamps(os.path.join(setting.folder, name),
                                  [(index, row["timestamp"]) for row, index in rows])
    output = os.path.join(folder, "replay.csv")
    subprocess.run([os.path.join(setting.programs, "disflow_track"), "--sensor", "replay:" + folder,
                    "--csv", output, "--headless", "--no-timing", *options], check=True,
                   capture_output=True)
    with open(output, "rb") as file:
        return rows_of(file.read())


def make_kernel(arch):
    try:
        return Kernel(arch, os.path.join(setting.folder, "kernels"))
    except Unavailable as error:
        raise unittest.SkipTest(str(error)) from error


def check_trajectory(test, sequence, name, rows):
    """The counters say which frames the tracker got; a replay of those must give the same bits."""
    frames = [(row, number + int(row["dropped"])) for number, row in enumerate(rows)]
    test.assertLess(frames[-1][1], sequence.frames)
    replayed = replay(sequence, "replay_" + name, frames)
    for row in rows + replayed:
        del row["dropped"]
    test.assertEqual(rows, replayed)


def decode(path):
    """Messages in the bytes that a line carried."""
    folder = os.path.join(os.path.dirname(__file__), "..", "integration", "wire", "node_modules")
    if shutil.which("node") is None or not glob.glob(os.path.join(folder, "node-mavlink")):
        raise unittest.SkipTest("node-mavlink is missing: npm ci --prefix tests/integration/wire")
    script = os.path.join(os.path.dirname(__file__), "decode.js")
    output = subprocess.run(["node", script, path], check=True, capture_output=True, text=True)
    return [json.loads(line) for line in output.stdout.splitlines()]
