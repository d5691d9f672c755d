# SPDX-License-Identifier: BSD-3-Clause
"""The program under the unit's filter of system calls: system_calls_test.py UNIT DISFLOW_TRACK.

Here a call that the unit does not allow ends the program, where the unit lets it fail: none may go unnoticed.
"""
import ctypes
import ctypes.util
import errno
import os
import re
import signal
import socket
import subprocess
import sys
import tempfile
import threading
import time
import unittest
import urllib.request

import unit_file

# Tried by libraries (libnuma) as they are loaded; that it fails is of no consequence.
_TRIED = {"set_mempolicy"}

_KILL_PROCESS = 0x80000000
_ALLOW = 0x7FFF0000
_FAIL = 0x00050000 | errno.EPERM
_TOKEN = "correct-horse-battery"
_PROGRAM = sys.argv.pop() if len(sys.argv) > 2 else ""
_UNIT = sys.argv.pop() if len(sys.argv) > 1 else ""


class Filter:
    """For the process that is to be: load() is called between fork and exec."""

    def __init__(self, library, allowed):
        self._library = library
        library.seccomp_init.restype = ctypes.c_void_p
        library.seccomp_init.argtypes = [ctypes.c_uint32]
        library.seccomp_rule_add.argtypes = [ctypes.c_void_p, ctypes.c_uint32, ctypes.c_int, ctypes.c_uint]
        library.seccomp_load.argtypes = [ctypes.c_void_p]
        self._context = library.seccomp_init(_KILL_PROCESS)
        for name in sorted(allowed):
            self._add(_ALLOW, name)
        for name in sorted(_TRIED - allowed):
            self._add(_FAIL, name)

    def _add(self, action, name):
        number = self._library.seccomp_syscall_resolve_name(name.encode())
        if number >= 0:  # others are of other processors
            self._library.seccomp_rule_add(self._context, action, number, 0)

    def load(self):
        if self._library.seccomp_load(self._context) != 0:
            os._exit(99)


class Program(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls._library = ctypes.CDLL(_LIBRARY)
        cls._allowed = unit_file.allowed_calls(_UNIT)

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self._folder = folder.name

    def start(self, *options, allowed=None):
        return subprocess.Popen([_PROGRAM, "--headless", *options], cwd=self._folder, stdout=subprocess.DEVNULL,
                                stderr=subprocess.PIPE, text=True,
                                env=dict(os.environ, DISFLOW_VIEW_TOKEN=_TOKEN),
                                preexec_fn=Filter(self._library, allowed or self._allowed).load)

    def run_to_the_end(self, *options):
        process = self.start(*options)
        report = process.communicate(timeout=200)[1]
        self.assertEqual(process.returncode, 0, report)
        return report

    def test_the_filter_ends_a_program_that_calls_something_else(self):
        process = self.start("--sensor", "sim:box?frames=3", "--lock-memory", allowed=self._allowed - {"mlockall"})
        process.communicate(timeout=60)
        self.assertLess(process.returncode, 0)

    def test_all_outputs_are_written(self):
        self.run_to_the_end("--sensor", "sim:box?frames=20&motion=fast&noise=d415", "--csv", "run.csv", "--mesh", "run.ply",
                            "--mesh-picture", "run.png", "--flow", "flow", "--record", "recording")
        for name in ["run.csv", "run.ply", "run.png", "flow", "recording"]:
            self.assertTrue(os.path.exists(os.path.join(self._folder, name)), name)
        self.run_to_the_end("--sensor", "replay:recording", "--rate", "live", "--mask-stream", "/none")

    def test_priority_processors_and_locked_memory_are_asked_for(self):
        self.run_to_the_end("--sensor", "sim:box+bottle?frames=20", "--threads", "2", "--rate", "live", "--rt-priority", "40",
                            "--cpu", "0", "--lock-memory")

    def test_signed_links_and_dds_send_and_receive(self):
        key = os.path.join(self._folder, "key")
        with open(os.open(key, os.O_CREAT | os.O_WRONLY, 0o600), "wb") as file:
            file.write(bytes(range(32)))
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as peer:
            peer.bind(("127.0.0.1", 0))
            port = peer.getsockname()[1]
            self.run_to_the_end("--sensor", "sim:box?frames=20", "--rate", "live", "--camera-pose", "1",
                                "--link", f"udp://127.0.0.1:{port}?key={key}", "--link", "dds:domain=97")
            peer.settimeout(0)
            self.assertTrue(peer.recv(2048))

    def test_settings_are_read_again_and_files_go_on_in_new_ones(self):
        settings = os.path.join(self._folder, "track.toml")
        rows = os.path.join(self._folder, "run-000001.csv")
        with open(settings, "w", encoding="utf-8") as file:
            file.write("[registration]\niterations = 8\n")
        process = self.start("--sensor", "sim:box?frames=90", "--rate", "live", "--config", settings, "--csv", "run-{n}.csv",
                             "--rotate-age", "1", "--rotate-keep", "2", "--log", "journald:/nonexistent")
        while process.poll() is None and not (os.path.exists(rows) and os.path.getsize(rows) > 3000):
            time.sleep(0.01)
        with open(settings, "w", encoding="utf-8") as file:
            file.write("[registration]\niterations = 9\n")
        process.send_signal(signal.SIGHUP)
        report = process.communicate(timeout=200)[1]
        self.assertEqual(process.returncode, 0, report)
        self.assertIn("registration.iterations = 9 (was 8)", report)
        self.assertEqual(sum(name.startswith("run-") for name in os.listdir(self._folder)), 2)

    def test_list_of_sensors_and_missing_cameras_are_said(self):
        process = self.start("--list-sensors")
        process.communicate(timeout=60)
        self.assertEqual(process.returncode, 0)
        for sensor in ["v4l2:/dev/none?K=1,1,1,1&depth_scale=1", "libcamera:97?K=1,1,1,1&depth_scale=1"]:
            process = self.start("--sensor", sensor)
            process.communicate(timeout=60)
            self.assertGreater(process.returncode, 0, sensor)

    def test_the_live_view_is_served(self):
        process = self.start("--sensor", "sim:box?frames=30", "--rate", "live", "--view", ":0", "--view-hold")
        said = ""
        while "/?token=" not in said:
            line = process.stderr.readline()
            self.assertTrue(line, said)
            said += line
        reader = threading.Thread(target=process.stderr.read)
        reader.start()
        try:
            port = int(re.search(r"http://127.0.0.1:([0-9]+)/", said).group(1))
            request = urllib.request.Request(f"http://127.0.0.1:{port}/", headers={"Cookie": f"disflow_{port}={_TOKEN}"})
            with urllib.request.urlopen(request, timeout=60) as answer:
                self.assertEqual(answer.status, 200)
        finally:
            process.terminate()
            self.assertEqual(process.wait(timeout=60), 0)
            reader.join()
            process.stderr.close()


if __name__ == "__main__":
    unit_file.need_systemd()
    _LIBRARY = ctypes.util.find_library("seccomp")
    if _LIBRARY is None:
        unit_file.skip("libseccomp is not installed (apt-get install libseccomp2)")
    unittest.main()
