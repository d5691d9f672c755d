# SPDX-License-Identifier: BSD-3-Clause
"""What disflow_eval writes for others, judged by figures made here from those files alone: DISFLOW_BIN is the programs' folder."""

import csv
import json
import math
import os
import pathlib
import random
import subprocess
import tempfile
import unittest

BIN = pathlib.Path(os.environ["DISFLOW_BIN"])
FRAMES = 60
OPTIONS = {"object": "box", "motion": "fast", "noise": "d415", "seed": "3", "frames": str(FRAMES), "width": "320", "height": "180"}


def run(program, *words):
    done = subprocess.run([BIN / program, *map(str, words)], capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise AssertionError(f"{program} ended with {done.returncode}: {done.stderr}")
    return done.stdout


def rotation_of(x, y, z, w):
    return [
        [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
        [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
        [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
    ]


def moved(pose, point):
    rotation, translation = pose
    return [sum(r * p for r, p in zip(row, point)) + t for row, t in zip(rotation, translation)]


def truth_of(sequence):
    """gt/poses.txt: x y z, axis, angle."""
    poses = []
    for line in (sequence / "gt/poses.txt").read_text().splitlines():
        x, y, z, ax, ay, az, angle = map(float, line.split())
        s = math.sin(angle / 2)
        poses.append((rotation_of(ax * s, ay * s, az * s, math.cos(angle / 2)), [x, y, z]))
    return poses


def read_tum(path):
    rows = [list(map(float, line.split())) for line in path.read_text().splitlines() if not line.startswith("#")]
    return {stamp: (rotation_of(*q), t) for stamp, *rest in rows for t, q in [(rest[:3], rest[3:])]}


def read_bop(path):
    with open(path, encoding="ascii") as file:
        rows = list(csv.DictReader(file))
    poses = {}
    for row in rows:
        r = list(map(float, row["R"].split()))
        poses[int(row["im_id"])] = ([r[0:3], r[3:6], r[6:9]], [float(v) / 1000 for v in row["t"].split()])
    return poses, rows


def figures(estimated, truth, points):
    """estimated: {frame: pose}. The paper's section VI."""
    add, e_t, e_a = [], [], []
    for frame, pose in estimated.items():
        true = truth[frame]
        add.append(sum(math.dist(moved(pose, p), moved(true, p)) for p in points) / len(points))
        e_t.append(math.dist(pose[1], true[1]))
        trace = sum(a * b for rows in zip(pose[0], true[0]) for a, b in zip(*rows))
        e_a.append(math.degrees(math.acos(max(-1.0, min(1.0, (trace - 1) / 2)))))
    rms = lambda values: math.sqrt(sum(v * v for v in values) / len(values))
    return {
        "add_auc_percent": 100 * sum(max(0.0, 1 - a / 0.1) for a in add) / len(truth),
        "translation_m": rms(e_t),
        "rotation_deg": rms(e_a),
    }


class Research(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.scratch = tempfile.TemporaryDirectory()
        cls.folder = pathlib.Path(cls.scratch.name)
        cls.sequence = cls.folder / "000048"
        words = [word for key, value in OPTIONS.items() for word in (f"--{key}", value)]
        run("disflow_sim", *words, cls.sequence)
        cls.csv = cls.folder / "run.csv"
        run("disflow_track", "--sensor", f"replay:{cls.sequence}", "--csv", cls.csv, "--headless")
        cls.other = cls.folder / "other.csv"
        run("disflow_track", "--sensor", f"replay:{cls.sequence}", "--csv", cls.other, "--headless", "--profile", "dense")
        chance = random.Random(1)
        cls.points = [[chance.uniform(-0.1, 0.1) for _ in range(3)] for _ in range(40)]
        cls.model = cls.folder / "model.xyz"
        cls.model.write_text("".join(f"{x} {y} {z}\n" for x, y, z in cls.points))
        cls.printed = cls.evaluate(
            cls.csv, "own", "--tum", cls.folder / "tum.txt", "--tum-truth", cls.folder / "truth.txt", "--bop", cls.folder / "bop.csv",
            "--latex", cls.folder / "table.tex", "--compare", cls.other,
        )
        cls.own = cls.report("own")
        cls.truth = truth_of(cls.sequence)

    @classmethod
    def tearDownClass(cls):
        cls.scratch.cleanup()

    @classmethod
    def evaluate(cls, trajectory, name, *more):
        return run("disflow_eval", cls.sequence, "--csv", trajectory, "--model", cls.model, "--json", cls.folder / f"{name}.json", *more)

    @classmethod
    def report(cls, name):
        return json.loads((cls.folder / f"{name}.json").read_text())

    def compare(self, found):
        self.assertAlmostEqual(found["add_auc_percent"], self.own["add_auc_percent"], delta=2e-3)
        self.assertAlmostEqual(found["translation_m"], self.own["translation_m"]["rmse"], delta=1e-6)
        self.assertAlmostEqual(found["rotation_deg"], self.own["rotation_deg"]["rmse"], delta=1e-3)

    def test_all_frames_were_measured_so_that_figures_can_be_equal(self):
        self.assertEqual(self.own["frames"], {**self.own["frames"], "lost": 0, "missing": 0, "estimated": FRAMES})
        self.assertGreater(self.own["translation_m"]["rmse"], 1e-5)

    def test_tum_files_give_the_same_figures(self):
        estimated = read_tum(self.folder / "tum.txt")
        true = read_tum(self.folder / "truth.txt")
        self.assertEqual(list(true), sorted(true))
        frames = {stamp: i for i, stamp in enumerate(true)}
        self.compare(figures({frames[s]: pose for s, pose in estimated.items()}, self.truth, self.points))
        self.compare(figures({frames[s]: pose for s, pose in estimated.items()}, list(true.values()), self.points))

    def test_bop_results_give_the_same_figures(self):
        poses, rows = read_bop(self.folder / "bop.csv")
        self.compare(figures(poses, self.truth, self.points))
        self.assertEqual({(row["scene_id"], row["obj_id"]) for row in rows}, {("48", "1")})
        self.assertTrue(all(0 < float(row["time"]) < 1 for row in rows))

    def test_what_was_written_is_read_with_the_same_figures(self):
        for name in ("tum.txt", "bop.csv"):
            self.evaluate(self.folder / name, name)
            again = self.report(name)
            self.compare({**again, "translation_m": again["translation_m"]["rmse"], "rotation_deg": again["rotation_deg"]["rmse"]})
            self.assertNotIn("linear_velocity_mps", again, "velocities are not in these files")

    def test_two_runs_stand_beside_each_other(self):
        self.evaluate(self.other, "other")
        other = self.report("other")
        lines = {line[:24].strip(): line[24:].replace("*", "").split() for line in self.printed.splitlines()}
        for name, key, factor in (("RMSE e_t (cm)", "translation_m", 100), ("RMSE e_a (deg)", "rotation_deg", 1)):
            self.assertEqual(lines[name], [f"{factor * report[key]['rmse']:.3f}" for report in (self.own, other)])
        self.assertEqual(lines[""], ["run", "other"])

    def test_what_the_truth_is_off_by_is_counted_in_the_consistency_of_pose_and_twist(self):
        self.evaluate(self.csv, "off", "--truth-pose-std", "0.002", "1.5", "--truth-twist-std", "0.03", "20")
        off = self.report("off")
        for what, stds in (("pose", {"truth_std_m": 0.002, "truth_std_deg": 1.5}), ("twist", {"truth_std_mps": 0.03, "truth_std_degps": 20})):
            exact, counted = (report[f"{what}_consistency"] for report in (self.own, off))
            for key, value in stds.items():
                self.assertEqual(exact[key], 0)
                self.assertAlmostEqual(counted[key], value, delta=1e-12)
            self.assertLess(counted["nees_mean"], 0.9 * exact["nees_mean"])
            self.assertEqual(counted["frames"], exact["frames"])
        self.assertEqual(off["translation_m"], self.own["translation_m"])

    def test_a_deviation_of_the_truth_that_is_none_is_refused_with_its_name(self):
        for words in (("0.001",), ("0.001", "nan"), ("-0.001", "0.5"), ("inf", "0.5"), ("0.001", "x")):
            words = [BIN / "disflow_eval", self.sequence, "--csv", self.csv, "--truth-pose-std", *words]
            done = subprocess.run(words, capture_output=True, text=True, check=False)
            self.assertEqual(done.returncode, 2, words)
            self.assertIn("--truth-pose-std", done.stderr)

    def test_latex_table_holds_the_figures_and_the_best_is_bold(self):
        text = (self.folder / "table.tex").read_text()
        rows = [line.removesuffix(" \\\\").split(" & ") for line in text.splitlines() if line.startswith(("run", "other"))]
        heads = next(line for line in text.splitlines() if line.startswith("Method")).removesuffix(" \\\\").split(" & ")
        self.evaluate(self.other, "other")
        reports = [self.own, self.report("other")]
        self.assertEqual(heads[:4], ["Method", "ADD-AUC (\\%)", "RMSE $e_t$ (cm)", "RMSE $e_a$ (deg)"])
        for column, values in ((1, [r["add_auc_percent"] for r in reports]), (2, [100 * r["translation_m"]["rmse"] for r in reports])):
            best = (max if column == 1 else min)(values)
            for row, value in zip(rows, values):
                plain = row[column].removeprefix("\\textbf{").removesuffix("}")
                self.assertAlmostEqual(float(plain), value, delta=0.006)
                self.assertEqual(row[column] != plain, value == best)
        self.assertEqual(text.count("\\begin{tabular}"), text.count("\\end{tabular}"))


if __name__ == "__main__":
    unittest.main()
