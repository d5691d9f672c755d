# SPDX-License-Identifier: BSD-3-Clause
"""An emulated USB depth camera on a stock x86 kernel: every frame, every bit, the same trajectory."""
import os
import unittest

import setting
from guest import Guest
from live import SCRIPT, GuestOutput, check_trajectory, make_kernel
from sequences import Sequence

FRAMES = 90
RATE_HZ = 30
FAST_HZ = 200
_SENSOR = "v4l2:/dev/video0?format=Z16&depth_scale=0.001"

class CameraOnX86(GuestOutput, unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        kernel = make_kernel("amd64")
        cls.sequence = Sequence(setting.programs, os.path.join(setting.folder, "box"), frames=FRAMES)
        guest = Guest(kernel, os.path.join(setting.folder, "x86_camera"))
        guest.add_modules(["vhci_hcd", "uvcvideo"])
        for program in ["hil_usb_camera", "hil_frame_log", "disflow_track"]:
            guest.add_program(os.path.join(setting.programs, program))
        guest.add_file("frames", cls.sequence.raw)
        guest.add_text("cam.toml", cls.sequence.camera_file())
        cls.out = guest.boot(SCRIPT + f"""
camera
plugged
disflow_track --list-sensors >/out/list
hil_frame_log "{_SENSOR}&fps=30&{cls.sequence.k_option()}" {FRAMES} /frames >/out/frames
unplug
camera
track live "{_SENSOR}&fps=30&intrinsics=/cam.toml"
unplug
camera --fps {FAST_HZ}
track fast "{_SENSOR}&intrinsics=/cam.toml"
unplug
""", timeout_s=400)

    def test_camera_is_listed_with_identity_format_size_and_rate(self):
        listing = self.text("list")
        for words in ["v4l2:/dev/video0", "1209:0001", "DISFLOW-TEST-1", "format=Z16", "320x240 at 30"]:
            self.assertIn(words, listing)

    def test_every_frame_arrives_bit_for_bit_in_order(self):
        lines = [line.split() for line in self.text("frames").splitlines() if line.startswith("frame ")]
        counters = self.text("frames").splitlines()[-1].split()
        lost = int(counters[counters.index("gaps") + 1]) + int(counters[counters.index("skipped") + 1])
        self.assertEqual(len(lines) + lost, FRAMES)
        self.assertNotIn("-1", [words[2] for words in lines])
        stamps = [int(words[1]) for words in lines]
        last = int(lines[-1][2])
        rate = (last - int(lines[0][2])) / (stamps[-1] - stamps[0]) * 1e9
        setting.figures.append(f"x86: {len(lines)} of {FRAMES} frames bit for bit at {rate:.2f} fps, {lost} lost and counted")
        self.assertLess(rate, RATE_HZ * 1.05)

    def test_every_frame_is_tracked_at_the_cameras_rate_as_in_a_replay(self):
        rows = self.rows("live")
        check_trajectory(self, self.sequence, "live", rows)
        self.assertEqual(len(rows), FRAMES, self.text("live"))
        self.assertGreater(sum(row["state"] == "tracking" for row in rows), 0.8 * FRAMES)
        setting.figures.append(f"x86, {RATE_HZ} fps: {len(rows)} of {FRAMES} frames tracked, "
                               "trajectory equal to the replay's to the bit")

    def test_camera_too_fast_for_the_tracker_loses_only_counted_frames(self):
        rows = self.rows("fast")
        check_trajectory(self, self.sequence, "fast", rows)
        self.assertLess(len(rows), FRAMES)
        setting.figures.append(f"x86, {FAST_HZ} fps: {len(rows)} of {FRAMES} frames tracked, the others counted "
                               "as dropped, trajectory equal to the replay's to the bit")
