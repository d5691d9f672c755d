# SPDX-License-Identifier: BSD-3-Clause
"""An emulated machine: a stock kernel, some programs, a script, and the files that it leaves."""
import io
import os
import shutil
import subprocess
import tarfile

import setting
from kernel import Unavailable
from newc import Archive

_BEGIN = """#!/bin/busybox sh
/bin/busybox --install -s /bin
export PATH=/bin
mount -t proc proc /proc
mount -t sysfs sysfs /sys
mount -t devtmpfs devtmpfs /dev
while read -r module options; do
  insmod "/modules/$module" $options || echo "no $module"
done </modules/order
cd /
"""

_INIT = _BEGIN + """
mkdir -p /run /out /tmp /dev/pts
mount -t devpts devpts /dev/pts
ip link set lo up
sh /script >/out/log 2>&1
dmesg >/out/dmesg
tar -C /out -c . | cat >"$(ls -d /dev/vport*p1)"
poweroff -f
"""

# Of a machine with a system of its own. It is in memory: waiting for a disk of QEMU's, the guest would see hours pass.
_DISK_INIT = _BEGIN + """
mkdir -p /root
mount -t ext4 -o loop /disk /root
exec switch_root /root /sbin/init
"""


class Machine:
    """How QEMU shows a computer of one architecture."""

    def __init__(self, arch):
        # Time in the guest passes by the instructions that it executes, 1 ns each (a Cortex-A53 at
        # 1.2 GHz does about as much), and costs nothing here while it waits: what the guest sees does
        # not depend on how busy this machine is.
        common = ["-nodefaults", "-no-reboot", "-display", "none", "-m", "1024", "-nic", "none",
                  "-icount", "shift=0,sleep=off", "-device", "virtio-serial-pci"]
        if arch == "amd64":
            self.program = "qemu-system-x86_64"
            self.arguments = common + ["-M", "pc"]
            self.console = "ttyS0"
        else:
            self.program = "qemu-system-aarch64"
            self.arguments = common + ["-M", "virt", "-cpu", "cortex-a53"]
            self.console = "ttyAMA0"


class Guest:
    """Filled by a test, booted once."""

    def __init__(self, kernel, folder):
        self._kernel = kernel
        self._machine = Machine(kernel.arch)
        self._folder = folder
        self._archive = Archive()
        self._modules = ["virtio_pci", "virtio_console"]
        self._options = {}
        shutil.rmtree(folder, ignore_errors=True)
        os.makedirs(folder)
        self._archive.add_file("bin/busybox", kernel.busybox)
        for name in ["proc", "sys", "dev"]:
            self._archive.add_folder(name)

    def add_modules(self, names):
        self._modules += names

    def add_options(self, module, options):
        """What the module is loaded with."""
        self._options[module] = options

    def add_file(self, name, path):
        self._archive.add_file(name, path)

    def add_text(self, name, text):
        self._archive.add_bytes(name, text.encode())

    def add_program(self, path):
        """The program as /bin/NAME, with the libraries that it needs."""
        self._archive.add_file("bin/" + os.path.basename(path), path)
        for library in libraries(self._kernel.arch, path):
            unpacked = setting.arm_root + library
            found = unpacked if self._kernel.arch == "arm64" and os.path.exists(unpacked) else library
            self._archive.add_file(library.lstrip("/"), os.path.realpath(found))

    def boot(self, script, timeout_s, serial=None, extra=()):
        """Runs the script and returns {name: bytes} of what it left in /out.

        serial: where QEMU connects the board's serial port; without it the kernel's messages go there.
        """
        self._archive.add_bytes("init", _INIT.encode(), 0o755)
        self._archive.add_bytes("script", script.encode())
        return self._run(timeout_s, serial, extra)

    def boot_disk(self, disk, timeout_s, serial):
        """Starts the system in that image of an ext4 file system, which has to write a tar archive to /dev/vport*p1.

        Returns {name: bytes} of what is in it.
        """
        self._archive.add_bytes("init", _DISK_INIT.encode(), 0o755)
        self._modules += ["loop", "crc32c_generic", "ext4"]
        self._archive.add_file("disk", disk)
        console = os.path.join(self._folder, "console.txt")
        return self._run(timeout_s, serial, ["-serial", "file:" + console, "-m", "2048"], console="ttyS1")

    def _run(self, timeout_s, serial, extra, console="hvc0"):
        files = self._kernel.modules(self._modules)
        self._archive.add_bytes("modules/order",
                                "".join(self._line_of(file) for file in files).encode())
        for file in files:
            self._archive.add_file("modules/" + os.path.basename(file), file)
        initrd = os.path.join(self._folder, "initrd")
        self._archive.write(initrd)
        output = os.path.join(self._folder, "out.tar")
        if serial is None:
            console = self._machine.console
            serial = "file:" + os.path.join(self._folder, "console.txt")
        command = [self._machine.program, *self._machine.arguments,
                   "-kernel", self._kernel.image, "-initrd", initrd,
                   "-append", "console=" + console + " panic=-1 quiet", "-serial", serial,
                   "-chardev", "file,id=out,path=" + output,
                   "-device", "virtserialport,chardev=out,name=out",
                   *extra]
        try:
            result = subprocess.run(command, timeout=timeout_s, capture_output=True, text=True,
                                    check=False)
        except FileNotFoundError as error:
            raise Unavailable(self._machine.program + " is not installed") from error
        if result.returncode != 0:
            raise RuntimeError("QEMU: " + result.stderr)
        return self._read(output)

    def _line_of(self, file):
        name = os.path.basename(file)
        return name + " " + self._options.get(name.split(".")[0], "") + "\n"

    @staticmethod
    def _read(path):
        with open(path, "rb") as file:
            data = file.read()
        with tarfile.open(fileobj=io.BytesIO(data)) as tar:
            return {os.path.normpath(member.name): tar.extractfile(member).read()
                    for member in tar if member.isfile()}


def libraries(arch, program):
    """Paths of the shared libraries and of the loader, as the program sees them."""
    command = ["ldd", program]
    if arch == "arm64":
        command = ["qemu-aarch64", "-L", setting.arm_root, setting.arm_root + "/lib/ld-linux-aarch64.so.1", "--list", program]
    listing = subprocess.run(command, capture_output=True, text=True, check=False)
    if listing.returncode != 0:
        return []  # static
    paths = []
    for line in listing.stdout.splitlines():
        for word in line.split():
            if word.startswith("/"):
                paths.append(word)
    return paths
