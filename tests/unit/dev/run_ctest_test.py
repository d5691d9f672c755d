# SPDX-License-Identifier: BSD-3-Clause
"""What tests/run_ctest.py makes of CTest's reports."""
import contextlib
import io
import os
import pathlib
import sys
import tempfile
import unittest
from unittest import mock

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2]))

import run_ctest
from run_ctest import Round, Skip

_REPORT = """<?xml version="1.0" encoding="UTF-8"?>
<testsuite name="x" tests="5">
<testcase name="Good.One" classname="Good.One" time="0.1" status="run"><system-out>ok</system-out></testcase>
<testcase name="Bad.One" classname="Bad.One" time="0.1" status="fail"><failure message=""/><system-out/></testcase>
<testcase name="Wire.Udp" status="notrun"><skipped message="SKIP_RETURN_CODE=77"/>
<system-out>skipped: socat is not installed (apt-get install socat)
</system-out></testcase>
<testcase name="Data.Bottle" status="notrun"><skipped message="SKIP_REGULAR_EXPRESSION_MATCHED"/>
<system-out>[ RUN      ] Data.Bottle
/somewhere/bottle_test.cc:7: Skipped
no recordings: set DISFLOW_TEST_DATA ("/data/bottle" is not there)

[  SKIPPED ] Data.Bottle (0 ms)
</system-out></testcase>
<testcase name="Symbols" status="disabled"><skipped message="Disabled"/></testcase>
<testcase name="Lost" status="notrun"><failure message="Unable to find executable"/></testcase>
</testsuite>
"""


def read(text):
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "report.xml")
        pathlib.Path(path).write_text(text, encoding="utf-8")
        return run_ctest.read_round(path)


def judge(rounds, on_ci):
    output = io.StringIO()
    environment = {"CI": "1"} if on_ci else {}
    with mock.patch.dict(os.environ, environment, clear=True), contextlib.redirect_stdout(output):
        return run_ctest.judge(rounds), output.getvalue()


class Report(unittest.TestCase):
    def test_failed_and_never_started_tests_are_failures(self):
        self.assertEqual(read(_REPORT).failed, ["Bad.One", "Lost"])

    def test_skipped_tests_have_the_reason_that_they_printed(self):
        reasons = {skip.test: skip.reason for skip in read(_REPORT).skipped}
        self.assertEqual(reasons["Wire.Udp"], "socat is not installed (apt-get install socat)")
        self.assertIn("DISFLOW_TEST_DATA", reasons["Data.Bottle"])
        self.assertEqual(reasons["Symbols"], "disabled in this build")
        self.assertEqual(len(reasons), 3)

    def test_same_need_is_counted_together_whatever_the_detail(self):
        skipped = [Skip("a", "no recordings (/x)"), Skip("b", "no recordings (/y)"), Skip("c", "no socat")]
        self.assertEqual(run_ctest.summary_of_skips(skipped),
                         "3 skipped:\n     2 no recordings\n     1 no socat")
        self.assertEqual(run_ctest.summary_of_skips([]), "none skipped")


class Parallel(unittest.TestCase):
    def jobs(self, **environment):
        with mock.patch.dict(os.environ, environment, clear=True), mock.patch("subprocess.run") as run:
            run.return_value.returncode = 0
            run_ctest.run_once("build/x", [], None)
        command = run.call_args[0][0]
        return command[command.index("--parallel") + 1]

    def test_as_many_as_processors_unless_ctests_own_variable_says_how_many(self):
        self.assertEqual(self.jobs(), str(os.cpu_count()))
        self.assertEqual(self.jobs(CTEST_PARALLEL_LEVEL="17"), "17")


class Judgement(unittest.TestCase):
    def test_one_failure_in_one_round_fails_and_is_named(self):
        status, text = judge([Round([], [], 3), Round(["Some.Test"], [], 3)], on_ci=False)
        self.assertEqual(status, 1)
        self.assertIn("1 of 2 Some.Test", text)
        self.assertIn("1 of 2 rounds passed", text)

    def test_skip_is_a_failure_on_ci_only_and_not_for_recordings(self):
        wire = Round([], [Skip("Wire.Udp", "socat is not installed")], 3)
        recordings = Round([], [Skip("Data.Bottle", "no recordings: set DISFLOW_TEST_DATA")], 3)
        self.assertEqual(judge([wire], on_ci=False)[0], 0)
        self.assertEqual(judge([wire], on_ci=True)[0], 1)
        self.assertEqual(judge([recordings], on_ci=True)[0], 0)


if __name__ == "__main__":
    unittest.main()
