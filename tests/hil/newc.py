# SPDX-License-Identifier: BSD-3-Clause
"""A file system in the cpio format that Linux unpacks at start ("newc")."""
import os
import stat

_ALIGNMENT = 4


class Archive:
    """Collects files, folders and links; the last one of a name wins."""

    def __init__(self):
        self._entries = {}

    def add_bytes(self, name, data, mode=0o644):
        self._add_parents(name)
        self._entries[name] = (stat.S_IFREG | mode, data)

    def add_file(self, name, path):
        with open(path, "rb") as file:
            self.add_bytes(name, file.read(), os.stat(path).st_mode & 0o777)

    def add_folder(self, name):
        self._add_parents(name)
        self._entries.setdefault(name, (stat.S_IFDIR | 0o755, b""))

    def write(self, path):
        with open(path, "wb") as file:
            for inode, name in enumerate(sorted(self._entries), start=1):
                mode, data = self._entries[name]
                file.write(_entry(inode, name, mode, data))
            file.write(_entry(0, "TRAILER!!!", 0, b""))

    def _add_parents(self, name):
        parent = os.path.dirname(name)
        if parent:
            self.add_folder(parent)


def _entry(inode, name, mode, data):
    name_bytes = name.encode() + b"\0"
    fields = [inode, mode, 0, 0, 1, 0, len(data), 0, 0, 0, 0, len(name_bytes), 0]
    head = b"070701" + b"".join(b"%08X" % field for field in fields) + name_bytes
    return _padded(head) + _padded(data)


def _padded(data):
    return data + b"\0" * (-len(data) % _ALIGNMENT)
