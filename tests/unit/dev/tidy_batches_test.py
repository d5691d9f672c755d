#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Which sources clang-tidy reads together."""
import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

import tidy_batches

_PROGRAM = pathlib.Path(__file__).with_name("tidy_batches.py")


def entry(folder, source, target="a", flags="-O3", file=None):
    path = file or f"{folder}/{source}"
    return {
        "directory": folder, "file": path,
        "command": f"c++ {flags} -Winvalid-pch -include {folder}/cmake_pch.hxx -o {target}/CMakeFiles/{target}.dir/{source}.o -c {path}",
    }


class TidyBatches(unittest.TestCase):
    def setUp(self):
        holder = tempfile.TemporaryDirectory()
        self.addCleanup(holder.cleanup)
        self.folder = pathlib.Path(holder.name).resolve()

    def batches(self, database, chosen=None):
        """Names of what is read: of batches those of their sources."""
        build = self.folder / "build"
        build.mkdir(exist_ok=True)
        (build / "compile_commands.json").write_text(json.dumps(database), encoding="utf-8")
        names = chosen or [pathlib.Path(one["file"]) for one in database]
        run = subprocess.run(
            [sys.executable, "-B", _PROGRAM, build, self.folder / "lint"], check=True, capture_output=True, text=True,
            input="".join(f"{self.folder / name}\n" for name in names))
        self.said = run.stderr
        known = {one["file"]: one for one in json.loads((self.folder / "lint" / "compile_commands.json").read_text())}
        read = []
        for name in run.stdout.split():
            if "together_" in name:
                self.assertTrue(known[name]["command"].endswith(f"-c {name}"), known[name]["command"])
                self.assertNotIn("cmake_pch", known[name]["command"])
                read.append([pathlib.Path(one).name for one in tidy_batches._INCLUDE.findall(pathlib.Path(name).read_text())])
            else:
                read.append(pathlib.Path(name).name)
        return read

    def sources(self, count, target="a", flags="-O3"):
        return [entry(str(self.folder), f"{target}{i}.cc", target, flags) for i in range(count)]

    def test_eight_sources_of_a_target_are_read_together(self):
        self.assertEqual(self.batches(self.sources(9)), [[f"a{i}.cc" for i in range(8)], "a8.cc"])

    def test_targets_are_not_mixed(self):
        self.assertEqual(self.batches(self.sources(2) + self.sources(2, "b")), [["a0.cc", "a1.cc"], ["b0.cc", "b1.cc"]])

    def test_sources_with_options_of_their_own_are_alone(self):
        database = self.sources(3)
        database[1]["command"] += " -DOTHER"
        self.assertEqual(self.batches(database), ["a0.cc", "a1.cc", "a2.cc"])

    def test_a_few_chosen_ones_are_with_no_others_than_when_all_are(self):
        self.assertEqual(self.batches(self.sources(10), ["a6.cc", "a7.cc", "a8.cc"]), [["a6.cc", "a7.cc"], "a8.cc"])

    def test_what_several_targets_compile_is_read_once(self):
        self.assertEqual(self.batches(self.sources(2) + self.sources(2, flags="-O0")), [["a0.cc", "a1.cc"]])

    def test_what_the_build_has_together_is_together_by_its_own_names_and_what_it_has_alone_is_alone(self):
        unity = self.folder / "Unity"
        unity.mkdir()
        file = unity / "unity_0_cxx.cxx"
        file.write_text("".join(f'#include "{self.folder}/a{i}.cc"\n' for i in range(2)), encoding="utf-8")
        together = entry(str(self.folder), "unity_0_cxx.cxx", file=str(file))
        alone = [entry(str(self.folder), name) for name in ("a8.cc", "a9.cc")]
        self.assertEqual(
            self.batches([*alone, together], ["a0.cc", "a1.cc", "a8.cc", "a9.cc"]), ["a8.cc", "a9.cc", ["a0.cc", "a1.cc"]])

    def test_a_source_that_the_build_does_not_compile_is_left_out_and_named(self):
        self.assertEqual(self.batches(self.sources(1), ["a0.cc", "board.cc"]), ["a0.cc"])
        self.assertIn("board.cc", self.said)
        self.assertNotIn("a0.cc", self.said)

    def test_files_of_a_run_before_are_gone(self):
        self.batches(self.sources(16))
        self.batches(self.sources(2))
        self.assertEqual([file.name for file in (self.folder / "lint").glob("*.cc")], ["together_0.cc"])


if __name__ == "__main__":
    unittest.main()
