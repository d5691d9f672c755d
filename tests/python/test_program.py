# SPDX-License-Identifier: BSD-3-Clause
"""A numpy script gives the program's figures, bit for bit."""
import csv
import json
import os
import pathlib
import subprocess
import tempfile
import unittest

import disflow
import numpy as np

PROGRAMS = pathlib.Path(os.environ['DISFLOW_PROGRAMS'])
FRAMES = 60


def read_float_image(file):
    """The .float files of the Fast-YCB layout: width and height as 64-bit numbers, then metres."""
    data = file.read_bytes()
    width, height = np.frombuffer(data, '<u8', 2)
    return np.frombuffer(data, '<f4', offset=16).reshape(int(height), int(width))


class Program(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        root = pathlib.Path(cls.folder.name)
        cls.sequence = root / 'box'
        subprocess.run([PROGRAMS / 'disflow_sim', '--object', 'box', '--motion', 'fast', '--noise', 'd415', '--seed', '3',
                        '--frames', str(FRAMES), cls.sequence], check=True, stdout=subprocess.DEVNULL)
        subprocess.run([PROGRAMS / 'disflow_track', '--sensor', f'replay:{cls.sequence}?mask=none', '--csv', root / 'track.csv',
                        '--headless'], check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        with open(root / 'track.csv', newline='') as file:
            cls.rows = list(csv.DictReader(file))
        camera = json.loads((cls.sequence / 'cam_K.json').read_text())
        cls.camera = [camera[name] for name in ('fx', 'fy', 'cx', 'cy')]

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def test_poses_twists_and_covariances_are_those_of_the_program(self):
        tracker = disflow.Tracker()
        self.assertEqual(len(self.rows), FRAMES)
        for row in self.rows:
            depth = read_float_image(self.sequence / 'depth' / f"{row['frame']}.float")
            seconds, _, nanoseconds = row['timestamp'].partition('.')
            e = tracker.process(depth, self.camera, int(seconds + nanoseconds))
            ours = {'state': e.state, 'weak': e.weak}
            for name in ('quality', 'samples', 'inliers', 'edge_inliers', 'hypotheses', 'iterations', 'reset_counter',
                         'score', 'rms_m', 'conflict', 'visible', 'weak_std'):
                ours[name] = getattr(e, name)
            ours['noise'] = e.inverse_depth_std_per_m
            ours.update(zip(('x', 'y', 'z'), e.position_m))
            ours.update(zip(('qx', 'qy', 'qz', 'qw'), e.quaternion_xyzw))
            ours.update(zip(('vx', 'vy', 'vz'), e.linear_mps))
            ours.update(zip(('wx', 'wy', 'wz'), e.angular_rps))
            upper = np.triu_indices(6)
            ours.update((f'cov_pose_{i}', value) for i, value in enumerate(e.pose_covariance[upper]))
            ours.update((f'cov_twist_{i}', value) for i, value in enumerate(e.twist_covariance[upper]))
            for name, value in ours.items():
                if isinstance(value, (float, np.floating)):
                    # Nine digits give every float back exactly.
                    self.assertEqual(np.float32(value).tobytes(), np.float32(row[name]).tobytes(),
                                     f"{name} of frame {row['frame']}")
                else:
                    self.assertEqual(str(value), row[name], f"{name} of frame {row['frame']}")
        self.assertEqual(e.kind, 'measured')


if __name__ == '__main__':
    unittest.main()
