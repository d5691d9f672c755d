# SPDX-License-Identifier: BSD-3-Clause
"""libcamera on stock kernels: the emulated camera's Y12 images as R12, bit for bit."""
import os
import unittest

import setting
from guest import Guest
from live import SCRIPT, GuestOutput, make_kernel, rows_of
from sequences import Sequence

FRAMES = 45

# What udevd and a board's firmware would have done: the devices count as ready, and the USB
# controller has a name.
_PREPARE = """
mkdir -p /run/udev/data /sys2
mount -t sysfs sysfs /sys2
ready() {
  plugged; usleep 200000
  for device in /sys/class/video4linux/* /sys/bus/media/devices/*; do
    echo I:1 >"/run/udev/data/c$(cat "$device/dev")"
  done
}
name_controller() {
  port=/devices/platform/vhci_hcd.0
  mount -t tmpfs tmpfs /sys$port
  mkdir -p /sys$port/firmware_node /sys$port/usb1
  echo '\\_SB.USB0' >/sys$port/firmware_node/path
  mount --bind /sys2$port/usb1 /sys$port/usb1
}
"""


class _Libcamera(GuestOutput):
    """The tests of both machines."""

    arch = ""
    programs = ""

    @classmethod
    def setUpClass(cls):
        cls.programs = setting.programs if cls.arch == "amd64" else setting.arm_programs
        paths = [os.path.join(cls.programs, name)
                 for name in ["hil_usb_camera", "hil_frame_log", "disflow_track"]]
        if not all(os.path.exists(path) for path in paths):
            raise unittest.SkipTest(f"no programs for {cls.arch} in {cls.programs}")
        with open(paths[1], "rb") as file:
            if b"libcamera.so" not in file.read():
                raise unittest.SkipTest(f"built without libcamera for {cls.arch}: configured with DISFLOW_WITH_LIBCAMERA=OFF")
        kernel = make_kernel(cls.arch)
        cls.sequence = Sequence(setting.programs, os.path.join(setting.folder, "box_libcamera_" + cls.arch),
                                frames=FRAMES)
        guest = Guest(kernel, os.path.join(setting.folder, "libcamera_" + cls.arch))
        guest.add_modules(["vhci_hcd", "uvcvideo"])
        for path in paths:
            guest.add_program(path)
        guest.add_file("frames", cls.sequence.raw)
        guest.add_text("cam.toml", cls.sequence.camera_file())
        cls.out = guest.boot(SCRIPT + _PREPARE + cls.script(), timeout_s=400)

    @classmethod
    def script(cls):
        sensor = "libcamera:0?format=R12&depth_scale=0.001&width=320&height=240&" + cls.sequence.k_option()
        return f"""
camera --format Y12
ready
name_controller
disflow_track --list-sensors >/out/list
hil_frame_log "{sensor}" {FRAMES - 1} /frames >/out/frames
hil_frame_log "{sensor.replace('320', '321')}" 1 >/out/refused_size
hil_frame_log "{sensor.replace('R12', 'R10')}" 1 >/out/refused_format
unplug
camera --format Y12 --attach /sys2$port/attach --fault 20:detach=900
ready
# As a service manager does: a program that ended is started again.
start() {{ disflow_track --sensor "{sensor}" --csv /out/$1.csv --headless --no-timing 2>/out/$1 & track=$!; }}
start first; wait $track; echo "first status $?"
ready; start second; played; kill -INT $track; wait $track; echo "second status $?"
unplug
"""

    def test_camera_is_listed(self):
        self.assertIn("libcamera:0  ", self.text("list"))
        self.assertIn("format=R12 320x240", self.text("list"))

    def test_every_frame_arrives_bit_for_bit(self):
        numbers = [int(line.split()[2]) for line in self.text("frames").splitlines()
                   if line.startswith("frame ")]
        # libcamera starts the stream before the first buffer is there: the first frame may be missed.
        self.assertIn(numbers[0], [0, 1])
        self.assertEqual(numbers, list(range(numbers[0], FRAMES)), self.text("frames"))
        setting.figures.append(f"libcamera, {self.arch}: {len(numbers)} of {FRAMES} frames of Y12 bit for bit as R12")

    def test_what_is_not_delivered_is_refused_with_what_is(self):
        self.assertIn("320x240", self.text("refused_size"))
        self.assertIn("offers no R10", self.text("refused_format"))

    def test_unplugged_camera_ends_the_run_in_order_and_the_next_one_tracks_on(self):
        self.assertIn("first status 3", self.text("log"), self.text("first"))
        self.assertIn("libcamera cannot take it back while running: start again", self.text("first"))
        self.assertIn("second status 0", self.text("log"), self.text("second"))
        first, second = (rows_of(self.out[name + ".csv"]) for name in ["first", "second"])
        self.assertGreater(len(first), 15)
        self.assertEqual(second[-1]["state"], "tracking", self.text("second"))


class LibcameraOnX86(_Libcamera, unittest.TestCase):
    arch = "amd64"


class LibcameraOnArm64(_Libcamera, unittest.TestCase):
    arch = "arm64"
