#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Runs an image of unit tests in the emulator: run_target_tests.py MACHINE IMAGE LEAST"""
import re
import subprocess
import sys

import emulated

machine, image, least = sys.argv[1], sys.argv[2], int(sys.argv[3])
run = subprocess.run(emulated.command(machine, image), stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                     timeout=500)
print(run.stdout)
found = re.search(r'(\d+) tests run, 0 failed', run.stdout)
sys.exit(0 if run.returncode == 0 and found and int(found.group(1)) >= least else 1)
