# SPDX-License-Identifier: BSD-3-Clause
"""What goes wrong with a camera, on a stock x86 kernel: the documented state, no crash, true counters."""
import os
import re
import unittest

import setting
from guest import Guest
from live import SCRIPT, GuestOutput, check_trajectory, decode, make_kernel
from sequences import Sequence

FRAMES = 40
# More than a pseudo-terminal's buffers hold.
_LONG = 90
_HZ = 4
_SENSOR = "v4l2:/dev/video0?format=Z16&depth_scale=0.001&intrinsics=/cam.toml"


def _refusals(k_option):
    """name: address of a sensor that must be refused."""
    device = "v4l2:/dev/video0?"
    return {
        "format": device + "format=Y16&depth_scale=0.001&" + k_option,
        "size": device + "width=640&height=480&depth_scale=0.001&" + k_option,
        "rate": device + "fps=60&depth_scale=0.001&" + k_option,
        "unit": device + k_option,
        "intrinsics": device + "depth_scale=0.001",
        "metadata": "v4l2:/dev/video1?depth_scale=0.001&" + k_option,
        "missing": "v4l2:/dev/video7?depth_scale=0.001&" + k_option,
        "serial": "v4l2:serial=NOBODY?depth_scale=0.001&" + k_option,
    }


class CameraFaults(GuestOutput, unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        kernel = make_kernel("amd64")
        cls.sequence = Sequence(setting.programs, os.path.join(setting.folder, "box_faults"),
                                frames=_LONG)
        cls.refusals = _refusals(cls.sequence.k_option())
        guest = Guest(kernel, os.path.join(setting.folder, "faults"))
        guest.add_modules(["vhci_hcd", "uvcvideo"])
        for program in ["hil_usb_camera", "hil_frame_log", "hil_far_end", "disflow_track"]:
            guest.add_program(os.path.join(setting.programs, program))
        guest.add_file("frames", cls.sequence.raw)
        guest.add_text("cam.toml", cls.sequence.camera_file())
        cls.out = guest.boot(SCRIPT + cls.script(), timeout_s=400)

    @classmethod
    def script(cls):
        refused = "".join(f'try {name} "{uri}"\n' for name, uri in cls.refusals.items())
        return f"""
try() {{
  disflow_track --sensor "$2" --headless --csv /out/try.csv 2>"/out/refused_$1"
  echo "refused_$1 status $?"
}}
nodrop() {{ echo $1 >/sys/module/uvcvideo/parameters/nodrop; }}
# Refused at the start, and busy.
camera --vendor 4660
plugged
{refused}
hil_frame_log "{_SENSOR.replace('intrinsics=/cam.toml', cls.sequence.k_option())}" 30 >/dev/null & taker=$!
usleep 700000
try busy "{_SENSOR}"
kill $taker
unplug
try before_start "{_SENSOR}"
# A known model needs no unit.
camera --vendor 32902 --product 2823 --fps 30
plugged
hil_frame_log "v4l2:/dev/video0?{cls.sequence.k_option()}" 3 >/out/known_model
unplug
# Damaged frames as the driver marks them, silence, unplugging.
# Meanwhile the peer of the link comes, goes and comes back.
nodrop 1
camera --fps {_HZ} --count {FRAMES} --fault 8:error --fault 11:short --fault 14:stall=2600 --fault 24:detach=900
listen() {{ hil_far_end udp 14550 /out/$1 & peer=$!; }}
(sleep 1; listen udp_before; sleep 2; kill $peer; sleep 2; listen udp_after; sleep 20; kill $peer) &
track damaged "{_SENSOR}" --link udp://127.0.0.1:14550
unplug
# A serial line whose far end stops, and goes on later.
hil_far_end line /line /out/line & line=$!
camera --fps 30
(sleep 4; kill -USR1 $line) &
track stalled "{_SENSOR}" --link "serial:///line?baud=921600"
wait $line
unplug
# The same damage when the driver hides it.
nodrop 0
camera --fps {_HZ} --count 12 --fault 5:error --fault 8:short
track hidden "{_SENSOR}"
unplug
# A tracker that is stopped for a while.
camera --fps 30 --count {FRAMES}
plugged
disflow_track --sensor "{_SENSOR}" --csv /out/stopped.csv --headless --no-timing 2>/out/stopped & track=$!
usleep 500000; kill -STOP $track; usleep 600000; kill -CONT $track
played; kill -INT $track; wait $track; echo "stopped status $?"
unplug
"""

    def test_what_cannot_be_had_is_refused_with_the_reason(self):
        words = {"format": "it has: Z16", "size": "sizes: 320x240", "rate": "rates: 30",
                 "unit": "depth_scale=", "intrinsics": "intrinsics=FILE.toml",
                 "metadata": "captures no images", "missing": "no such device",
                 "serial": "DISFLOW-TEST-1", "busy": "another program",
                 "before_start": "no such device"}
        for name, reason in words.items():
            with self.subTest(name):
                self.assertIn(reason, self.text("refused_" + name))
                status = 2 if name == "intrinsics" else 3
                self.assertIn(f"refused_{name} status {status}", self.text("log"))

    def test_known_model_needs_no_unit(self):
        self.assertEqual(self.text("known_model").count("frame "), 3)

    def test_damage_silence_and_unplugging_end_in_tracking_with_true_counters(self):
        rows = self.rows("damaged")
        # A damaged frame gives a row unless a good one followed before the tracker was ready.
        self.assertLessEqual({row["status"] for row in rows},
                             {"ok", "corrupt", "truncated", "registration_failed"})
        # What is seen after so long that it may be anywhere waits for the next frame to agree.
        for before, row, after in zip(rows, rows[1:], rows[2:]):
            if row["status"] == "registration_failed":
                self.assertGreater(float(row["timestamp"]) - float(before["timestamp"]), 0.6)
                self.assertEqual(after["status"], "ok")
        report = self.text("damaged")
        self.assertIn("2 corrupt", report)
        self.assertIn("stream stalled or failed 1 times", report)
        self.assertIn("sensor came back 1 times", report)
        self.assertIn("waiting for it to come back", report)
        self.assertIn("the sensor is back", report)
        self.assertEqual(rows[-1]["state"], "tracking", report)
        # The end of the list is reached whatever was lost on the way.
        self.assertGreater(len(rows), 0.7 * FRAMES)
        resets = [int(row["reset_counter"]) for row in rows]
        self.assertEqual(resets, sorted(resets))
        self.assertGreater(resets[-1], resets[0])
        setting.figures.append(f"x86: {len(rows)} of {FRAMES} frames through a damaged frame, a short one, "
                               f"2.6 s of silence and 0.9 s unplugged; reset_counter {resets[0]} to {resets[-1]}, "
                               f"at the end {rows[-1]['state']}")

    def messages(self, name):
        path = os.path.join(setting.folder, "faults", name + ".bin")
        with open(path, "wb") as file:
            file.write(self.out[name])
        return decode(path)

    def test_counters_leave_over_the_link_to_a_peer_that_went_and_came_back(self):
        before, after = self.messages("udp_before"), self.messages("udp_after")
        for part in [before, after]:
            self.assertGreater(sum(message["message"] == "ODOMETRY" for message in part), 3)
        self.assertNotRegex(self.text("damaged"), r"udp://\S+ \d+ messages sent, \d+ dropped, 0 refused")
        status = [message for message in after if message["message"] == "DISFLOW_STATUS"][-1]
        self.assertEqual(status["corrupt_frames"], 2)
        self.assertEqual(status["sensor_restarts"], 1)
        self.assertEqual(status["sensor_reconnects"], 1)

    def test_stalled_line_drops_whole_messages_and_tracking_goes_on(self):
        rows = self.rows("stalled")
        self.assertEqual(len(rows), _LONG)
        report = self.text("stalled")
        sent, dropped = map(int, re.search(r"serial://\S+ (\d+) messages sent, (\d+) dropped", report).groups())
        self.assertGreater(dropped, 0)
        self.assertEqual(len(self.messages("line")), sent, "no message may be cut or lost once it was sent")
        setting.figures.append(f"x86: stalled serial line: {sent} messages sent and decoded, {dropped} dropped as a "
                               f"whole, {len(rows)} of {_LONG} frames tracked")

    def test_frames_that_the_driver_hides_are_counted_as_gaps(self):
        rows = self.rows("hidden")
        self.assertEqual({row["status"] for row in rows}, {"ok"})
        gaps = int(re.search(r"\((\d+) in the driver", self.text("hidden")).group(1))
        self.assertEqual(gaps, 2)
        check_trajectory(self, self.sequence, "hidden", rows)

    def test_frames_that_a_stopped_program_missed_are_counted(self):
        rows = self.rows("stopped")
        self.assertGreater(int(re.search(r"\((\d+) in the driver", self.text("stopped")).group(1)), 5)
        check_trajectory(self, self.sequence, "stopped", rows)

    def test_kernel_is_unharmed(self):
        for word in ["Oops", "BUG:", "WARNING:", "segfault"]:
            self.assertNotIn(word, self.text("dmesg"))
