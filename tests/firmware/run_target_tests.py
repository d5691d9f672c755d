#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Runs an image of unit tests in the emulator: run_target_tests.py MACHINE IMAGE LEAST"""
import os
import pathlib
import re
import shutil
import subprocess
import sys

machine, image, least = sys.argv[1], sys.argv[2], int(sys.argv[3])
if 'DISFLOW_TEST_FIRMWARE' not in os.environ:
    print('skipped: run by ./dev test --firmware')
    sys.exit(77)
if not shutil.which('qemu-system-arm'):
    print('skipped: qemu-system-arm is missing')
    sys.exit(77)
if not pathlib.Path(image).exists():
    sys.exit(f'{image} is not built')
run = subprocess.run(['qemu-system-arm', '-M', machine, '-display', 'none', '-monitor', 'none', '-serial', 'none',
                      '-semihosting-config', 'enable=on,target=native', '-kernel', image],
                     stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, timeout=500)
print(run.stdout)
found = re.search(r'(\d+) tests run, 0 failed', run.stdout)
sys.exit(0 if run.returncode == 0 and found and int(found.group(1)) >= least else 1)
