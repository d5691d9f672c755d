# SPDX-License-Identifier: BSD-3-Clause
"""Debian's stock kernels and busybox, fetched once into the build folder and unpacked there."""
import glob
import lzma
import os
import shutil
import subprocess

_XZ_MAGIC = b"\xfd7zXZ\0"


class Unavailable(Exception):
    """Something that the tests need is not available here; they are skipped."""


class Kernel:
    """A kernel image and modules for one architecture (Debian's name: amd64, arm64)."""

    def __init__(self, arch, cache):
        self.arch = arch
        self._root = os.path.join(cache, arch)
        if not os.path.exists(os.path.join(self._root, "complete")):
            self._fetch(os.path.join(cache, "packages-" + arch))
        self.release = os.listdir(os.path.join(self._root, "lib", "modules"))[0]
        self._modules = os.path.join(self._root, "lib", "modules", self.release)
        self._depends = self._read_dependencies()

    @property
    def image(self):
        return os.path.join(self._root, "kernel")

    @property
    def busybox(self):
        return os.path.join(self._root, "bin", "busybox")

    def modules(self, names):
        """Files of the modules and of all that they need, in the order of loading."""
        order = []
        for name in names:
            path = self._path_of(name)
            if path is None:
                continue  # built in
            for part in reversed([path] + self._depends[path]):
                if part not in order:
                    order.append(part)
        return [os.path.join(self._modules, part) for part in order]

    def _path_of(self, name):
        for path in self._depends:
            if os.path.basename(path).split(".ko")[0].replace("-", "_") == name.replace("-", "_"):
                return path
        return None

    def _read_dependencies(self):
        depends = {}
        with open(os.path.join(self._modules, "modules.dep"), encoding="ascii") as file:
            for line in file:
                path, _, needed = line.partition(":")
                depends[path] = needed.split()
        return depends

    def _fetch(self, folder):
        shutil.rmtree(folder, ignore_errors=True)
        shutil.rmtree(self._root, ignore_errors=True)
        os.makedirs(folder)
        image = _image_package(self.arch)
        _run(["apt-get", "download", "-qq", image, "busybox-static:" + self.arch], cwd=folder)
        for package in glob.glob(os.path.join(folder, "*.deb")):
            _run(["dpkg-deb", "-x", package, self._root])
        release = os.listdir(os.path.join(self._root, "lib", "modules"))[0]
        _run(["depmod", "-b", self._root, release])
        packed = os.path.join(self._root, "boot", "vmlinuz-" + release)
        with open(self.image, "wb") as file:
            file.write(_unpacked(packed))
        shutil.rmtree(folder)
        with open(os.path.join(self._root, "complete"), "w", encoding="ascii"):
            pass


def _image_package(arch):
    """The package with the image itself, which the meta-package depends on."""
    output = _run(["apt-cache", "depends", "linux-image-" + arch + ":" + arch])
    for line in output.splitlines():
        relation, _, name = line.strip().partition(": ")
        if relation == "Depends" and name.startswith("linux-image-"):
            return name if ":" in name else name + ":" + arch
    raise Unavailable("apt knows no linux-image-" + arch + " (for another architecture: "
                      "dpkg --add-architecture " + arch + ", apt-get update)")


def _unpacked(path):
    """The ELF inside of an x86 bzImage, which starts sooner; other images as they are."""
    with open(path, "rb") as file:
        data = file.read()
    start = data.find(_XZ_MAGIC)
    if start < 0 or data[0x202:0x206] == b"" or data[510:512] != b"\x55\xaa":
        return data
    return lzma.LZMADecompressor(format=lzma.FORMAT_XZ).decompress(data[start:])


def _run(command, cwd=None):
    try:
        result = subprocess.run(command, cwd=cwd, capture_output=True, text=True, check=True)
    except FileNotFoundError as error:
        raise Unavailable(command[0] + " is not installed") from error
    except subprocess.CalledProcessError as error:
        raise Unavailable(" ".join(command) + ": " + error.stderr.strip()) from error
    return result.stdout
