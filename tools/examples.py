#!/usr/bin/python3
"""Keeps what stands beside the examples' decks: expected.csv, a thinned history, and picture.png.

    examples.py --program build/fissura                 compare fresh runs with expected.csv; exits with 1 if one has left it
    examples.py --program build/fissura --update        write expected.csv and picture.png anew
    examples.py --program build/fissura --only 01       some of them; --long for those that take long
"""
import argparse
import csv
import shutil
import sys
from dataclasses import dataclass
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parent))
import figures
import picture
from figure_parts import shrink
from fissura_io import BadFile, History, read_pvd
from verify_page import figure_file
from verify_runs import EXAMPLES, ROOT, RunFailed, Runs

ROWS = 60
COUNTS = ("joints_damaged", "joints_broken", "bar_joints_yielded", "bars_broken")


@dataclass(frozen=True)
class Example:
    run: str                   # name in verify_runs.all_runs(): the deck as it stands
    columns: tuple             # of the history; the counts are added
    figure: int | str = 0      # picture.png is this figure, or
    cracks_before: str = ""    # the cracks in the last frame before this count leaves 0 ("" = the last frame)
    tolerance: float = 0.02    # of a column's range, for the mean difference; the scatter of cracking runs
    fragments: bool = False    # picture.png shows the pieces instead of the cracks


EXAMPLE = {
    "00_demo_beam": Example("demo", ("load", "deflection", "steel_stress", "crack_width")),
    "01_tension_prism": Example("prism_A_20", ("force", "u_right", "u_left"), figure=13, tolerance=1e-6),
    "02_self_weight_beam": Example("self_weight_C", ("deflection",), figure=17, tolerance=1e-6),
    "03_elastic_tie": Example("elastic_tie_20", ("force", "u_right", "u_left", "bar_stress"), figure=19, tolerance=1e-6),
    "04_tie_to_failure": Example("tie_D", ("force", "elongation", "u_a", "u_b", "bar_strain", "slip"),
                                 cracks_before="bars_broken"),
    "05_cyclic_tie": Example("cyclic_tie_coarse", ("force", "mean_strain", "steel_stress", "steel_strain", "slip", "crack"), figure=28),
    "06_four_point_beam": Example("four_point", ("load", "deflection", "jack", "steel_stress")),
    "07_compression_prism": Example("compression_case", ("load", "shortening")),
    "09_cyclic_column": Example("cyclic_column", ("drift", "base_shear", "rise", "axial", "stress_left", "strain_left", "stress_right", "strain_right"),
                                figure="cyclic_column"),
    "10_column_ground_motion": Example("column_quake", ("head", "foot", "shear", "axial", "bar_stress"), figure="ground_motion"),
    "11_l_panel": Example("l_panel", ("load", "lift"), figure="l_panel"),
    "12_notched_beam": Example("notched_beam", ("load", "jack", "deflection", "mouth"), figure="notched_beam"),
    "13_spalling_bar": Example("spalling_bar", ("v_a", "v_b", "v_end"), figure="spalling_bar"),
    "14_drop_weight_beam": Example("drop_weight", ("impulse", "hammer_velocity", "deflection")),
    "15_dropped_block": Example("dropped_block", ("impulse",), fragments=True),
    "16_colliding_blocks": Example("collision", ("v_target", "v_missile"), tolerance=1e-6, fragments=True),
}


def thinned(history):
    """Row numbers: evenly over the rows, first and last among them."""
    rows = len(history["time"].values)
    return np.unique(np.linspace(0, rows - 1, min(ROWS, rows)).round().astype(int))


def write_expected(example, run, path):
    history = run.history
    names = [n for n in ("time", "load_time", *example.columns, *COUNTS) if n in history.columns]
    with open(path, "w", newline="", encoding="utf-8") as file:
        out = csv.writer(file, lineterminator="\n")
        out.writerow([f"{n} [{history[n].unit}]" for n in names])
        for i in thinned(history):
            out.writerow([f"{history[n].values[i]:.8g}" for n in names])


def differences(example, run, path):
    """Columns that have left the expected curve: name and mean difference over the range."""
    expected, history = History(path), run.history
    clock = "load_time" if "load_time" in expected.columns else "time"
    time = expected[clock].values
    shared = time <= history[clock].values[-1]
    if shared.mean() < 0.9:
        yield clock, 1.0
    for name in example.columns:
        was = expected[name].values[shared]
        now = np.interp(time[shared], history[clock].values, history[name].values)
        difference = np.abs(now - was).mean() / max(np.ptp(was), 1e-300)
        if difference > example.tolerance:
            yield name, difference


def write_picture(example, run, runs, name, path):
    if example.figure:
        drawn = ROOT / "docs" / "verification" / "figures" / figure_file(example.figure)
        if not drawn.exists():
            figures.FIGURES[example.figure][0](runs, drawn)
        shutil.copyfile(drawn, path)
        return
    times = [t for t, _ in read_pvd(run.folder / "fields.pvd")]
    if example.cracks_before:
        broken = np.flatnonzero(run.history[example.cracks_before].values > 0)
        if broken.size:
            times = [t for t in times if t < run.history["time"].values[broken[0]]]
    moment, scene = picture.make_scene(run, times[-1], "auto", 0.5, example.fragments)
    picture.draw(scene, moment, run.title, 2, path)
    shrink(path)


def main():
    parser = argparse.ArgumentParser(description="Compares the examples with expected.csv, or writes it and picture.png.")
    parser.add_argument("--program", default=str(ROOT / "build" / "fissura"))
    parser.add_argument("--runs", default=str(ROOT / "build" / "verify"))
    parser.add_argument("--update", action="store_true", help="write expected.csv and picture.png")
    parser.add_argument("--only", action="append", metavar="NN", help="examples whose folder begins so")
    parser.add_argument("--long", action="store_true", help="also those that take long")
    parser.add_argument("--cached", action="store_true", help="make no runs")
    parser.add_argument("--jobs", type=int, default=0)
    arguments = parser.parse_args()
    runs = Runs(arguments.program, arguments.runs, arguments.jobs, arguments.cached)
    chosen = {n: e for n, e in EXAMPLE.items() if not arguments.only or n.startswith(tuple(arguments.only))}
    if not arguments.long:
        chosen = {n: e for n, e in chosen.items() if not runs.specs[e.run].long or runs.is_cached(e.run)}
    runs.make([e.run for e in chosen.values()])
    trouble = 0
    for name, example in chosen.items():
        expected = EXAMPLES / name / "expected.csv"
        try:
            run = runs.get(example.run)
            if arguments.update:
                write_expected(example, run, expected)
                write_picture(example, run, runs, name, EXAMPLES / name / "picture.png")
                print(f"{name}: written")
                continue
            left = list(differences(example, run, expected))
            print(f"{name}: " + ("as expected" if not left else ", ".join(f"{c} differs by {d:.2g} of its range" for c, d in left)))
            trouble += bool(left)
        except (RunFailed, BadFile, OSError) as error:
            print(f"{name}: {error}")
            trouble += 1
    sys.exit(1 if trouble else 0)


if __name__ == "__main__":
    main()
