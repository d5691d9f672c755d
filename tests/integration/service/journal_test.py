#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""The log as systemd's own journal keeps it: systemd-journald in a /run of its own. Usage: journal_test.py DISFLOW_TRACK

Wants root, systemd-journald and journalctl; the form of every entry is tested without them in track_threads_test.
"""
import json
import os
import shutil
import subprocess
import sys
import tempfile
import unittest

_PROGRAM = sys.argv.pop() if len(sys.argv) > 1 else ""
_JOURNALD = "/lib/systemd/systemd-journald"
# The journal names its folder by the machine; a machine without a name gets one here.
_SCRIPT = """
set -e
mount -t tmpfs run /run
mkdir -p /run/systemd/journal /run/log/journal
if [ ! -s /etc/machine-id ]; then
  echo 0123456789abcdef0123456789abcdef >/run/machine-id
  mount --bind /run/machine-id /etc/machine-id
fi
"$1" >/dev/null 2>&1 &
journald=$!
while [ ! -S /run/systemd/journal/socket ]; do kill -0 $journald; sleep 0.05; done
# Not as a live camera, of which a busy machine drops images: all 40 are to be in the report.
"$2" --sensor 'sim:box?frames=40&noise=white' --log journald --cpu 1000
# A journal that is told to end reads nothing more of what waits for it, as on a busy machine the last lines of the program do.
tries=200
until journalctl --no-pager -q -D /run/log/journal -t disflow_track | grep -q 'frames dropped' || [ $tries -eq 0 ]; do
  tries=$((tries - 1))
  sleep 0.1
done
kill $journald
wait $journald || true
cp -r /run/log/journal "$3"
"""


def _can_have_a_journal():
    if os.geteuid() != 0 or not os.path.exists(_JOURNALD) or not shutil.which("journalctl"):
        return False
    return subprocess.run(["unshare", "--mount", "mount", "-t", "tmpfs", "run", "/run"], capture_output=True, check=False).returncode == 0


@unittest.skipUnless(_can_have_a_journal(), "no root, or no systemd-journald here")
class Journal(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls._folder = tempfile.TemporaryDirectory()
        done = subprocess.run(["unshare", "--mount", "sh", "-c", _SCRIPT, "sh", _JOURNALD, _PROGRAM, cls._folder.name],
                              capture_output=True, text=True, timeout=120, check=False)
        if done.returncode != 0:
            raise AssertionError(done.stdout + done.stderr)
        cls._said = done.stderr

    @classmethod
    def tearDownClass(cls):
        cls._folder.cleanup()

    def entries(self, *matches):
        found = subprocess.run(["journalctl", "--no-pager", "-D", os.path.join(self._folder.name, "journal"), "-o", "json", *matches],
                               capture_output=True, text=True, check=True)
        return [json.loads(line) for line in found.stdout.splitlines()]

    def test_states_are_found_by_their_fields(self):
        entries = self.entries("DISFLOW_STATE=tracking", "DISFLOW_OBJECT=object")
        self.assertEqual(len(entries), 1)
        self.assertEqual(entries[0]["_TRANSPORT"], "journal")
        self.assertEqual(entries[0]["SYSLOG_IDENTIFIER"], "disflow_track")
        self.assertEqual(entries[0]["DISFLOW_STATE_BEFORE"], "initialising")
        self.assertEqual(self.entries("MESSAGE_ID=" + entries[0]["MESSAGE_ID"]), entries)

    def test_what_is_not_as_wanted_is_a_warning_and_nothing_is_said_elsewhere(self):
        warnings = self.entries("-t", "disflow_track", "-p", "warning")
        self.assertEqual([entry["MESSAGE"].partition(":")[0] for entry in warnings], ["tracking thread"])
        self.assertTrue(any("40 frames" in entry["MESSAGE"] for entry in self.entries("-t", "disflow_track")))
        self.assertEqual(self._said, "")


if __name__ == "__main__":
    unittest.main()
