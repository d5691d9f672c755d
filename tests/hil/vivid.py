# SPDX-License-Identifier: BSD-3-Clause
"""The kernel's virtual video driver: every 16-bit format and odd sizes negotiate or are refused."""
import os
import re
import unittest

import setting
from guest import Guest
from live import GuestOutput, make_kernel

_K = "depth_scale=0.001&K=500,500,320,180"
# What the driver offers in a format that is depth's, and in one that is none.
_DELIVERED = ["Y16", "Y16_BE", "Y12"]
_MISSING = ["Z16", "INZI"]
_SIZES = ["320x180", "640x360", "640x480"]
_ODD_SIZES = ["321x181", "1x1", "8192x8192", "640x361"]


class Vivid(GuestOutput, unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        kernel = make_kernel("amd64")
        guest = Guest(kernel, os.path.join(setting.folder, "vivid"))
        # Two webcams, the second for masks; nothing else.
        guest.add_modules(["vivid"])
        guest.add_options("vivid", "n_devs=2 node_types=0x1,0x1 input_types=0x0,0x0 num_inputs=1,1")
        for program in ["hil_frame_log", "disflow_track"]:
            guest.add_program(os.path.join(setting.programs, program))
        cls.out = guest.boot(cls.script(), timeout_s=400)

    @staticmethod
    def script():
        lines = ["disflow_track --list-sensors >/out/list"]
        for name in _DELIVERED + _MISSING:
            lines.append(f'hil_frame_log "v4l2:/dev/video0?format={name}&{_K}" 5 >/out/format_{name}')
        for size in _SIZES + _ODD_SIZES:
            width, height = size.split("x")
            lines.append(f'hil_frame_log "v4l2:/dev/video0?format=Y16&width={width}&height={height}&{_K}" 3 '
                         f">/out/size_{size}")
        lines.append(f'hil_frame_log "v4l2:/dev/video0?{_K}" 3 >/out/any')
        lines.append(f'hil_frame_log "v4l2:/dev/video0?format=Y16&fps=1000&{_K}" 3 >/out/rate_1000')
        lines.append(f'disflow_track --sensor "v4l2:/dev/video0?format=Y16&width=320&height=180&{_K}" --frames 20 '
                     "--mask-stream v4l2:/dev/video1 --headless 2>/out/masked")
        return "\n".join(lines) + "\n"

    def test_every_16_bit_format_delivers_or_says_what_there_is(self):
        for name in _DELIVERED:
            with self.subTest(name):
                self.assertEqual(self.text("format_" + name).count("\nframe "), 5, self.text("format_" + name))
        for name in _MISSING:
            with self.subTest(name):
                self.assertIn(f"offers no {name}; it has: ", self.text("format_" + name))
        setting.figures.append(f"vivid: {', '.join(_DELIVERED)} delivered, {', '.join(_MISSING)} refused with the "
                               "list of what there is")

    def test_every_size_is_delivered_as_asked_or_refused(self):
        delivered = []
        for size in _SIZES + _ODD_SIZES:
            with self.subTest(size):
                text = self.text("size_" + size)
                if text.startswith("open "):
                    delivered.append(size)
                    self.assertIn(f"open {size} ", text)
                    self.assertEqual(text.count("\nframe "), 3, text)
                else:
                    self.assertIn("sizes: ", text)
        self.assertEqual([size for size in delivered if size in _ODD_SIZES], [])
        self.assertLessEqual(set(_SIZES) - {"640x480"}, set(delivered))
        setting.figures.append(f"vivid: sizes {', '.join(delivered)} delivered, {', '.join(_ODD_SIZES)} refused")

    def test_format_is_chosen_where_none_is_asked_for(self):
        self.assertEqual(self.text("any").count("\nframe "), 3, self.text("any"))

    def test_rate_beyond_the_drivers_is_refused(self):
        self.assertIn("rates: ", self.text("rate_1000"))

    def test_listing_names_the_depth_formats(self):
        for name in _DELIVERED:
            self.assertIn(f"format={name}\n", self.text("list"))

    def test_masks_of_another_device_belong_to_the_frames_of_their_time(self):
        # Test pictures, not depth: whether they can be tracked does not matter.
        used = re.search(r"masks from v4l2:/dev/video1: (\d+) used, (\d+) missing, (\d+) late", self.text("masked"))
        self.assertIsNotNone(used, self.text("masked"))
        self.assertGreater(int(used[1]), 5, self.text("masked"))
        setting.figures.append(f"vivid: GREY masks, {used[1]} of 20 frames had one, {used[2]} before the first came")
