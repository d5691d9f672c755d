# SPDX-License-Identifier: BSD-3-Clause
"""A run of two objects whose /metrics is judged."""
import os
import re
import subprocess
import time
import unittest
import urllib.request

PATIENCE_S = 60
_TOKEN = 'a-token-for-the-test'


class MetricsRun:
    def __init__(self, program):
        environment = {**os.environ, 'DISFLOW_VIEW_TOKEN': _TOKEN}
        self._program = subprocess.Popen(
            [program, '--sensor', 'sim:box+bottle?frames=100000&width=160&height=90', '--rate', 'realtime', '--headless', '--view', ':0',
             '--object', 'name=box,label=1', '--object', 'name=bottle,label=2'],
            stderr=subprocess.PIPE, text=True, env=environment)
        for line in self._program.stderr:
            found = re.search(r'live view: (http://[^?]*/)', line)
            if found:
                self.url = found.group(1) + 'metrics'
                return
        raise AssertionError('disflow_track ended')

    def end(self):
        self._program.terminate()
        self._program.communicate(timeout=PATIENCE_S)

    def scrape(self):
        """The text, and its type."""
        request = urllib.request.Request(self.url, headers={'Authorization': f'Bearer {_TOKEN}'})
        with urllib.request.urlopen(request, timeout=PATIENCE_S) as answer:
            return answer.read().decode(), answer.headers['Content-Type']


def until(look, condition):
    """What is seen once the condition holds for it."""
    end = time.monotonic() + PATIENCE_S
    while time.monotonic() < end:
        seen = look()
        if condition(seen):
            return seen
        time.sleep(0.1)
    raise AssertionError('it never came to that')


class MetricsTest(unittest.TestCase):
    """All tests of a class look at one run of its `program`."""

    program = None

    @classmethod
    def setUpClass(cls):
        cls.run_of_two = MetricsRun(cls.program)

    @classmethod
    def tearDownClass(cls):
        cls.run_of_two.end()
