#!/usr/bin/python3
"""Draws the material laws for the theory pages, from the curves that build/law_curves computes with the program's own functions.

    tools/law_figures.py build/law_curves [--out docs/theory/figures]
"""
import argparse
import csv
import subprocess
from collections import defaultdict
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

ROOT = Path(__file__).resolve().parent.parent
plt.rcParams.update({"font.size": 9, "axes.grid": True, "grid.alpha": 0.3, "axes.spines.top": False, "axes.spines.right": False,
                     "legend.frameon": False})
CONCRETE = "f_t = 3 MPa, G_f = 100 N/m, p = 600 GPa, h = 50 mm"
STEEL = "E_s = 200 GPa, f_y = 420, f_u = 550 MPa, eps_u = 10 %, eps_br = 12 %"


def curves_of(program):
    """{(curve, branch): ([x], [y])}"""
    text = subprocess.run([program], capture_output=True, text=True, check=True).stdout
    found = defaultdict(lambda: ([], []))
    for line in csv.DictReader(text.splitlines()):
        xs, ys = found[line["curve"], line["branch"]]
        xs.append(float(line["x"]))
        ys.append(float(line["y"]))
    return found


def panel(axes, curves, curve, labels, x, y, title):
    for branch, label in labels.items():
        axes.plot(*curves[curve, branch], lw=1.4, label=label)
    axes.set_xlabel(x)
    axes.set_ylabel(y)
    axes.set_title(title, fontsize=9)
    if any(labels.values()):
        axes.legend()


def save(figure, folder, name):
    figure.tight_layout()
    figure.savefig(folder / f"{name}.png", dpi=110)
    plt.close(figure)


def draw(curves, folder):
    figure, axes = plt.subplots(figsize=(5.2, 3.2))
    panel(axes, curves, "softening", {"": ""}, "damage D [-]", "share of the strength z [-]", "Eq. 15; the area below is 0.386")
    save(figure, folder, "softening")

    figure, (left, right) = plt.subplots(1, 2, figsize=(10, 3.6))
    panel(left, curves, "tension", {"": ""}, "opening [micrometre]", "normal stress [MPa]", "pulled, closed twice, pulled apart")
    left.set_ylim(-2, 3.3)
    panel(right, curves, "shear", {"10": "10 MPa of pressure", "5": "5 MPa", "0": "none"}, "sliding [micrometre]", "shear stress [MPa]",
          "slid, back by 15 micrometres, and on: friction stays")
    figure.suptitle(f"{CONCRETE}; c = 7 MPa, phi = 36 degrees, G_s = 300 N/m, mu = 0.6", fontsize=9)
    save(figure, folder, "cohesive")

    for law, title in (("kato", "Kato, eps_sh = 1.5 %"), ("menegotto_pinto", "Menegotto-Pinto")):
        figure, (left, right) = plt.subplots(1, 2, figsize=(10, 3.6))
        panel(left, curves, law, {"pulled": ""}, "strain [%]", "stress [MPa]", "pulled until it breaks")
        panel(right, curves, law, {"cycled": ""}, "strain [%]", "stress [MPa]", "0, 2, 0, 3, -1, 5 %")
        figure.suptitle(f"{title}; {STEEL}", fontsize=9)
        save(figure, folder, f"steel_{law}")

    figure, axes = plt.subplots(figsize=(6.2, 3.6))
    panel(axes, curves, "bond", {"alone": "one crack alone", "l_cr": "cracks at l_cr = 5 D"}, "slip out of each face of the crack [mm]",
          "strain of the bar at the crack [%]", "bar of 16 mm, f_c = 30 MPa, sigma_cr = 40 MPa; pulled, let back, pulled on")
    save(figure, folder, "bond_slip")

    figure, (left, right) = plt.subplots(1, 2, figsize=(10, 3.6))
    labels = {"0.1": "S = 0.1 mm", "1": "S = 1 mm"}
    panel(left, curves, "dowel", labels, "offset of each face across the bar [mm]", "dowel force [kN]", "bar of 16 mm, f_y = 420 MPa, f_c = 30 MPa; there, back to 0.1 mm, and on")
    panel(right, curves, "dowel_strength", labels, "offset of each face across the bar [mm]", "share of f_y that is left [-]", "what shear leaves for tension (Eq. 24)")
    save(figure, folder, "dowel")

    figure, axes = plt.subplots(figsize=(5.2, 3.2))
    panel(axes, curves, "rate", {"": ""}, "strain rate [1/s]", "factor on f_t and cohesion [-]", "fib Model Code 2010")
    axes.set_xscale("log")
    save(figure, folder, "rate_factor")


def main():
    parser = argparse.ArgumentParser(description="Draws the material laws for the theory pages.")
    parser.add_argument("program", help="build/law_curves")
    parser.add_argument("--out", default=str(ROOT / "docs" / "theory" / "figures"))
    arguments = parser.parse_args()
    folder = Path(arguments.out)
    folder.mkdir(parents=True, exist_ok=True)
    draw(curves_of(arguments.program), folder)


if __name__ == "__main__":
    main()
