# SPDX-License-Identifier: BSD-3-Clause
"""Pictures of the accuracy run, drawn by gnuplot from the error tables that disflow_eval left."""

import csv
import json
import math
import subprocess

import runs

STYLE = """set terminal pngcairo size 900,{height} font 'sans,10'
set output '{file}'
set datafile separator ','
set datafile missing 'nan'
set grid lc rgb '#c8c8c8' lw 0.6
set border 3 lc rgb '#606060'
set tics nomirror
set style data lines
set key below center horizontal samplen 2 noautotitle
set lmargin 9
set linetype 1 lc rgb '#1f6fb4'
set linetype 2 lc rgb '#d1601f'
set linetype 3 lc rgb '#2a9d5c'
set linetype 4 lc rgb '#8450a8'
set linetype 5 lc rgb '#8a8a2a'
set linetype 6 lc rgb '#404040'
set multiplot layout {layout} title "{title}"
"""

NEES_BOUNDS = (1.2373442457912028, 14.449375335447922)


def _draw(path, height, layout, title, panels):
    script = STYLE.format(height=height, file=path.name, layout=layout, title=title)
    script += "\n".join(panels) + "\nunset multiplot\n"
    done = subprocess.run(["gnuplot", "-d"], input=script, cwd=path.parent, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise RuntimeError(f"gnuplot failed on {path}: {done.stderr.strip()}")


def _curves(programs, row, seeds, column, scale, style="with lines"):
    """One curve per run of a row: a column of its error table."""
    curves = []
    for seed in seeds:
        file = programs.file(runs.Job(row.name, row.scene, seed), ".frames.csv").resolve()
        curves.append(f"'{file}' every ::1 using 2:(${column}*{scale}) {style} lt {seed} title '{seed}'")
    return ", ".join(curves)


def _errors(programs, path, rows, seeds):
    panels = []
    for row in rows:
        for column, scale, name in ((3, 1000, "e_t [mm]"), (4, 1, "e_a [deg]")):
            panels.append(
                f"set title '{row.name}' noenhanced; set xlabel 'time [s]'; set ylabel '{name}' noenhanced; set yrange [0:*]\n"
                f"plot {_curves(programs, row, seeds, column, scale)}"
            )
    _draw(path, 320 * len(rows), f"{len(rows)},2", "Pose error over time, one colour per seed", panels)


def _nees(programs, path, rows, seeds):
    panels = []
    low, high = NEES_BOUNDS
    points = "with points pt 7 ps 0.25"  # five noisy curves would hide each other
    for row in rows:
        for column, name in ((9, "NEES of the pose"), (10, "NEES of the twist")):
            panels.append(
                f"set title '{row.name}' noenhanced; set xlabel 'time [s]'; set ylabel '{name}'\n"
                "set logscale y; set yrange [0.05:200]\n"
                f"plot {_curves(programs, row, seeds, column, 1, points)}, "
                f"{low} lc rgb 'black' dt 2, {high} lc rgb 'black' dt 2"
            )
    _draw(path, 320 * len(rows), f"{len(rows)},2", "Squared error over covariance, one colour per seed; dashed: 95 % of a truthful one", panels)


def _add_curves(programs, path, rows, seeds):
    """Share of frames below a threshold of ADD, all seeds of a row together."""
    curves = []
    data = []
    for row in rows:
        add_mm = []
        for seed in seeds:
            file = programs.file(runs.Job(row.name, row.scene, seed), ".frames.csv")
            with open(file, encoding="utf-8", newline="") as stream:
                add_mm += [1000 * float(line["add_m"]) for line in csv.DictReader(stream)]
        add_mm.sort()
        # Two hundred points draw the same curve as thousands.
        steps = [(k + 1) / 200 for k in range(200)]
        points = [(add_mm[math.ceil(share * len(add_mm)) - 1], 100 * share) for share in steps]
        data.append("\n".join(f"{x:.5f},{y:.2f}" for x, y in points))
        curves.append(f"$d{len(data)} using 1:2 title '{row.name}' noenhanced")
    blocks = "\n".join(f"$d{i + 1} << END\n{text}\nEND" for i, text in enumerate(data))
    panel = (
        f"{blocks}\nset xlabel 'ADD [mm]'; set ylabel 'frames with at most this error [%]'\n"
        "set logscale x; set xrange [0.01:100]; set yrange [0:102]; set key outside right center vertical\n"
        f"plot {', '.join(curves)}"
    )
    _draw(path, 480, "1,1", "Share of frames below an error", [panel])


def _calibration(programs, path, rows, seeds):
    """Stated against true deviation of the surface, ten bins of vertices per run."""
    panels = []
    for row in rows:
        curves = []
        for seed in seeds:
            report = json.loads(programs.file(runs.Job(row.name, row.scene, seed), ".json").read_text(encoding="utf-8"))
            bins = (report.get("surface") or {}).get("calibration", {}).get("bins", [])
            points = "\n".join(f"{1e3 * b['std_m']:.5f},{1e3 * b['error_m']:.5f}" for b in bins)
            if points:
                panels.append(f"$c{len(panels)} << END\n{points}\nEND")
                curves.append(f"$c{len(panels) - 1} with linespoints lt {seed} pt 7 ps 0.6 title '{seed}'")
        if not curves:
            continue
        panels.append(
            f"set title '{row.name}' noenhanced; set xlabel 'stated standard deviation [mm]'; set ylabel 'true error, rms [mm]'\n"
            "set logscale xy; set xrange [0.03:3]; set yrange [0.03:3]\n"
            "plot x lc rgb 'black', 1.5*x lc rgb 'black' dt 2, x/1.5 lc rgb 'black' dt 2, " + ", ".join(curves)
        )
    _draw(path, 430, f"1,{len(rows)}", "Standard deviation of the surface against its error; dashed: factor 1.5", panels)


def draw(programs, rows, seeds, folder):
    """Draws what the rows at hand allow. @return (file name, title) of every picture."""
    folder.mkdir(parents=True, exist_ok=True)
    by_name = {row.name: row for row in rows}

    def present(*names):
        return [by_name[name] for name in names if name in by_name]

    pictures = []
    main = present("box, fast, stereo", "bottle, fast, stereo", "box, fast, d415", "bottle, fast, d415")[:2]
    if main:
        _errors(programs, folder / "accuracy-errors.png", main, seeds)
        pictures.append(("accuracy-errors.png", "Pose errors over time, one curve per seed"))
        _nees(programs, folder / "accuracy-nees.png", main, seeds)
        pictures.append(("accuracy-nees.png", "Normalised squared errors over time, one curve per seed"))
    curves = present(
        "box, fast, clean", "box, fast, stereo", "bottle, fast, stereo", "box, fast, d415", "bottle, fast, d415", "box, fast, d415, sloppy mask",
        "box, fast, d415, no mask",
    )
    if curves:
        _add_curves(programs, folder / "accuracy-add.png", curves, seeds)
        pictures.append(("accuracy-add.png", "Share of frames below an error"))
    surfaces = present("box, rotate360, d415", "bottle, rotate360, d415")
    if surfaces:
        _calibration(programs, folder / "accuracy-surface.png", surfaces, seeds)
        pictures.append(("accuracy-surface.png", "Stated standard deviation of the surface against its true error"))
    return pictures
