# SPDX-License-Identifier: BSD-3-Clause
"""Images and the emulator. Without what a test needs it is skipped (status 77)."""
import os
import pathlib
import shutil
import sys


def skip_unless_built():
    """Elsewhere the images are missing or of another commit."""
    if 'DISFLOW_TEST_FIRMWARE' not in os.environ:
        print('skipped: run by ./dev test --firmware')
        sys.exit(77)


def command(machine, image):
    """The emulator's command line for an image whose output and end go through semihosting."""
    skip_unless_built()
    if not shutil.which('qemu-system-arm'):
        print('skipped: qemu-system-arm is missing')
        sys.exit(77)
    if not pathlib.Path(image).exists():
        sys.exit(f'{image} is not built')
    return ['qemu-system-arm', '-M', machine, '-display', 'none', '-monitor', 'none', '-serial', 'none',
            '-semihosting-config', 'enable=on,target=native', '-kernel', image]
