# SPDX-License-Identifier: BSD-3-Clause
"""/metrics of a run, judged by Prometheus' own promtool, its lints included: promtool_test.py DISFLOW_TRACK"""
import shutil
import subprocess
import sys
import unittest

from metrics_run import PATIENCE_S, MetricsTest, until

PROGRAM = sys.argv.pop(1)
PROMTOOL = shutil.which('promtool')
if PROMTOOL is None:
    print('skipped: promtool is missing (apt-get install prometheus, 330 MB with a service)')
    sys.exit(77)


def faults(text):
    """What promtool says, which is nothing if it finds none."""
    judged = subprocess.run([PROMTOOL, 'check', 'metrics'], input=text, capture_output=True, text=True, timeout=PATIENCE_S, check=False)
    said = judged.stdout + judged.stderr
    return f'{said}exit status {judged.returncode}' if said or judged.returncode != 0 else ''


class Promtool(MetricsTest):
    program = PROGRAM

    def text(self):
        return self.run_of_two.scrape()[0]

    def text_of_results(self):
        return until(self.text, lambda text: 'disflow_quality{object="bottle"}' in text)

    def test_finds_no_fault_at_the_start_of_a_run(self):
        self.assertEqual(faults(self.text()), '')

    def test_finds_no_fault_in_results_of_both_objects(self):
        self.assertEqual(faults(self.text_of_results()), '')

    def test_would_find_one(self):
        text = self.text_of_results()
        self.assertIn('counter metrics should have "_total" suffix', faults(text.replace('disflow_frames_total', 'disflow_frames')))
        self.assertIn('no help text', faults(text.replace('# HELP disflow_quality ', '# ')))
        self.assertIn('error while linting', faults(text + 'disflow_quality{object="box" 1\n'))


if __name__ == '__main__':
    unittest.main()
