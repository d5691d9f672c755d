# SPDX-License-Identifier: BSD-3-Clause
"""What the tests of the systemd unit share: reading it, and leaving if systemd's tools are missing."""
import os
import shutil
import subprocess
import sys

SKIPPED = 77


def skip(reason):
    print("skipped: " + reason)
    sys.exit(SKIPPED)


def need_systemd():
    if shutil.which("systemd-analyze") is None:
        skip("systemd-analyze is not installed (apt-get install systemd)")


def analyze(*arguments):
    """systemd-analyze's status and what it says."""
    environment = dict(os.environ, LC_ALL="C.UTF-8", SYSTEMD_COLORS="0", SYSTEMD_PAGER="cat")
    result = subprocess.run(["systemd-analyze", *arguments], capture_output=True, text=True, check=False, env=environment)
    return result.returncode, result.stdout + result.stderr


def values_of(unit, key):
    """All values that the unit gives to a setting, in their order."""
    values = []
    with open(unit, encoding="utf-8") as file:
        for line in file:
            name, _, value = line.strip().partition("=")
            if name == key:
                values.append(value)
    return values


def calls_of(name):
    """System calls of a group, those of groups in it included; a call's own name stands for itself."""
    if not name.startswith("@"):
        return {name}
    calls = set()
    for line in analyze("syscall-filter", name)[1].splitlines()[1:]:
        item = line.strip()
        if item and not item.startswith("#"):
            calls |= calls_of(item)
    return calls


def allowed_calls(unit):
    """As systemd adds up SystemCallFilter=; what every process needs to start (@default) is always among it."""
    allowed = calls_of("@default")
    for value in values_of(unit, "SystemCallFilter"):
        calls = set().union(*(calls_of(item) for item in value.removeprefix("~").split()))
        allowed = allowed - calls if value.startswith("~") else allowed | calls
    return allowed
