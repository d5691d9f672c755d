# SPDX-License-Identifier: BSD-3-Clause
"""An arm64 board on a stock kernel: USB camera, tracker, and MAVLink over its PL011 UART."""
import glob
import math
import os
import shutil
import subprocess
import unittest

import setting
from guest import Guest
from live import SCRIPT, GuestOutput, decode, make_kernel, replay, rows_of
from sequences import Sequence

FRAMES = 90
_SENSOR = "v4l2:/dev/video0?format=Z16&depth_scale=0.001&intrinsics=/cam.toml"
_UART = "serial:///dev/ttyAMA0?baud=921600"
# Optical axes to forward, right, down.
_Q_FC = (0.5, 0.5, 0.5, 0.5)


def _product(a, b):
    """Of quaternions w, x, y, z."""
    return (a[0] * b[0] - a[1] * b[1] - a[2] * b[2] - a[3] * b[3],
            a[0] * b[1] + a[1] * b[0] + a[2] * b[3] - a[3] * b[2],
            a[0] * b[2] - a[1] * b[3] + a[2] * b[0] + a[3] * b[1],
            a[0] * b[3] + a[1] * b[2] - a[2] * b[1] + a[3] * b[0])


def pose_frd(row):
    """Position and quaternion w, x, y, z of a trajectory's row as ODOMETRY carries them."""
    x, y, z = (float(row[key]) for key in ["x", "y", "z"])
    q = tuple(float(row[key]) for key in ["qw", "qx", "qy", "qz"])
    return (z, x, y), _product(_Q_FC, q)


def difference(a, b):
    """Of two poses: metres and degrees."""
    distance = math.dist(a[0], b[0])
    # The vector part stays exact where the scalar part has lost its digits.
    relative = _product((a[1][0], -a[1][1], -a[1][2], -a[1][3]), b[1])
    return distance, math.degrees(2 * math.atan2(math.hypot(*relative[1:]), abs(relative[0])))


def _packaged(program):
    """The program from the Debian package, if one was made beside it."""
    packages = glob.glob(os.path.join(setting.arm_programs, "..", "package", "disflow_*_arm64.deb"))
    if not packages:
        return program
    root = os.path.join(setting.folder, "arm_root")
    shutil.rmtree(root, ignore_errors=True)
    subprocess.run(["dpkg-deb", "-x", packages[0], root], check=True)
    setting.figures.append("arm64: disflow_track from " + os.path.basename(packages[0]))
    return os.path.join(root, "usr", "bin", os.path.basename(program))


class ArmBoard(GuestOutput, unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        programs = [os.path.join(setting.arm_programs, name)
                    for name in ["hil_usb_camera", "disflow_track"]]
        if not all(os.path.exists(program) for program in programs):
            raise unittest.SkipTest("no programs for arm64 in " + setting.arm_programs)
        programs[1] = _packaged(programs[1])
        kernel = make_kernel("arm64")
        cls.sequence = Sequence(setting.programs, os.path.join(setting.folder, "box_arm"), frames=FRAMES)
        folder = os.path.join(setting.folder, "arm_board")
        guest = Guest(kernel, folder)
        guest.add_modules(["vhci_hcd", "uvcvideo"])
        for program in programs:
            guest.add_program(program)
        guest.add_file("frames", cls.sequence.raw)
        guest.add_text("cam.toml", cls.sequence.camera_file())
        cls.uart = os.path.join(folder, "uart.bin")
        cls.out = guest.boot(SCRIPT + f"""
uname -a
camera
track board "{_SENSOR}" --link "{_UART}"
unplug
""", timeout_s=400, serial="file:" + cls.uart)
        cls.trajectory = rows_of(cls.out["board.csv"])
        cls.messages = decode(cls.uart)

    def of(self, name):
        return [message for message in self.messages if message["message"] == name]

    def test_every_frame_is_tracked_and_sent_over_the_uart(self):
        self.assertIn("board status 0", self.text("log"), self.text("board"))
        self.assertEqual(len(self.trajectory), FRAMES, self.text("board"))
        self.assertEqual(len(self.of("ODOMETRY")), FRAMES)
        self.assertEqual(len(self.of("DISFLOW_STATUS")), FRAMES)
        self.assertIn(" 0 dropped", self.text("board").split("serial://")[-1])
        sequence = [message["sequence"] for message in self.messages]
        self.assertEqual(sequence, [i % 256 for i in range(len(sequence))])

    def test_poses_on_the_line_are_those_of_a_replay_on_this_machine(self):
        frames = [(row, number + int(row["dropped"])) for number, row in enumerate(self.trajectory)]
        replayed = replay(self.sequence, "replay_arm", frames)
        sent = self.of("ODOMETRY")
        worst_m, worst_deg, equal = 0.0, 0.0, 0
        for message, row, here in zip(sent, self.trajectory, replayed):
            self.assertEqual(message["time_usec"], int(float(row["timestamp"]) * 1e6 + 0.5))
            metres, degrees = difference(((message["x"], message["y"], message["z"]), tuple(message["q"])),
                                         pose_frd(here))
            worst_m, worst_deg = max(worst_m, metres), max(worst_deg, degrees)
            equal += row["x"] == here["x"] and row["qx"] == here["qx"]
        setting.figures.append(f"arm64: {len(sent)} of {FRAMES} poses over the UART at 921600 baud, within "
                               f"{worst_m * 1e3:.4f} mm and {worst_deg:.4f} deg of this machine's replay, "
                               f"{equal} equal to the bit")
        self.assertLess(worst_m, 1e-4)
        self.assertLess(worst_deg, 0.01)
        self.assertGreater(sum(row["state"] == "tracking" for row in self.trajectory), 0.8 * FRAMES)

    def test_status_on_the_line_tells_no_loss(self):
        last = self.of("DISFLOW_STATUS")[-1]
        for name in ["dropped_frames", "corrupt_frames", "sensor_restarts", "sensor_reconnects"]:
            self.assertEqual(last[name], 0, name)
        self.assertEqual(last["frames"], FRAMES)
        self.assertLess(last["age_us"], 1_000_000)
