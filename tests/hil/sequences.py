# SPDX-License-Identifier: BSD-3-Clause
"""Simulated sequences: as raw images for the emulated camera, and with other stamps for a replay."""
import array
import glob
import json
import os
import shutil
import subprocess

UNIT_M = 0.001


class Sequence:
    """A sequence that disflow_sim writes, in millimetres as a camera's 16-bit image holds them."""

    def __init__(self, programs, folder, width=320, height=240, frames=90, options=()):
        self.folder = folder
        self.width = width
        self.height = height
        self.frames = frames
        shutil.rmtree(folder, ignore_errors=True)
        subprocess.run([os.path.join(programs, "disflow_sim"), folder, "--width", str(width),
                        "--height", str(height), "--frames", str(frames), "--mask", "none",
                        "--format", "z16", *options], check=True, capture_output=True)
        with open(os.path.join(folder, "cam_K.json"), encoding="ascii") as file:
            self.camera = json.load(file)
        self.raw = os.path.join(folder, "frames.raw")
        with open(self.raw, "wb") as file:
            for index in range(frames):
                file.write(self._image(index))

    def k_option(self):
        return "K=" + ",".join(repr(self.camera[key]) for key in ["fx", "fy", "cx", "cy"])

    def camera_file(self):
        keys = ["width", "height", "fx", "fy", "cx", "cy"]
        return "".join(f"{key} = {self.camera[key]!r}\n" for key in keys)

    def with_stamps(self, folder, frames):
        """The same images under other stamps. frames: [(index, stamp as text in seconds)]."""
        shutil.rmtree(folder, ignore_errors=True)
        os.makedirs(os.path.join(folder, "depth"))
        shutil.copy(os.path.join(self.folder, "cam_K.json"), folder)
        with open(os.path.join(folder, "data.txt"), "w", encoding="ascii") as file:
            for row, (index, stamp) in enumerate(frames):
                os.symlink(self._depth_file(index), os.path.join(folder, "depth", f"{row}.float"))
                file.write(f"{row} {stamp}\n")
        return folder

    def _depth_file(self, index):
        return os.path.abspath(os.path.join(self.folder, "depth", f"{index}.float"))

    def _image(self, index):
        depth_m = array.array("f")
        with open(self._depth_file(index), "rb") as file:
            data = file.read()
        depth_m.frombytes(data[len(data) - 4 * self.width * self.height:])
        return array.array("H", [int(value * 1000 + 0.5) for value in depth_m]).tobytes()
