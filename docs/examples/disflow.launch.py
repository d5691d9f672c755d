# SPDX-License-Identifier: BSD-3-Clause
"""Starts disflow_track on depth images of ROS 2; see docs/ros2.md.

    ros2 launch disflow.launch.py depth:=/camera/camera/depth/image_rect_raw extra:='--object name=box,seed=320:180'

In a launch file of your own, names and topics may as well be remappings: disflow_track takes --ros-args.
"""
import os
import shlex

from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, ExecuteProcess, OpaqueFunction, Shutdown
from launch.substitutions import LaunchConfiguration

# Name, default, description.
_ARGUMENTS = (
    ("depth", "/camera/camera/depth/image_rect_raw", "Image of depth, or …/compressedDepth"),
    ("info", "", "CameraInfo; empty: camera_info beside the images"),
    ("rectified", "", "yes or no; empty: by the name of the depth topic"),
    ("mask", "", "Image, mono8: which pixels are the object; empty: none"),
    ("world", "", "tf frame in which the camera moves; empty: it stands"),
    ("camera", "camera_depth_optical_frame", "tf frame of the images"),
    ("reset", "", "yes: whoever is in the domain may start an object anew; empty: no"),
    ("choose", "", "yes: and say what is tracked"),
    ("parameters", "", "yes: whoever is in the domain may change settings by ros2 param"),
    ("lifecycle", "", "yes: and pause and resume by ros2 lifecycle"),
    ("name", "disflow", "name of the node and first part of its topics"),
    ("namespace", "", "what stands before them, /robot1; empty: nothing"),
    ("domain", os.environ.get("ROS_DOMAIN_ID", "0") or "0", "ROS_DOMAIN_ID"),
    ("wait", "60", "seconds to wait for the first image"),
    ("program", "disflow_track", "the program, or a path to it"),
    ("extra", "", "further options of disflow_track"),
)
# These announce nodes in another way than later ones.
_BEFORE_IRON = ("dashing", "eloquent", "foxy", "galactic", "humble")


def command(value):
    """The command line; value(NAME) is what an argument was given."""

    def address(*names):
        given = [f"{name}={value(name)}" for name in names if value(name)]
        if os.environ.get("ROS_DISTRO", "") in _BEFORE_IRON:
            given.append("ros=humble")
        return "dds:" + "&".join(given)

    sensor = address("domain", "name", "namespace", "depth", "info", "rectified", "wait")
    link = address("domain", "name", "namespace", "camera", "mask", "world", "reset", "choose", "parameters", "lifecycle")
    return [value("program"), "--headless", "--sensor", sensor, "--link", link, *shlex.split(value("extra"))]


def _start(context):
    process = command(lambda name: LaunchConfiguration(name).perform(context))
    return [ExecuteProcess(cmd=process, output="screen", on_exit=Shutdown())]


def generate_launch_description():
    """What ros2 launch asks for."""
    arguments = [DeclareLaunchArgument(name, default_value=default, description=text) for name, default, text in _ARGUMENTS]
    return LaunchDescription([*arguments, OpaqueFunction(function=_start)])
