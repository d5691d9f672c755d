# SPDX-License-Identifier: BSD-3-Clause
"""The example's command lines are ones that disflow_track takes. Usage: launch_file_test.py DISFLOW_TRACK

ROS need not be installed: the four names that the file takes from its packages are stood in for.
"""
import importlib.util
import os
import pathlib
import subprocess
import sys
import types
import unittest

_FILE = pathlib.Path(__file__).resolve().parents[3] / "docs" / "examples" / "disflow.launch.py"


class _Call:
    """What was made, and of what."""

    def __init__(self, *args, **kwargs):
        self.args, self.kwargs = args, kwargs


def _load():
    for module, names in {
        "launch": ["LaunchDescription"],
        "launch.actions": ["DeclareLaunchArgument", "ExecuteProcess", "OpaqueFunction", "Shutdown"],
        "launch.substitutions": ["LaunchConfiguration"],
    }.items():
        sys.modules[module] = types.SimpleNamespace(**{name: type(name, (_Call,), {}) for name in names})
    spec = importlib.util.spec_from_file_location("disflow_launch", _FILE)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


class LaunchFile(unittest.TestCase):
    def setUp(self):
        os.environ["ROS_DISTRO"] = "jazzy"
        self.launch = _load()
        self.values = {name: default for name, default, _ in self.launch._ARGUMENTS}
        self.values["program"] = sys.argv[1]

    def command(self, **changes):
        return self.launch.command({**self.values, **changes}.__getitem__)

    def assert_taken(self, command):
        # It reads the whole command line, and then prints settings in place of a run.
        answer = subprocess.run([*command, "--print-config"], capture_output=True, text=True, check=False)
        self.assertEqual(answer.returncode, 0, answer.stderr)

    def test_defaults_are_taken(self):
        self.assert_taken(self.command())

    def test_every_argument_reaches_the_program(self):
        command = self.command(
            depth="/a/image/compressedDepth", info="/a/info", rectified="yes", mask="/m", world="map", camera="eye",
            reset="yes", choose="yes", parameters="yes", lifecycle="yes", name="arm", namespace="/r1", domain="7", wait="5",
            extra="--object 'name=box,seed=3:4' --profile micro",
        )
        self.assert_taken(command)
        sensor = "dds:domain=7&name=arm&namespace=/r1&depth=/a/image/compressedDepth&info=/a/info&rectified=yes&wait=5"
        self.assertIn(sensor, command)
        self.assertIn("dds:domain=7&name=arm&namespace=/r1&camera=eye&mask=/m&world=map&reset=yes&choose=yes&parameters=yes&lifecycle=yes", command)
        self.assertEqual(command[-3:], ["name=box,seed=3:4", "--profile", "micro"])

    def test_humble_is_told(self):
        os.environ["ROS_DISTRO"] = "humble"
        command = self.command()
        self.assertEqual(sum("&ros=humble" in word for word in command), 2)
        self.assert_taken(command)

    def test_description_declares_every_argument_and_starts_the_program(self):
        actions = self.launch.generate_launch_description().args[0]
        kinds = [type(action).__name__ for action in actions]
        self.assertEqual(kinds, ["DeclareLaunchArgument"] * len(self.values) + ["OpaqueFunction"])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
