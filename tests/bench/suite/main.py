# SPDX-License-Identifier: BSD-3-Clause
"""Measures the tracker on simulated sequences and writes the tables of the documentation.

accuracy: tracks and judges the whole table, checks every figure against its goal.
ablation: switches one part of the method off at a time.
objects: two and four objects that pass in front of each other, and the time with one and two threads.
peers: generalised and point-to-plane ICP of PCL beside the tracker, on the same recorded frames.
cost: instructions per frame and stage, counted by callgrind.
lot: sequences of which everything is drawn by lot, as many as wanted.
again: objects that are out of sight for seconds, and whether they are found again.
"""

import argparse
import pathlib
import sys
import time

import ablation
import accuracy
import again
import cost
import lot
import objects
import pages
import peers
import plots
import runs
import sequences
import things

ROOT = pathlib.Path(__file__).resolve().parents[3]

TUNING_SEEDS = [1, 2, 3]
FINAL_SEEDS = [11, 12, 13, 14, 15]
PEER_SEEDS = FINAL_SEEDS[:3]
AGAIN_SEEDS = FINAL_SEEDS[:2]
TUNING_LOT = list(range(1, 121))
FINAL_LOT = list(range(201, 321))
# Of everyday things.
TUNING_THINGS = TUNING_LOT[:60]
FINAL_THINGS = list(range(321, 381))


def parse(words):
    parser = argparse.ArgumentParser(prog="./dev bench", description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("what", choices=tuple(MEASURES))
    parser.add_argument("--bin", type=pathlib.Path, default=ROOT / "build/release/bin", help="folder of the programs")
    parser.add_argument("--out", type=pathlib.Path, help="folder for what is measured [build/WHAT]")
    parser.add_argument("--docs", type=pathlib.Path, default=ROOT / "docs", help="folder of the pages [docs]")
    parser.add_argument("--seeds", type=pages.seeds, metavar="LIST",
                        help="e.g. 11-15 or 1,4 [accuracy: 11-15, which nothing may be tuned on; peers: 11-13; again: 11, 12; lot: 201-320; "
                             "cost: always 11; others: 1-3]")
    parser.add_argument("--tune", action="store_true", help="seeds 1-3, lot: 1-120, for choosing settings; the pages stay as they are")
    parser.add_argument("--quick", action="store_true", help="seed 1 alone, lot: 1-12; the pages stay as they are")
    parser.add_argument("--frames", type=int, default=300, help="peers, cost: of every sequence [300]")
    parser.add_argument("--check", action="store_true",
                        help="cost: fail if a median has grown by more than 5 %% over what docs/cost.json says; the pages stay as they are")
    parser.add_argument("--objects", action="append", metavar="FILE.obj", type=pathlib.Path, default=[],
                        help="accuracy, peers: a scanned mesh in metres, in addition; lot: in place of the simulator's own; may be repeated")
    parser.add_argument("--things", action="store_true",
                        help="lot: everyday things, drawn with OpenSCAD, in place of the simulator's own: six for choosing by (--tune), "
                             "six others for the page; numbers 1-60 and 321-380")
    parser.add_argument("--continue", action="store_true", dest="resume",
                        help="accuracy, again, lot: of a run that was broken off, keep what the same programs have measured")
    parser.add_argument("--frames-in", type=pathlib.Path, metavar="DIR", dest="frames_dir",
                        help="accuracy, lot: keep the frames of every sequence here, 270 MB each, and take them from here the next "
                             "time: the same figures in a second where a stereo camera takes a minute. To be removed when the "
                             "simulator changes")
    parser.add_argument("--set", action="append", metavar="SECTION.NAME=VALUE", default=[], dest="settings",
                        help="lot: a setting of the tracker other than its default, may be repeated; the pages stay as they are")
    parser.add_argument("--against", type=pathlib.Path, metavar="FILE.json",
                        help="lot: results.json of a run before, to say what has changed; the pages stay as they are")
    parser.add_argument("--remark", default="", help="peers: what to say on the page of how it was measured")
    parser.add_argument("--only", action="append", metavar="TEXT", default=[],
                        help="only rows whose name contains this, may be repeated; the pages stay as they are")
    options = parser.parse_args(words)
    if options.things and (options.what != "lot" or options.objects):
        parser.error("--things goes with lot, and without --objects")
    # What has seeds, a folder and a part of a page of its own.
    options.bed = "things" if options.things else options.what
    return options


def measure_accuracy(options, seeds, whole):
    every = tuple(row for file in options.objects for row in sequences.of_scanned(file.resolve())) + sequences.ROWS
    rows = [row for row in every if whole or not options.only or any(text in row.name for text in options.only)]
    # A row that is held against another one needs it.
    wanted = {row.name for row in rows} | {row.like for row in rows}
    rows = [row for row in every if row.name in wanted]
    programs = runs.Programs(options.bin, options.out, options.resume, options.frames_dir)
    results = accuracy.measure(programs, rows, seeds)
    images = options.docs / "images" if whole else options.out / "images"
    pictures = plots.draw(programs, rows, seeds, images)
    text = accuracy.page(results, [(f"images/{file}", title) for file, title in pictures])
    accuracy.write_json(options.out / "results.json", results)
    if whole:
        accuracy.write_json(options.docs / "results.json", results)
        pages.replace_part(options.docs / "results.md", "accuracy", text)
    print(text)
    print("\nMissed:" if accuracy.missed_goals(results) else "\nNothing missed.")
    for line in accuracy.missed_goals(results):
        print("  " + line)
    print(accuracy.summary_line(results))


def measure_ablation(options, seeds, whole):
    variants = [v for v in ablation.VARIANTS if whole or not options.only or any(text in v.name for text in options.only)]
    text = ablation.measure(runs.Programs(options.bin, options.out), variants, seeds)
    if whole:
        pages.replace_part(options.docs / "method.md", "ablation", text)
    print(text)


def measure_objects(options, seeds, whole):
    text = objects.measure(runs.Programs(options.bin, options.out), seeds)
    if whole:
        pages.replace_part(options.docs / "several-objects.md", "objects", text)
    print(text)


def measure_peers(options, seeds, whole):
    rows = peers.rows(options.quick, options.objects, () if whole else options.only)
    results = peers.measure(runs.Programs(options.bin, options.out), rows, seeds, options.frames)
    text = peers.page(results, seeds, options.frames, peers.today(), options.remark)
    if whole:
        peers.write_json(options.docs / "peers.json", results)
        pages.replace_part(options.docs / "results.md", "peers", text)
    print(text)


def measure_cost(options, seeds, whole):
    rows = [row for row in (cost.QUICK_ROWS if options.quick else cost.ROWS)
            if not options.only or any(text in row.name for text in options.only)]
    results = cost.measure(runs.Programs(options.bin, options.out), rows, options.frames)
    stored = options.docs / "cost.json"
    if options.check:
        print("\n".join(cost.check(results, stored)))
        return
    commit = cost.commit_of(ROOT)
    text = cost.page(results, commit, options.frames)
    if whole:
        cost.write_json(stored, results, options.frames, commit)
        pages.replace_part(options.docs / "performance.md", "cost", text)
    print(text)


def measure_lot(options, seeds, whole):
    meshes = options.objects
    if options.things:
        meshes = things.draw(things.TUNING if options.tune or options.quick else things.REPORTED, options.out / "meshes")
    tickets = [lot.draw(number, meshes) for number in seeds]
    # Read first: it may be the file that is written now.
    before = lot.read_json(options.against) if options.against else None
    programs = runs.Programs(options.bin, options.out, options.resume, options.frames_dir)
    results = lot.measure(programs, tickets, options.settings)
    lot.write_json(options.out / "results.json", results)
    text = lot.page(tickets, results)
    if whole and not options.objects and not set(seeds) & set(TUNING_LOT):
        pages.replace_part(options.docs / "results.md", options.bed, text)
    print(text)
    if before is not None:
        print(lot.compare(tickets, before, results))


def measure_again(options, seeds, whole):
    text = again.page(again.measure(runs.Programs(options.bin, options.out, options.resume), seeds), seeds)
    if whole:
        pages.replace_part(options.docs / "results.md", "again", text)
    print(text)


MEASURES = {
    "accuracy": measure_accuracy,
    "ablation": measure_ablation,
    "objects": measure_objects,
    "peers": measure_peers,
    "cost": measure_cost,
    "lot": measure_lot,
    "again": measure_again,
}
# Seeds to choose by, and how many of them are enough for a look, where they are others than TUNING_SEEDS and one.
TUNING = {"lot": TUNING_LOT, "things": TUNING_THINGS}
QUICK = {"lot": 12, "things": 12}
# Seeds that nothing was tuned on, where figures are published.
SEEDS = {"accuracy": FINAL_SEEDS, "peers": PEER_SEEDS, "again": AGAIN_SEEDS, "lot": FINAL_LOT, "things": FINAL_THINGS}


def main(words):
    options = parse(words)
    options.out = options.out or ROOT / "build" / options.bed
    tuning = TUNING.get(options.bed, TUNING_SEEDS)
    seeds = options.seeds or (tuning if options.tune else SEEDS.get(options.bed, tuning))
    if options.quick:
        seeds = tuning[: QUICK.get(options.bed, 1)]
    # What is measured only in part does not belong on a page.
    whole = not (options.quick or options.tune or options.only or options.check or options.settings or options.against)
    begin = time.monotonic()
    try:
        MEASURES[options.what](options, seeds, whole)
    except (RuntimeError, OSError) as error:
        print(f"bench {options.what}: {error}", file=sys.stderr)
        return 1
    print(f"{time.monotonic() - begin:.0f} s; everything is in {options.out}", file=sys.stderr)
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
