#!/usr/bin/python3
"""Draws columns of a run's history.csv against each other, with their units, as a PNG.

    plot_history.py runs/demo --x deflection --y load -o curve.png
"""
import argparse
import sys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
matplotlib.rcParams["text.parse_math"] = False  # a dollar in a name is a dollar
import matplotlib.pyplot as plt
import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parent))
from fissura_io import BadFile, Run, printable, run_tool

SCALES = {"m": (1e3, "mm"), "Pa": (1e-6, "MPa"), "N": (1e-3, "kN")}


def shown(column):
    """Values and unit as an engineer reads them: mm, MPa and kN instead of m, Pa and N."""
    factor, unit = SCALES.get(column.unit, (1, column.unit))
    return column.values * factor, unit


def label(name, unit):
    return printable(name.replace("_", " ") + ("" if unit == "-" else f" [{unit}]"))


def draw(history, x, ys, out, title):
    figure, axes = plt.subplots(figsize=(7, 4.5), dpi=130)
    xs, x_unit = shown(history[x])
    units = []
    for name in ys:
        values, unit = shown(history[name])
        units.append(unit)
        axes.plot(xs, values, lw=1.3, label=label(name, unit))
    axes.set_xlabel(label(x, x_unit))
    # One axis: several curves share it only if they share the unit; else each names its own in the legend.
    axes.set_ylabel(label(ys[0], units[0]) if len(ys) == 1 else f"[{units[0]}]" if len(set(units)) == 1 else "")
    if len(ys) > 1:
        axes.legend()
    axes.set_title(printable(title)[:120])
    axes.grid(alpha=0.3)
    figure.tight_layout()
    figure.savefig(out)


def peak(history, x, y):
    """A sentence with the largest magnitude of y, as a mean over five rows where there are enough, and where it stands: the shock of a
    crack, which lasts a row or two, is not the strength of a member."""
    values, unit = shown(history[y])
    xs, x_unit = shown(history[x])
    width = 5 if values.size >= 100 else 1
    means = np.convolve(values, np.ones(width) / width, "valid")
    if not np.isfinite(means).any():
        return f"peak {y}: none, it holds no number"
    i = int(np.nanargmax(np.abs(means)))
    largest = values[int(np.nanargmax(np.abs(values)))]
    single = f" (mean of {width} rows; largest single reading {largest:.4g} {unit})" if width > 1 else ""
    return f"peak {y}: {means[i]:.4g} {unit} at {x} {xs[i + width // 2]:.4g} {x_unit}{single}"


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("run", help="run folder")
    parser.add_argument("--x", default="time", help="column, with or without its unit")
    parser.add_argument("--y", action="append", required=True, help="column; may be given several times")
    parser.add_argument("--title", help="default: that of the case")
    parser.add_argument("--peak", action="store_true", help="print the largest magnitude of each y")
    parser.add_argument("-o", "--out", required=True, help="PNG to write")
    arguments = parser.parse_args()
    run = Run(arguments.run)
    history = run.history
    if history["time"].values.size == 0:
        raise BadFile(f"{history.path}: no rows yet")
    draw(history, arguments.x, arguments.y, arguments.out, arguments.title or run.title)
    if arguments.peak:
        for y in arguments.y:
            print(printable(peak(history, arguments.x, y)))
    print(printable(f"curve: {arguments.out}"))


if __name__ == "__main__":
    run_tool("plot", main)
