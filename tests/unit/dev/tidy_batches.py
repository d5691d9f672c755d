#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""What clang-tidy is to read instead of some sources: tidy_batches.py BUILD OUT, names of sources on standard input

Sources that the build compiles together (cmake/precompiled.cmake), or could, are read together: their headers are most of
what clang-tidy reads, and eight sources have them in common. OUT gets these files and the compile_commands.json of all;
names of what is to be read go to standard output. Sources that BUILD does not compile are left out, and named.
"""
import itertools
import json
import pathlib
import re
import sys

# As cmake/precompiled.cmake has it: what compiles together there has no names twice.
_TOGETHER = 8
# What clang-tidy does not know: precompiled headers of GCC, and a warning of its.
_UNKNOWN = re.compile(r" -include \S*/cmake_pch\.hxx| -Wno-subobject-linkage")
_INCLUDE = re.compile(r'^#include "(.*)"', re.MULTILINE)


def target(entry):
    found = re.search(r" -o (\S+?\.dir)/", entry["command"])
    return found and found[1]


def is_together(entry):
    return pathlib.Path(entry["file"]).parent.name == "Unity"


def sources(entry):
    return _INCLUDE.findall(pathlib.Path(entry["file"]).read_text(encoding="utf-8")) if is_together(entry) else [entry["file"]]


def one_by_one(database):
    """Entries of a compilation database, each source once, however many targets compile it, and those that are compiled
    together one by one; and for each source what it may be read together with."""
    entries, units = {}, {}
    grouped = {target(entry) for entry in database if is_together(entry)}
    for entry in database:
        for source in sources(entry):
            if source in entries:
                continue
            command = _UNKNOWN.sub("", entry["command"]).replace(entry["file"], source)
            entries[source] = {**entry, "file": source, "command": command}
            # Where the build has some together, as it has them; otherwise what is compiled alike.
            alike = re.sub(r" -(o|MF|MT) \S+", "", command.replace(source, ""))
            units[source] = entry["file"] if target(entry) in grouped else (target(entry), entry["directory"], alike)
    return list(entries.values()), units


def batches(entries, units, chosen):
    """Lists of the entries that are chosen, of sources that go together, in the database's order."""
    result = []
    for _, run in itertools.groupby(entries, key=lambda entry: units[entry["file"]]):
        unit = list(run)
        # Cut before it is chosen from, so that a few that are chosen are never with those with which the build has not
        # compiled them.
        for first in range(0, len(unit), _TOGETHER):
            result.append([entry for entry in unit[first:first + _TOGETHER] if entry["file"] in chosen])
    return [batch for batch in result if batch]


def read_together(batch, file):
    """Writes the file that includes a batch. @return Its entry."""
    first = batch[0]
    lines = (f'#include "{entry["file"]}"  // NOLINT(bugprone-suspicious-include)\n' for entry in batch)
    file.write_text("".join(lines), encoding="utf-8")
    return {**first, "file": str(file), "command": first["command"].replace(first["file"], str(file))}


def main():
    build, out = map(pathlib.Path, sys.argv[1:])
    chosen = {str(pathlib.Path(line.strip()).resolve()) for line in sys.stdin if line.strip()}
    entries, units = one_by_one(json.loads((build / "compile_commands.json").read_text(encoding="utf-8")))
    out.mkdir(parents=True, exist_ok=True)
    for old in out.glob("together_*.cc"):
        old.unlink()
    # Without the options that it is compiled with clang-tidy guesses: of boards' sources wrongly.
    unknown = sorted(chosen - {entry["file"] for entry in entries})
    if unknown:
        print(f"not read, since {build} does not compile them: {' '.join(unknown)}", file=sys.stderr)
    names = []
    for number, batch in enumerate(batches(entries, units, chosen)):
        if len(batch) > 1:
            entries.append(read_together(batch, (out / f"together_{number}.cc").resolve()))
            names.append(entries[-1]["file"])
        else:
            names.append(batch[0]["file"])
    (out / "compile_commands.json").write_text(json.dumps(entries), encoding="utf-8")
    for name in names:
        print(name)


if __name__ == "__main__":
    main()
