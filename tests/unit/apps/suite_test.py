# SPDX-License-Identifier: BSD-3-Clause
"""The suite's own arithmetic: what counts as a goal that is met, and what is written where."""

import contextlib
import datetime
import io
import json
import os
import pathlib
import sys
import tempfile
import unittest
import unittest.mock

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[3] / "tests" / "bench" / "suite"))

import ablation
import accuracy
import again
import cost
import figures
import lot
import main
import objects
import pages
import peers
import runs
import sequences


def run_with(**values):
    return dict({name: 1.0 for name in figures.FIGURES}, **values)


class Figures(unittest.TestCase):
    def test_report_of_disflow_eval_is_shown_in_the_units_of_the_goals(self):
        report = {"add_auc_percent": 99.5, "translation_m": {"rmse": 0.0009}, "pose_consistency": {}}
        read = figures.read_all(report)
        self.assertAlmostEqual(read["add_auc"], 99.5)
        self.assertAlmostEqual(read["e_t"], 0.9)
        self.assertIsNone(read["pose_nees"])
        self.assertIsNone(read["f_1mm"])

    def test_goal_is_judged_by_the_value_that_is_shown(self):
        goal = figures.Goal("add_auc", ">=", 99.85)
        self.assertTrue(goal.is_met(99.846))
        self.assertFalse(goal.is_met(99.844))
        self.assertFalse(goal.is_met(None))
        self.assertFalse(figures.Goal("e_t", "<=", 0.9).is_met(0.91))

    def test_mean_does_not_leave_out_the_seed_that_failed(self):
        summary = figures.Summary({1: run_with(add_auc=100.0, e_t=0.1), 2: figures.FAILED})
        self.assertAlmostEqual(summary.mean("add_auc"), 50.0)
        self.assertIsNone(summary.mean("e_t"))
        self.assertEqual(summary.least("add_auc"), 0.0)


class Objects(unittest.TestCase):
    def test_names_are_those_of_the_simulated_camera(self):
        self.assertEqual(objects.names_of(("box", "bottle", "box", "box")), ["box", "bottle", "box2", "box3"])

    def test_times_are_those_of_all_objects_not_of_one(self):
        said = ("disflow_track: box: 9 frames\n  time per frame: median 1.00 ms, 99 % below 2.00 ms\n"
                "disflow_track: all 2 objects, by 1 threads: time per frame: median 3.50 ms, 99 % below 4.25 ms\n")
        self.assertEqual(objects.read_times(said), (3.5, 4.25))
        with self.assertRaises(RuntimeError):
            objects.read_times("disflow_track: box: 9 frames")


class Table(unittest.TestCase):
    def results(self, **plain):
        rows = [row for row in sequences.ROWS if row.name.startswith("box, fast, d415")]
        results = accuracy.Results(rows, [1])
        results.summaries = {row.name: figures.Summary({1: run_with(add_auc=99.0)}) for row in rows}
        results.summaries["box, fast, d415"] = figures.Summary({1: run_with(**plain)})
        return results

    def goals(self, results, name):
        row = next(row for row in results.rows if row.name == name)
        return [goal.limit for goal in accuracy._goals_of(results, row) if goal.figure == "add_auc"]

    def test_disturbed_row_is_held_against_its_plain_counterpart(self):
        self.assertEqual(self.goals(self.results(add_auc=99.4), "box, fast, d415, no mask"), [98.8])

    def test_missed_goals_are_named(self):
        results = self.results(add_auc=99.7)
        accuracy._check_goals(results)
        self.assertIn("box, fast, d415, no mask: ADD-AUC 99.00 % (≥ 99.1)", accuracy.missed_goals(results))

    def test_surface_has_to_beat_the_baseline(self):
        row = next(row for row in sequences.ROWS if row.name == "bottle, rotate360, clean")
        results = accuracy.Results([row], [1])
        results.summaries = {row.name: figures.Summary({1: run_with(chamfer=0.4)})}
        results.baseline = {row.name: figures.Summary({1: run_with(chamfer=0.3)})}
        goals = {goal.figure: goal for goal in accuracy._goals_of(results, row)}
        self.assertFalse(goals["chamfer"].is_met(results.mean(row.name, "chamfer")))

    def test_page_holds_every_row_and_json_every_figure(self):
        results = self.results(add_auc=99.4)
        text = accuracy.page(results, [("images/a.png", "A picture")])
        for row in results.rows:
            self.assertIn(f"| {row.name} |", text)
        self.assertIn("![A picture](images/a.png)", text)
        data = json.loads(json.dumps(results.json()))
        self.assertEqual(data["rows"]["box, fast, d415"]["seeds"]["1"]["add_auc"], 99.4)


class Resume(unittest.TestCase):
    JOB = runs.Job("box, fast, d415", "box?motion=fast&noise=d415", 1)

    def programs(self, folder, resume=True):
        for name in ("disflow_track", "disflow_eval"):
            (pathlib.Path(folder) / name).touch()
        return runs.Programs(folder, pathlib.Path(folder) / "out", resume)

    def track(self, programs):
        """Figures without any program being run; those of a run would be None here."""
        programs.call = lambda *words, **options: None
        return programs.track(self.JOB)["add_auc"]

    def test_report_of_the_same_programs_is_kept_only_when_asked_for(self):
        with tempfile.TemporaryDirectory() as folder:
            for resume, kept in ((True, 99.5), (False, figures.FAILED["add_auc"])):
                programs = self.programs(folder, resume)
                programs.file(self.JOB, ".json").write_text('{"add_auc_percent": 99.5}', encoding="utf-8")
                self.assertEqual(self.track(programs), kept)

    def test_report_of_older_programs_or_a_torn_one_is_measured_again(self):
        with tempfile.TemporaryDirectory() as folder:
            programs = self.programs(folder)
            report = programs.file(self.JOB, ".json")
            report.write_text('{"add_auc_perc', encoding="utf-8")
            self.assertEqual(self.track(programs), 0.0)
            report.write_text('{"add_auc_percent": 99.5}', encoding="utf-8")
            os.utime(report, (1e9, 1e9))
            self.assertEqual(self.track(programs), 0.0)


class Rows(unittest.TestCase):
    def test_scanned_mesh_is_shown_by_its_name_and_holds_itself_to_its_plain_row(self):
        rows = sequences.of_scanned(pathlib.Path("/folder/007_tin.obj"))
        names = {row.name for row in rows}
        self.assertEqual(len(names), len(rows))
        self.assertTrue(all(name.startswith("007_tin, ") for name in names))
        self.assertTrue(all(row.like in names for row in rows if row.like))
        self.assertTrue(all(row.scene.startswith("obj:/folder/007_tin.obj?motion=") for row in rows))

    def test_real_cameras_come_first_and_white_noise_last(self):
        noises = [row.name.split(", ")[2] for row in sequences.ROWS]
        self.assertEqual(noises[0], "stereo")
        self.assertEqual(noises[-1], "white")
        self.assertLess(max(i for i, noise in enumerate(noises) if noise == "stereo"), noises.index("d415"))
        self.assertLess(max(i for i, noise in enumerate(noises) if noise == "d415"), noises.index("white"))

    def test_names_and_files_are_unique(self):
        jobs = [runs.Job(row.name, row.scene, seed) for row in sequences.ROWS for seed in (1, 2)]
        jobs += [runs.Job(v.name, s, 1, v.settings) for v in ablation.VARIANTS for s in ablation.SCENES.values()]
        self.assertEqual(len({job.stem for job in jobs}), len(jobs))

    def test_counterparts_exist(self):
        names = {row.name for row in sequences.ROWS}
        self.assertTrue(all(row.like in names for row in sequences.ROWS if row.like))

    def test_every_noisy_row_has_to_be_consistent(self):
        for row in sequences.ROWS:
            asked = {goal.figure for goal in row.goals}
            self.assertEqual("noise=clean" not in row.scene, "pose_nees" in asked and "twist_nees" in asked, row.name)


    def test_every_noisy_surface_has_to_know_how_sure_it_is(self):
        for row in sequences.ROWS:
            asked = {goal.relation for goal in row.goals if goal.figure == "error_over_std"}
            self.assertEqual(asked, {"<=", ">="} if row.mesh and "noise=clean" not in row.scene else set(), row.name)


class Lot(unittest.TestCase):
    def result(self, **of):
        return {name: 50.0 for name in figures.FIGURES} | of

    def test_a_number_draws_the_same_every_time_and_another_draws_something_else(self):
        tickets = [lot.draw(number) for number in range(200)]
        self.assertEqual(tickets, [lot.draw(number) for number in range(200)])
        self.assertEqual(len({lot.job_of(ticket).stem for ticket in tickets}), 200)
        self.assertLess(max(len(lot.job_of(ticket).frames) for ticket in tickets), 200)

    def test_all_that_may_differ_is_drawn_about_as_often_as_it_weighs(self):
        tickets = [lot.draw(number) for number in range(2000)]
        for what, choices in (("shape", lot.SHAPES), ("motion", lot.MOTIONS), ("noise", lot.NOISES), ("in front", lot.OCCLUDERS)):
            for value, weight in choices:
                share = sum(ticket[what] == value for ticket in tickets) / 2000
                self.assertAlmostEqual(share, weight / sum(w for _, w in choices), delta=0.04, msg=value)

    def test_numbers_that_settings_are_chosen_by_never_come_onto_the_page(self):
        self.assertFalse(set(main.TUNING_LOT) & set(main.FINAL_LOT))
        with tempfile.TemporaryDirectory() as folder:
            page = pathlib.Path(folder) / "results.md"
            for numbers, is_written in (("5,6", False), ("201", True)):
                page.write_text("<!-- lot:begin -->\n<!-- lot:end -->\n", encoding="utf-8")
                measured = {number: self.result() for number in (5, 6, 201)}
                with unittest.mock.patch.object(lot, "measure", return_value=measured), \
                        contextlib.redirect_stdout(None), contextlib.redirect_stderr(io.StringIO()):
                    status = main.main(["lot", "--seeds", numbers, "--docs", folder, "--out", folder])
                self.assertEqual(status, 0)
                self.assertEqual("sequences of" in page.read_text(encoding="utf-8"), is_written)

    def test_scanned_things_take_the_place_of_drawn_ones(self):
        ticket = lot.draw(3, [pathlib.Path("/folder/007_tin.obj")])
        self.assertEqual(ticket["shape"], "007_tin")
        self.assertTrue(ticket.scene.startswith("obj:/folder/007_tin.obj?motion="))
        text = lot.page([ticket], {3: self.result()})
        self.assertIn("| 3: `obj:007_tin.obj?motion=", text)
        self.assertNotIn("/folder", text)

    def test_what_never_starts_has_lost_all_its_images(self):
        ticket = lot.draw(3)
        text = lot.page([ticket], {3: dict(figures.FAILED)})
        self.assertIn("| all | 1 | 0.0 | 0.0 | 1 | 200.0 | – |", text)

    def test_what_turns_unseen_is_not_judged_by_its_turn(self):
        ticket = next(t for t in map(lot.draw, range(200)) if t["shape"] == "can")
        self.assertIn("| all | 1 | 98.0 |", lot.page([ticket], {ticket.number: self.result(add_s_auc=98.0, add_auc=40.0)}))

    def test_a_comparison_names_what_moved_by_more_than_a_point(self):
        tickets = [t for t in map(lot.draw, range(60)) if t.figure == "add_auc"][:2]
        before = {t.number: self.result(add_auc=90.0) for t in tickets}
        now = {tickets[0].number: self.result(add_auc=90.9), tickets[1].number: self.result(add_auc=80.0)}
        text = lot.compare(tickets, before, now)
        self.assertIn(f"| {tickets[1].number}: `{tickets[1].scene}` | 90.0 | 80.0 |", text)
        self.assertNotIn(tickets[0].scene, text)

    def test_a_run_before_is_read_before_its_file_is_written_anew(self):
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder) / "results.json"
            lot.write_json(file, {3: self.result(add_auc=70.0)})
            said = io.StringIO()
            with unittest.mock.patch.object(lot, "measure", return_value={3: self.result(add_auc=80.0)}), \
                    contextlib.redirect_stdout(said), contextlib.redirect_stderr(io.StringIO()):
                self.assertEqual(main.main(["lot", "--seeds", "3", "--out", folder, "--against", str(file)]), 0)
            self.assertIn("| 70.0 | 80.0 |", said.getvalue())

    def test_runs_with_other_settings_have_files_of_their_own(self):
        ticket = lot.draw(3)
        self.assertNotEqual(lot.job_of(ticket).stem, lot.job_of(ticket, ["field.fuse_budget=290"]).stem)

    def test_results_are_read_as_they_were_written(self):
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder) / "results.json"
            lot.write_json(file, {7: self.result(), 9: dict(figures.FAILED)})
            self.assertEqual(lot.read_json(file), {7: self.result(), 9: figures.FAILED})


class Peers(unittest.TestCase):
    def results(self, tracker, gicp):
        """@param tracker, gicp ADD-AUC, of GICP by setting."""
        def of(value):
            return {11: dict({name: 1.0 for name in peers.SHOWN}, add_auc=value)}

        return {"box, fast, clean": {peers.TRACKER: {"": of(tracker)},
                                     "GICP": {setting: of(value) for setting, value in gicp.items()},
                                     "point-to-plane": {"3/10/20": of(50.0)}}}

    def test_best_setting_is_that_of_the_highest_mean_not_of_the_luckiest_seed(self):
        lucky = {11: run_with(add_auc=99.0), 12: run_with(add_auc=10.0)}
        steady = {11: run_with(add_auc=90.0), 12: run_with(add_auc=91.0)}
        setting, summary = peers.best({"lucky": lucky, "steady": steady})
        self.assertEqual(setting, "steady")
        self.assertAlmostEqual(summary.mean("add_auc"), 90.5)

    def test_better_velocity_counts_each_for_itself(self):
        plain = dict(figures.FAILED, v=1.0, w=9.0, e_t=0.5)
        extrapolated = dict(figures.FAILED, v=2.0, w=8.0, e_t=0.5)
        judged = peers.judge_velocities(plain, extrapolated)
        self.assertEqual((judged["v"], judged["w"], judged["e_t"]), (1.0, 8.0, 0.5))
        self.assertIsNone(peers.judge_velocities(figures.FAILED, figures.FAILED)["v"])

    def test_page_says_where_a_peer_is_ahead(self):
        results = self.results(98.0, {"a": 97.0, "b": 99.25})
        self.assertEqual(peers.ahead(results), [("box, fast, clean", "GICP", 1.25)])
        text = peers.page(results, [11], 150, datetime.date(2026, 1, 2), "busy")
        self.assertIn("| clean | 98.00 | 99.25 | 50.00 |", text)
        self.assertIn("|  | GICP b | **99.25** |", text)
        self.assertIn("| box, fast, clean | DisFlow | 98.00 |", text)
        self.assertIn("box, fast, clean: GICP by 1.25", text)
        self.assertIn("2026-01-02, seed 11, 150 frames each, busy.", text)

    def test_things_whose_turn_cannot_be_seen_are_judged_by_their_surface(self):
        def of(add_auc, add_s_auc):
            return {11: dict({name: 1.0 for name in peers.SHOWN}, add_auc=add_auc, add_s_auc=add_s_auc)}

        row = {peers.TRACKER: {"": of(40.0, 99.5)},
               "GICP": {"a": of(50.0, 99.0), "b": of(45.0, 99.25)},
               "point-to-plane": {"a": of(30.0, 99.75)}}
        self.assertEqual(peers.ahead({"can, fast, clean": row}), [("can, fast, clean", "point-to-plane", 0.25)])
        self.assertEqual(peers.ahead({"box, fast, clean": row}), [("box, fast, clean", "GICP", 10.0)])
        self.assertEqual(peers.means({"can, fast, clean": row, "tube, fast, clean": row})["clean"]["GICP"], 99.25)
        self.assertTrue(set(peers.TURNING) <= set(peers.OBJECTS))

    def test_page_says_that_no_peer_is_ahead(self):
        text = peers.page(self.results(99.5, {"a": 99.0}), [11], 150, datetime.date(2026, 1, 2))
        self.assertIn("nowhere", text)
        self.assertIn("| box, fast, clean | DisFlow | **99.50** |", text)

    def test_rows_are_objects_times_noises_and_scanned_meshes_in_addition(self):
        self.assertEqual(len(peers.rows(False)), len(peers.OBJECTS) * len(peers.NOISES))
        self.assertLess(len(peers.rows(True)), len(peers.rows(False)))
        scanned = peers.rows(False, [pathlib.Path("a/mug_2.obj")], ["mug_2"])
        self.assertEqual([row.name for row in scanned], [f"mug_2, fast, {noise}" for noise in peers.NOISES])
        self.assertEqual({row.thing for row in scanned}, {"a/mug_2.obj"})

    def test_settings_of_a_peer_are_told_apart_on_the_page(self):
        for peer in peers.PEERS:
            self.assertEqual(len({setting.show() for setting in peer.settings}), len(peer.settings))


def dump(folder, number, instructions):
    """A file as callgrind writes it."""
    path = pathlib.Path(folder) / f"out.{number}"
    path.write_text(f"version: 1\nevents: Ir\n\nfn=(1) main\n1 {instructions}\n\ntotals: {instructions}\n", encoding="utf-8")
    return path


class Cost(unittest.TestCase):
    LINES = ("frame,status,segment,register,retrain", "0,ok,1,0,1", "1,ok,1,1,1", "2,no mask,1,0,0")

    def test_counts_belong_to_the_stages_that_a_frame_went_through(self):
        with tempfile.TemporaryDirectory() as folder:
            # Of each frame what came before it, then its stages.
            dumps = [dump(folder, i, count) for i, count in enumerate((900, 10, 20, 900, 11, 12, 13, 900, 14))]
            self.assertEqual(cost.read_counts(self.LINES, dumps), [
                {"segment": 10, "register": 0, "retrain": 20},
                {"segment": 11, "register": 12, "retrain": 13},
                {"segment": 14, "register": 0, "retrain": 0}])
            with self.assertRaisesRegex(RuntimeError, "fewer files"):
                cost.read_counts(self.LINES, dumps[:-1])

    def test_file_that_callgrind_did_not_write_is_named(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "out.1"
            path.write_text("nothing\n", encoding="utf-8")
            with self.assertRaisesRegex(RuntimeError, "out.1"):
                cost.total_of(path)

    def test_start_counts_in_the_percentile_but_not_in_what_comes_later(self):
        spread = cost.spread_of([1000] * 5 + [10, 30, 20] + [10] * 9)
        self.assertEqual((spread["median"], spread["p99"], spread["most_later"]), (10, 1000, 30))

    def test_growth_beyond_the_bound_is_an_error_that_names_the_row(self):
        def results(median):
            return {"box": {"frame": {"median": median, "p99": 2 * median, "most_later": median}}}

        with tempfile.TemporaryDirectory() as folder:
            stored = pathlib.Path(folder) / "cost.json"
            cost.write_json(stored, results(1_000_000), 300, "abc")
            self.assertIn("box", cost.check(results(1_049_000), stored)[0])
            with self.assertRaisesRegex(RuntimeError, "box: 1.06 M, stored 1.00 M"):
                cost.check(results(1_060_000), stored)
            with self.assertRaisesRegex(RuntimeError, "none of the rows"):
                cost.check({"bottle": results(1)["box"]}, stored)

    def test_page_shows_every_row_in_millions(self):
        frames = [{"segment": 1_000_000, "register": 2_500_000}] * 9
        text = cost.page({"box, d415": cost.summarise(frames)}, "abc", 9)
        self.assertIn("| box, d415 | 1.00 | 2.50 | **3.50** | 3.50 | 3.50 | 1.00 |", text)

    def test_the_rows_of_the_check_are_stored(self):
        stored = json.loads((main.ROOT / "docs" / "cost.json").read_text(encoding="utf-8"))["rows"]
        for row in cost.QUICK_ROWS:
            self.assertIn(row.name, stored)


class Pages(unittest.TestCase):
    def test_seeds_are_numbers_and_spans(self):
        self.assertEqual(pages.seeds("11-13,4"), [11, 12, 13, 4])
        self.assertEqual(pages.name_seeds(pages.seeds("11-15")), "seeds 11 to 15")
        self.assertEqual(pages.name_seeds([7]), "seed 7")
        for wrong in ("", "5-3", "a"):
            with self.assertRaises(ValueError):
                pages.seeds(wrong)

    def test_only_what_is_between_the_markers_changes(self):
        with tempfile.TemporaryDirectory() as folder:
            page = pathlib.Path(folder) / "page.md"
            page.write_text("before\n<!-- x:begin (made) -->\nold\n<!-- x:end -->\nafter\n", encoding="utf-8")
            pages.replace_part(page, "x", "new\n")
            pages.replace_part(page, "x", "newer\n")
            wanted = "before\n<!-- x:begin (made) -->\nnewer\n\n<!-- x:end -->\nafter\n"
            self.assertEqual(page.read_text(encoding="utf-8"), wanted)

    def test_page_without_markers_is_left_alone(self):
        with tempfile.TemporaryDirectory() as folder:
            page = pathlib.Path(folder) / "page.md"
            page.write_text("all by hand\n", encoding="utf-8")
            with self.assertRaisesRegex(RuntimeError, "x:begin"):
                pages.replace_part(page, "x", "new")
            self.assertEqual(page.read_text(encoding="utf-8"), "all by hand\n")

    def test_the_pages_in_the_tree_have_their_markers(self):
        for name, part in (("results.md", "accuracy"), ("results.md", "lot"), ("results.md", "again"), ("results.md", "things"), ("results.md", "peers"), ("method.md", "ablation"), ("performance.md", "cost")):
            text = (main.ROOT / "docs" / name).read_text(encoding="utf-8")
            self.assertIn(f"<!-- {part}:begin", text)
            self.assertIn(f"<!-- {part}:end -->", text)


class Again(unittest.TestCase):
    CASE = again.Case("box", "none", "d415", blank_s=2, seed=11)
    BACK = 150  # (3 + 2) s

    def outcome(self, rows, add_s_m=0.001):
        """@param rows By frame, (status, reset_counter)."""
        frames = {frame: {"status": status, "reset_counter": counter} for frame, (status, counter) in rows.items()}
        errors = {frame: {"add_s_m": str(add_s_m)} for frame in rows}
        return again.outcome(self.CASE, frames, errors)

    def test_the_simulator_is_told_all_of_a_case(self):
        self.assertEqual(self.CASE.back, self.BACK)
        self.assertEqual(self.CASE.job.address, "sim:box?motion=fast&noise=d415&mask=none&frames=210&blank_at_s=3&blank_s=2&seed=11")
        self.assertEqual(len({case.job.stem for case in again.cases([11, 12])}), len(again.cases([11, 12])))

    def test_what_is_found_in_its_object_frame_is_right_or_wrong_by_its_surface(self):
        rows = {89: ("ok", "0"), self.BACK: ("registration_failed", "0"), self.BACK + 7: ("ok", "0")}
        self.assertEqual(self.outcome(rows), again.Outcome("found", 7))
        self.assertEqual(self.outcome(rows, add_s_m=0.011), again.Outcome("wrong", 7))

    def test_another_object_frame_is_not_found_again(self):
        self.assertEqual(self.outcome({89: ("ok", "0"), self.BACK + 7: ("ok", "1")}), again.Outcome("anew"))

    def test_what_is_found_too_late_or_was_lost_before_is_told_apart(self):
        late = {89: ("ok", "0"), self.BACK - 1: ("ok", "0"), self.BACK + again.WATCHED: ("ok", "0")}
        self.assertEqual(self.outcome(late), again.Outcome("never"))
        self.assertEqual(self.outcome({89: ("registration_failed", "0"), self.BACK: ("ok", "0")}), again.Outcome("before"))

    def test_every_case_is_in_one_cell_of_the_page(self):
        outcomes = {case: again.Outcome("found", 17 if case.shape == "mug" else 2) for case in again.cases([11])}
        text = again.page(outcomes, [11])
        self.assertIn("Seed 11; ", text)
        self.assertIn("| given, d415 | 21 | 0 | 18 | 21 | 0 | 0 | 0 |", text)
        self.assertIn("| none, tof | 21 | 0 | 18 | 21 | 0 | 0 | 0 |", text)


if __name__ == "__main__":
    unittest.main()
