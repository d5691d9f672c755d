# SPDX-License-Identifier: BSD-3-Clause
"""Everyday things become meshes that a sequence can be made of: closed, in metres, judged everywhere."""

import contextlib
import io
import math
import pathlib
import sys
import tempfile
import unittest
import unittest.mock

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "bench/suite"))

import figures
import lot
import main
import things

# As OpenSCAD writes it; faces of three and four corners.
PRISM = """OFF
6 5 0

0 0 0
100 0 0
0 50 0
0 0 10
100 0 10
0 50 10
3 0 2 1 255 255 0
3 3 4 5
4 0 1 4 3
4 1 2 5 4
4 2 0 3 5
"""


def edges_of(triangles):
    return [edge for a, b, c in triangles for edge in ((a, b), (b, c), (c, a))]


class Meshes(unittest.TestCase):
    def test_faces_of_any_number_of_corners_are_read_as_triangles(self):
        points, triangles = things.read_off(PRISM)
        self.assertEqual(points[4], (100.0, 0.0, 10.0))
        self.assertEqual(len(triangles), 2 + 3 * 2)

    def test_a_thing_is_in_metres_about_its_middle(self):
        points, _ = things.read_off(PRISM)
        for values, size_m in zip(zip(*things.centred(points, 0.001)), (0.1, 0.05, 0.01)):
            self.assertAlmostEqual(max(values), size_m / 2)
            self.assertAlmostEqual(min(values), -size_m / 2)

    def test_no_edge_is_longer_than_asked_for_and_what_was_closed_stays_closed(self):
        points, triangles = things.read_off(PRISM)
        fine, small = things.refined(points, triangles, 7.0)
        directed = edges_of(small)
        self.assertLessEqual(max(math.dist(fine[a], fine[b]) for a, b in directed), 7.0)
        self.assertEqual(len(set(directed)), len(directed))
        self.assertEqual(set(directed), {(b, a) for a, b in directed})

    def test_refining_changes_neither_area_nor_volume(self):
        def measure(points, triangles):
            area = volume = 0.0
            for corners in triangles:
                a, b, c = (points[i] for i in corners)
                u, v = ([y - x for x, y in zip(a, other)] for other in (b, c))
                normal = (u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0])
                area += math.hypot(*normal) / 2
                volume += sum(x * n for x, n in zip(a, normal)) / 6
            return area, volume

        points, triangles = things.read_off(PRISM)
        before, after = measure(points, triangles), measure(*things.refined(points, triangles, 7.0))
        self.assertAlmostEqual(before[1], 100 * 50 / 2 * 10)
        for was, now in zip(before, after):
            self.assertAlmostEqual(now / was, 1.0)

    def test_a_drawing_that_fails_is_named(self):
        failed = unittest.mock.Mock(returncode=1, stderr="no such module")
        with tempfile.TemporaryDirectory() as folder, unittest.mock.patch("subprocess.run", return_value=failed):
            with self.assertRaisesRegex(RuntimeError, "drill.scad: no such module"):
                things.draw(("drill",), pathlib.Path(folder))


class Choice(unittest.TestCase):
    def test_every_drawing_is_either_for_choosing_or_for_the_page(self):
        for folder, names in (("tuning", things.TUNING), ("reported", things.REPORTED)):
            self.assertEqual(sorted(file.stem for file in (things.FOLDER / folder).glob("*.scad")), sorted(names))

    def test_what_is_chosen_by_never_comes_onto_the_page(self):
        self.assertFalse(set(main.FINAL_THINGS) & set(main.TUNING_LOT + main.FINAL_LOT))
        with tempfile.TemporaryDirectory() as folder:
            page = pathlib.Path(folder) / "results.md"
            result = {name: 50.0 for name in figures.FIGURES}
            for words, names, is_written in (([], things.REPORTED, True), (["--tune"], things.TUNING, False)):
                page.write_text("<!-- things:begin -->\n<!-- things:end -->\n", encoding="utf-8")
                with unittest.mock.patch.object(lot, "measure", side_effect=lambda _, tickets, __: {t.number: result for t in tickets}), \
                        unittest.mock.patch.object(things, "draw", side_effect=lambda them, _: [pathlib.Path(f"/{n}.obj") for n in them]) as draw, \
                        contextlib.redirect_stdout(None), contextlib.redirect_stderr(io.StringIO()):
                    self.assertEqual(main.main(["lot", "--things", "--docs", folder, "--out", folder, *words]), 0)
                self.assertEqual(draw.call_args.args[0], names)
                self.assertEqual("60 sequences of" in page.read_text(encoding="utf-8"), is_written)

    def test_they_are_drawn_by_lot_alone(self):
        for words in (["accuracy", "--things"], ["lot", "--things", "--objects", "tin.obj"]):
            with contextlib.redirect_stderr(io.StringIO()) as said, self.assertRaises(SystemExit):
                main.parse(words)
            self.assertIn("--things goes with lot", said.getvalue())


if __name__ == "__main__":
    unittest.main()
