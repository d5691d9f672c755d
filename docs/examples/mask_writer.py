#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Writes masks into shared memory for disflow_track --mask-stream; see docs/masks.md.

As a program it writes a fixed rectangle, to try the way out:
    mask_writer.py /disflow-masks 640 480 200 120 240 240
"""
import mmap
import os
import struct
import sys
import time

_HEADER = struct.Struct("<8sQqIII28x")  # magic, sequence, stamp_ns, width, height, stride
_SEQUENCE = struct.Struct("<Q")


class MaskWriter:
    """One mask at a time; a reader notices when it caught half of one."""

    def __init__(self, name, width, height):
        path = "/dev/shm" + name
        # A new object: readers find it by its name, and none sees an old one change its size.
        if os.path.exists(path):
            os.unlink(path)
        file = os.open(path, os.O_RDWR | os.O_CREAT | os.O_EXCL, 0o644)
        os.ftruncate(file, _HEADER.size + width * height)
        self._memory = mmap.mmap(file, _HEADER.size + width * height)
        os.close(file)
        self._width, self._height, self._sequence = width, height, 0

    def write(self, mask, stamp_ns):
        """mask: width * height bytes, not 0 = object. stamp_ns: of the depth image that it is for."""
        if len(mask) != self._width * self._height:
            raise ValueError("the mask has another size")
        self._sequence += 1  # odd: at work
        _HEADER.pack_into(self._memory, 0, b"DFMASK01", self._sequence, stamp_ns,
                          self._width, self._height, self._width)
        self._memory[_HEADER.size:] = bytes(mask)
        self._sequence += 1
        _SEQUENCE.pack_into(self._memory, 8, self._sequence)


def main():
    if len(sys.argv) != 8:
        sys.exit(__doc__)
    name = sys.argv[1]
    width, height, left, top, box_width, box_height = map(int, sys.argv[2:])
    mask = bytearray(width * height)
    for v in range(max(top, 0), min(top + box_height, height)):
        for u in range(max(left, 0), min(left + box_width, width)):
            mask[v * width + u] = 255
    writer = MaskWriter(name, width, height)
    while True:
        writer.write(mask, time.clock_gettime_ns(time.CLOCK_MONOTONIC))
        time.sleep(1 / 30)


if __name__ == "__main__":
    try:
        main()
    except KeyboardInterrupt:
        pass
