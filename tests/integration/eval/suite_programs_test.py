# SPDX-License-Identifier: BSD-3-Clause
"""The suite with the programs of this build: DISFLOW_BIN is their folder."""

import json
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[3] / "tests" / "bench" / "suite"))

import ablation
import main
import runs

BIN = pathlib.Path(os.environ["DISFLOW_BIN"])


class Programs(unittest.TestCase):
    def test_every_setting_of_the_ablation_exists_and_is_in_range(self):
        for variant in ablation.VARIANTS:
            words = [BIN / "disflow_track", "--print-config"]
            for setting in variant.settings:
                words += ["--set", setting]
            done = subprocess.run(words, capture_output=True, text=True, check=False)
            self.assertEqual(done.returncode, 0, f"{variant.name}: {done.stderr}")

    def test_every_variant_differs_from_the_defaults(self):
        defaults = subprocess.run([BIN / "disflow_track", "--print-config"], capture_output=True, check=True).stdout
        for variant in ablation.VARIANTS:
            words = [BIN / "disflow_track", "--print-config"]
            for setting in variant.settings:
                words += ["--set", setting]
            text = subprocess.run(words, capture_output=True, check=True).stdout
            self.assertEqual(text == defaults, not variant.settings, variant.name)

    def test_one_row_is_tracked_judged_and_written(self):
        with tempfile.TemporaryDirectory() as folder:
            status = main.main(
                ["accuracy", "--quick", "--only", "bottle, fast, clean", "--bin", str(BIN), "--out", folder]
            )
            self.assertEqual(status, 0)
            data = json.loads((pathlib.Path(folder) / "results.json").read_text(encoding="utf-8"))
            self.assertEqual(list(data["rows"]), ["bottle, fast, clean"])
            run = data["rows"]["bottle, fast, clean"]["seeds"]["1"]
            self.assertGreater(run["add_auc"], 95.0)
            self.assertIsNotNone(run["pose_nees"])
            self.assertGreater(data["tracker_bytes"], 100000)

    def test_a_sequence_by_lot_is_tracked_and_compared_with_a_run_before(self):
        with tempfile.TemporaryDirectory() as folder:
            results = pathlib.Path(folder) / "results.json"
            words = ["lot", "--seeds", "3", "--bin", str(BIN), "--out", folder, "--docs", folder]
            self.assertEqual(main.main(words + ["--set", "field.fuse_budget=290"]), 0)
            run = json.loads(results.read_text(encoding="utf-8"))["3"]
            self.assertGreater(run["add_auc"], 90.0)
            self.assertEqual(main.main(words + ["--against", str(results)]), 0)

    def test_kept_frames_give_the_figures_of_simulated_ones(self):
        with tempfile.TemporaryDirectory() as folder:
            root = pathlib.Path(folder)
            job = runs.Job("a", "mug?motion=fast&noise=d415&frames=40&mask=sloppy&fps=15", 2)
            plain = runs.Programs(BIN, root / "plain").track(job)
            for time in ("first", "second"):
                programs = runs.Programs(BIN, root / time, frames_dir=root / "frames")
                figures = programs.track(job)
                for name in ("add_auc", "v", "e_a", "lost"):
                    self.assertEqual(figures[name], plain[name], f"{name}, {time} time")
            self.assertEqual([kept.name for kept in (root / "frames").iterdir()], [job.frames])

    def test_program_that_fails_ends_the_suite_with_its_message(self):
        with tempfile.TemporaryDirectory() as folder:
            programs = runs.Programs(BIN, folder)
            job = runs.Job("a", "box?motion=fast", 1, ("no.such=1",))
            with self.assertRaisesRegex(RuntimeError, "no.such"):
                programs.track(job)


if __name__ == "__main__":
    unittest.main()
