# SPDX-License-Identifier: BSD-3-Clause
"""deviations.py counts what docs/safety.md lists; ./dev lint compares them, which takes minutes."""
import pathlib
import unittest

import deviations

_PAGE = (pathlib.Path(__file__).resolve().parents[3] / "docs" / "safety.md").read_text(encoding="utf-8")
_OUTPUT = """\
/src/core/a.cc:3:5: warning: do not [check-a]
/src/core/src/../include/h.h:9:1: warning: do not [check-a,check-b]
/src/core/include/h.h:9:1: warning: do not [check-b]
/src/core/include/h.h:9:2: warning: do not [check-a]
  int x;
/src/platform/p.cc:1:1: warning: do not [check-a]
/usr/include/core/u.h:1:1: warning: do not [check-a]
/src/hal/h.cc:1:1: error: do not [check-a]
/src/hal/h.cc:1:2: note: here [check-a]
"""


class Deviations(unittest.TestCase):
    def test_every_deviation_of_the_page_is_counted(self):
        rows = [line for line in _PAGE.splitlines() if line.startswith("| D-")]
        self.assertTrue(rows)
        self.assertEqual(len(deviations.documented(_PAGE)), len(rows))

    def test_a_place_counts_once_per_check_and_others_code_not_at_all(self):
        self.assertEqual(deviations.counted(_OUTPUT, {"check-a", "check-b", "check-c"}, "/src"),
                         {"check-a": 4, "check-b": 1, "check-c": 0})

    def test_sources_are_those_of_core_and_hal(self):
        sources = deviations.sources()
        self.assertGreater(len(sources), 40)
        self.assertTrue(all(source.startswith(("core/", "hal/")) for source in sources))


if __name__ == "__main__":
    unittest.main()
