# SPDX-License-Identifier: BSD-3-Clause
"""/metrics of a run, read by the parser of Prometheus' own client library: metrics_test.py DISFLOW_TRACK"""
import sys
import unittest
import urllib.error
import urllib.request

from metrics_run import PATIENCE_S, MetricsTest, until

try:
    from prometheus_client.parser import text_string_to_metric_families
except ImportError:
    print('skipped: python3-prometheus-client is missing')
    sys.exit(77)

PROGRAM = sys.argv.pop(1)


class Metrics(MetricsTest):
    program = PROGRAM

    def scrape(self):
        text, content_type = self.run_of_two.scrape()
        self.assertTrue(content_type.startswith('text/plain; version=0.0.4'))
        return {family.name: family for family in text_string_to_metric_families(text)}

    def until(self, condition):
        return until(self.scrape, condition)

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
            urllib.request.urlopen(self.run_of_two.url, timeout=PATIENCE_S)
        self.assertEqual(refused.exception.code, 401)


if __name__ == '__main__':
    unittest.main()
