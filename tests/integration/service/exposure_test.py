# SPDX-License-Identifier: BSD-3-Clause
"""systemd's own judgement of how exposed the unit leaves the service: exposure_test.py UNIT."""
import sys
import unittest

import unit_file

# In tenths, 0 to 100; what is left is what the service is for: network, devices, real-time priority.
_MOST_EXPOSURE = 20
_UNIT = sys.argv.pop() if len(sys.argv) > 1 else ""


class Unit(unittest.TestCase):
    def test_exposure_is_at_most_2(self):
        status, report = unit_file.analyze("security", "--offline=true", f"--threshold={_MOST_EXPOSURE}", _UNIT)
        self.assertEqual(status, 0, report)
        self.assertIn("Overall exposure level", report)

    def test_every_setting_is_known_to_systemd(self):
        complaints = [line for line in unit_file.analyze("verify", _UNIT)[1].splitlines()
                      if "disflow-track.service" in line and "is not executable" not in line]
        self.assertEqual(complaints, [])

    def test_real_time_priority_and_locked_memory_are_granted(self):
        self.assertGreaterEqual(int(unit_file.values_of(_UNIT, "LimitRTPRIO")[-1]), 50)
        self.assertEqual(unit_file.values_of(_UNIT, "LimitMEMLOCK"), ["infinity"])
        self.assertEqual(unit_file.values_of(_UNIT, "RestrictRealtime"), [])
        calls = unit_file.allowed_calls(_UNIT)
        self.assertLessEqual({"sched_setscheduler", "sched_setaffinity", "setpriority", "mlockall"}, calls)
        self.assertFalse({"mount", "ptrace", "reboot", "chown", "setuid", "bpf", "init_module"} & calls)


if __name__ == "__main__":
    unit_file.need_systemd()
    unittest.main()
