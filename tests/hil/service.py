# SPDX-License-Identifier: BSD-3-Clause
"""The Debian package as a service of a real systemd: the unit's restrictions are in force and keep it from nothing."""
import glob
import os
import re
import shutil
import subprocess
import unittest

import setting
from guest import Guest
from live import GuestOutput, make_kernel, rows_of
from sequences import Sequence

_FRAMES = 60
_TOKEN = "correct-horse-battery"
_VIDEO = ["vhci_hcd", "uvcvideo", "videodev", "mc"]
_SYSTEM = ["systemd", "systemd-sysv", "udev", "kmod"]

_SIMULATED = """
[run]
sensor = "sim:box?width=320&height=240&frames=100000"
rate = "live"
link = ["serial:///dev/ttyS0?baud=115200&key=/var/lib/disflow/link.key", "udp://127.0.0.1:14550", "dds:domain=0&interface=lo"]
view = ":8080"
rt_priority = 40
lock_memory = true
cpu = [0]
csv = "run.csv"
mask_stream = "/masks"
"""

_CAMERA = """
[run]
sensor = "v4l2:/dev/video0?format=Z16&depth_scale=0.001&intrinsics=/etc/disflow/camera.toml"
csv = "camera.csv"
rt_priority = 40
lock_memory = true
"""

# Runs as root, beside the service, at the end of the start.
_SCRIPT = """#!/bin/bash
exec >/out/log 2>&1
state=/var/lib/private/disflow
main() { systemctl show --property MainPID --value disflow-track; }
ask() { # ask PATH COOKIE: the first line of the live view's answer
  exec 9<>/dev/tcp/127.0.0.1/8080
  printf 'GET %s HTTP/1.1\\r\\nHost: localhost:8080\\r\\nCookie: %s\\r\\n\\r\\n' "$1" "$2" >&9
  timeout 5 head -n 1 <&9
  exec 9>&-
}

cp /root/simulated.toml /etc/disflow/track.toml
systemctl start disflow-track
echo "started without its key: $?"
# The key has to belong to the user that systemd made up.
install -m 600 -o "$(stat -c %u $state)" /root/link.key $state/link.key
systemctl start disflow-track
echo "started again: $?"
sleep 3
cp "/proc/$(main)/status" /out/status
chrt --all-tasks --pid "$(main)" >/out/scheduling
cat "/proc/$(main)/limits" >/out/limits
echo "view without token: $(ask / '')"
echo "view with token: $(ask / disflow_8080=@TOKEN@)"
systemctl show --property StatusText,NRestarts disflow-track
echo hanging
kill -STOP "$(main | grep -v "^0$")"
sleep 15
systemctl show --property ActiveState,NRestarts disflow-track
systemctl stop disflow-track
ls -lnR $state >/out/files

cp /root/camera.toml /etc/disflow/track.toml
modprobe --all vhci_hcd uvcvideo
/root/hil_usb_camera /root/frames --played /run/played & camera=$!
for i in $(seq 100); do [ -e /dev/video0 ] && break; sleep 0.05; done
udevadm settle
systemctl start disflow-track
echo "camera: $?"
for i in $(seq 600); do [ -e /run/played ] && break; sleep 0.05; done
sleep 0.5
systemctl stop disflow-track
kill "$camera"
cp $state/camera.csv /out/camera.csv

# Another program under the unit's restrictions tries what a break-in would try.
mkdir -p /etc/systemd/system/disflow-track.service.d
printf '[Service]\\nType=oneshot\\nRestart=no\\nExecStart=\\nExecStart=/bin/bash /usr/local/try\\n' \\
  >/etc/systemd/system/disflow-track.service.d/try.conf
systemctl daemon-reload
systemctl start disflow-track
journalctl --unit disflow-track --output cat >/out/journal
dmesg >/out/dmesg
"""

_TRY = """
try() { if "$@" 2>/dev/null >/dev/null; then echo "could: $*"; else echo "could not: $*"; fi; }
try touch /usr/try
try touch /etc/disflow/track.toml
try cat /etc/disflow/track.env
try cat /proc/1/status
try head -c 1 /dev/vda
try head -c 1 /dev/kmsg
try unshare --user true
try mount -t tmpfs none /tmp
try chown 1:1 /var/lib/disflow
try ls /root
try touch /var/lib/disflow/mine
try test -r /dev/shm
"""

_UNIT = """
[Unit]
After=systemd-udev-settle.service
Wants=systemd-udev-settle.service
[Service]
Type=oneshot
StandardOutput=tty
ExecStart=-/bin/bash /root/script
ExecStart=/bin/bash -c 'tar -C /out -c . | cat >/dev/vport*p1'
ExecStopPost=/sbin/poweroff --force --force
[Install]
WantedBy=multi-user.target
"""


def _make_root(root, package, kernel):
    """What the package says it needs, and a system to run it."""
    depends = subprocess.run(["dpkg-deb", "-f", package, "Depends"], check=True, capture_output=True, text=True).stdout
    names = [item.split()[0] for item in depends.split(",")]
    with open("/etc/os-release", encoding="utf-8") as file:
        suite = next(line.partition("=")[2].strip() for line in file if line.startswith("VERSION_CODENAME="))
    shutil.rmtree(root, ignore_errors=True)
    subprocess.run(["mmdebstrap", "--quiet", "--variant=essential", "--include=" + ",".join(_SYSTEM + names), suite, root],
                   check=True, capture_output=True)
    shutil.copy(package, os.path.join(root, "tmp", "disflow.deb"))
    subprocess.run(["chroot", root, "dpkg", "--install", "/tmp/disflow.deb"], check=True, capture_output=True)
    modules = os.path.join(root, "lib", "modules", kernel.release, "kernel")
    os.makedirs(modules)
    for file in kernel.modules(_VIDEO):
        shutil.copy(file, modules)
    subprocess.run(["depmod", "-b", root, kernel.release], check=True, capture_output=True)
    for folder in ["usr/share/doc", "usr/share/locale", "usr/share/man", "var/cache/apt", "var/lib/apt/lists"]:
        shutil.rmtree(os.path.join(root, folder), ignore_errors=True)
    subprocess.run(["chroot", root, "systemctl", "mask", "getty.target", "systemd-timesyncd.service"], check=True,
                   capture_output=True)


def _write(root, name, content, mode=0o644):
    path = os.path.join(root, name)
    os.makedirs(os.path.dirname(path), exist_ok=True)
    with open(path, "wb") as file:
        file.write(content if isinstance(content, bytes) else content.encode())
    os.chmod(path, mode)


class Service(GuestOutput, unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        packages = glob.glob(os.path.join(setting.programs, "..", "package", "disflow_*_amd64.deb"))
        if not packages:
            raise unittest.SkipTest("no package for amd64; ./dev package makes it")
        for program in ["mmdebstrap", "mke2fs"]:
            if shutil.which(program) is None:
                raise unittest.SkipTest(program + " is not installed")
        if os.geteuid() != 0:
            raise unittest.SkipTest("only root can make the files of a system")
        kernel = make_kernel("amd64")
        cls.sequence = Sequence(setting.programs, os.path.join(setting.folder, "box_service"), frames=_FRAMES)
        folder = os.path.join(setting.folder, "service")
        guest = Guest(kernel, folder)
        root = os.path.join(folder, "root")
        _make_root(root, packages[0], kernel)
        _write(root, "etc/disflow/track.env", f"DISFLOW_VIEW_TOKEN={_TOKEN}\n", 0o600)
        _write(root, "etc/disflow/camera.toml", cls.sequence.camera_file())
        _write(root, "root/simulated.toml", _SIMULATED)
        _write(root, "root/camera.toml", _CAMERA)
        _write(root, "root/link.key", bytes(range(32)), 0o600)
        _write(root, "root/script", _SCRIPT.replace("@TOKEN@", _TOKEN))
        _write(root, "usr/local/try", _TRY)
        _write(root, "etc/systemd/system/try-it.service", _UNIT)
        os.symlink("/etc/systemd/system/try-it.service",
                   os.path.join(root, "etc/systemd/system/multi-user.target.wants/try-it.service"))
        os.makedirs(os.path.join(root, "out"))
        shutil.copy(cls.sequence.raw, os.path.join(root, "root", "frames"))
        shutil.copy(os.path.join(setting.programs, "hil_usb_camera"), os.path.join(root, "root"))
        disk = os.path.join(folder, "disk")
        subprocess.run(["mke2fs", "-q", "-t", "ext4", "-d", root, disk, "400M"], check=True, capture_output=True)
        shutil.rmtree(root)
        cls.uart = os.path.join(folder, "uart.bin")
        cls.out = guest.boot_disk(disk, timeout_s=900, serial="file:" + cls.uart)
        os.remove(disk)

    def after(self, name):
        """What the script noted after NAME."""
        lines = [line for line in self.text("log").splitlines() if line.startswith(name + ": ")]
        self.assertEqual(len(lines), 1, self.text("log") + self.text("journal"))
        return lines[0][len(name) + 2:]

    def status(self, name):
        """Of the kernel's account of the process."""
        return next(line.split(":")[1].strip() for line in self.text("status").splitlines() if line.startswith(name + ":"))

    def test_service_starts_as_soon_as_its_user_has_the_key(self):
        self.assertEqual(self.after("started without its key"), "1")
        self.assertEqual(self.after("started again"), "0")
        self.assertIn("link.key: cannot read the signing key", self.text("journal"))

    def test_restrictions_are_in_force(self):
        for name in ["CapPrm", "CapEff", "CapBnd", "CapAmb"]:
            self.assertEqual(int(self.status(name), 16), 0, name)
        self.assertEqual(self.status("NoNewPrivs"), "1")
        self.assertEqual(self.status("Seccomp"), "2")
        self.assertNotIn("0", self.status("Uid").split())
        self.assertGreater(int(self.status("Uid").split()[0]), 60000)

    def test_priority_and_locked_memory_are_granted(self):
        self.assertIn("SCHED_FIFO", self.text("scheduling"))
        self.assertIn("priority: 40", self.text("scheduling"))
        self.assertGreater(int(self.status("VmLck").split()[0]), 1000)
        self.assertNotIn("refused; grant it", self.text("journal"))

    def test_links_view_and_files_work(self):
        for link in ["serial:///dev/ttyS0", "udp://127.0.0.1:14550", "dds:domain=0"]:
            sent = re.search(re.escape(link) + r"\S* (\d+) messages sent", self.text("journal"))
            self.assertIsNotNone(sent, link + "\n" + self.text("journal"))
            self.assertGreater(int(sent.group(1)), 0, link)
        self.assertGreater(os.path.getsize(self.uart), 1000)
        self.assertIn(" 401 ", self.after("view without token"))
        self.assertIn(" 200 ", self.after("view with token"))
        for name in ["run.csv", "link.key"]:
            self.assertRegex(self.text("files"), rf"-rw------- .* {re.escape(name)}")

    def test_hanging_program_is_restarted_by_the_watchdog(self):
        self.assertIn("Watchdog timeout", self.text("journal"))
        states = self.text("log").split("hanging")[1]
        self.assertIn("ActiveState=active", states)
        self.assertIn("NRestarts=1", states)

    def test_camera_is_read(self):
        self.assertEqual(self.after("camera"), "0")
        rows = rows_of(self.out["camera.csv"])
        self.assertGreater(len(rows), _FRAMES // 2)
        self.assertGreater(sum(row["state"] == "tracking" for row in rows), len(rows) // 2)

    def test_a_break_in_could_do_little(self):
        journal = self.text("journal").splitlines()
        done = {line.partition(": ")[2] for line in journal if line.startswith("could: ")}
        refused = {line.partition(": ")[2] for line in journal if line.startswith("could not: ")}
        self.assertEqual(done, {"touch /var/lib/disflow/mine", "test -r /dev/shm"})
        self.assertEqual(len(refused), 10, refused)
