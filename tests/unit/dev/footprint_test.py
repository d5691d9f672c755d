# SPDX-License-Identifier: BSD-3-Clause
"""The sizes that the pages name are those of the library: footprint_test.py DISFLOW_FOOTPRINT"""

import pathlib
import re
import subprocess
import sys
import unittest

DOCS = pathlib.Path(__file__).resolve().parents[3] / "docs"
PROGRAM = sys.argv.pop()


class Footprint(unittest.TestCase):
    def setUp(self):
        self.printed = subprocess.run([PROGRAM], check=True, capture_output=True, text=True).stdout
        tracker = next(line for line in self.printed.splitlines() if "**Tracker" in line)
        self.trackers = [int(size) for size in re.findall(r"\b\d+\b", tracker)]

    def test_the_page_on_memory_has_every_line_that_the_program_prints(self):
        page = (DOCS / "memory.md").read_text(encoding="utf-8")
        lines = [line for line in self.printed.splitlines() if line.startswith("|")]
        self.assertGreater(len(lines), 10)
        self.assertEqual([line for line in lines if line not in page], [])

    def test_several_objects_are_as_many_trackers(self):
        page = (DOCS / "several-objects.md").read_text(encoding="utf-8")
        self.assertEqual(len(self.trackers), 3)
        for objects in (1, 2, 4):
            sizes = " | ".join(f"{objects * size:,}".replace(",", " ") for size in self.trackers)
            self.assertIn(f"| {objects} | {sizes} |", page)


if __name__ == "__main__":
    unittest.main()
