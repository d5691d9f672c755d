# SPDX-License-Identifier: BSD-3-Clause
"""Cameras, links and whole boards in emulated machines: ./dev test --hil.

Exit status: 0 all passed, 1 something failed, 77 nothing could be run. With CI set in the environment, a test that is skipped
is a failure: CI is there to run it.
"""
import argparse
import importlib
import os
import sys
import time
import unittest

import setting

_SUITES = ["x86_camera", "faults", "arm_board", "vivid", "libcamera_sensor", "service"]


class _Result(unittest.TextTestResult):
    """Says how long each took, and why one was skipped."""

    def startTest(self, test):
        self._start = time.monotonic()
        super().startTest(test)

    def addSkip(self, test, reason):
        super().addSkip(test, reason)
        self.stream.writeln(f"skipped: {reason}")


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--programs", default="build/release/bin", help="built for this machine")
    parser.add_argument("--arm-programs", default="build/aarch64/bin", help="built for arm64")
    parser.add_argument("--arm-root", default="build/aarch64-root", help="the libraries for arm64")
    parser.add_argument("--folder", default="build/hil", help="kernels and results")
    parser.add_argument("--only", action="append", choices=_SUITES)
    arguments = parser.parse_args()
    setting.programs = os.path.abspath(arguments.programs)
    setting.arm_programs = os.path.abspath(arguments.arm_programs)
    setting.arm_root = os.path.abspath(arguments.arm_root)
    setting.folder = os.path.abspath(arguments.folder)
    os.makedirs(setting.folder, exist_ok=True)
    loader = unittest.TestLoader()
    suite = unittest.TestSuite(loader.loadTestsFromModule(importlib.import_module(name))
                               for name in arguments.only or _SUITES)
    start = time.monotonic()
    result = unittest.TextTestRunner(verbosity=2, resultclass=_Result).run(suite)
    print(f"hil: {result.testsRun} tests in {time.monotonic() - start:.0f} s", file=sys.stderr)
    for line in setting.figures:
        print(line)
    if not result.wasSuccessful():
        return 1
    if os.environ.get("CI") and result.skipped:
        print(f"hil: {len(result.skipped)} skipped, but CI is there to run them", file=sys.stderr)
        return 1
    return 77 if result.testsRun == len(result.skipped) else 0


if __name__ == "__main__":
    sys.exit(main())
