# SPDX-License-Identifier: BSD-3-Clause
"""/metrics of a run, read by the parser of Prometheus' own client library: metrics_test.py DISFLOW_TRACK"""
import os
import re
import subprocess
import sys
import time
import unittest
import urllib.error
import urllib.request

try:
    from prometheus_client.parser import text_string_to_metric_families
except ImportError:
    print('skipped: python3-prometheus-client is missing')
    sys.exit(77)

PROGRAM = sys.argv.pop(1)
TOKEN = 'a-token-for-the-test'
PATIENCE_S = 60


class Metrics(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        environment = {**os.environ, 'DISFLOW_VIEW_TOKEN': TOKEN}
        cls.program = subprocess.Popen(
            [PROGRAM, '--sensor', 'sim:box+bottle?frames=100000&width=160&height=90', '--rate', 'realtime', '--headless', '--view', ':0',
             '--object', 'name=box,label=1', '--object', 'name=bottle,label=2'],
            stderr=subprocess.PIPE, text=True, env=environment)
        for line in cls.program.stderr:
            found = re.search(r'live view: (http://[^?]*/)', line)
            if found:
                cls.url = found.group(1) + 'metrics'
                return
        raise AssertionError('disflow_track ended')

    @classmethod
    def tearDownClass(cls):
        cls.program.terminate()
        cls.program.communicate(timeout=PATIENCE_S)

    def scrape(self):
        request = urllib.request.Request(self.url, headers={'Authorization': f'Bearer {TOKEN}'})
        with urllib.request.urlopen(request, timeout=PATIENCE_S) as answer:
            self.assertTrue(answer.headers['Content-Type'].startswith('text/plain; version=0.0.4'))
            return {family.name: family for family in text_string_to_metric_families(answer.read().decode())}

    def until(self, condition):
        end = time.monotonic() + PATIENCE_S
        while time.monotonic() < end:
            families = self.scrape()
            if condition(families):
                return families
            time.sleep(0.1)
        raise AssertionError('it never came to that')

    @staticmethod
    def values(family, **labels):
        return [s.value for s in family.samples if all(s.labels.get(k) == v for k, v in labels.items())]

    def test_counters_of_both_objects_rise(self):
        def frames(families):
            return [self.values(families['disflow_frames'], object=name) for name in ('box', 'bottle')]

        first = frames(self.until(lambda families: all(frames(families))))
        later = frames(self.until(lambda families: all(b[0] > a[0] + 5 for a, b in zip(first, frames(families)))))
        self.assertTrue(all(len(values) == 1 for values in later))

    def test_every_family_says_what_it_is(self):
        families = self.until(lambda families: families['disflow_quality'].samples)
        for name, family in families.items():
            self.assertTrue(name.startswith('disflow_'), name)
            self.assertIn(family.type, ('counter', 'gauge', 'histogram'), name)
            self.assertTrue(family.documentation, name)
            self.assertTrue(family.samples, name)
        self.assertGreater(len(families), 25)

    def test_an_object_is_in_one_state(self):
        families = self.until(lambda families: self.values(families['disflow_state'], object='box', state='tracking') == [1])
        self.assertEqual(sum(self.values(families['disflow_state'], object='box')), 1)
        self.assertGreater(self.values(families['disflow_quality'], object='box')[0], 50)

    def test_histogram_adds_up(self):
        family = self.until(lambda families: self.values(families['disflow_frames'], object='box') > [10])['disflow_frame_seconds']
        self.assertEqual(family.type, 'histogram')
        mine = [s for s in family.samples if s.labels['object'] == 'box']
        buckets = [s.value for s in mine if s.name.endswith('_bucket')]
        count = next(s.value for s in mine if s.name.endswith('_count'))
        total_s = next(s.value for s in mine if s.name.endswith('_sum'))
        self.assertEqual(buckets, sorted(buckets))
        self.assertEqual(buckets[-1], count)
        self.assertGreater(total_s, 0)

    def test_without_the_token_nothing_is_told(self):
        with self.assertRaises(urllib.error.HTTPError) as refused:
            urllib.request.urlopen(self.url, timeout=PATIENCE_S)
        self.assertEqual(refused.exception.code, 401)


if __name__ == '__main__':
    unittest.main()
