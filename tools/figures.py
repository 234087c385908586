#!/usr/bin/python3
"""Draws figures from runs, with theory, tests and the paper's values beside: the founding paper's under its numbers, others under
names.

    figures.py --program build/fissura              those of the short runs, and of long ones that are there
    figures.py --program build/fissura --long       all: makes the long runs too
    figures.py --only 21 --only l_panel             some
"""
import argparse
import sys
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parent))
import figures_cyclic
import figures_dynamic
import picture
import verify_measures as measure
from figure_parts import THEORY, axes_of, crack_pictures, save, wide
from fissura_io import BadFile, read_pvd
from verify_page import figure_file
from verify_runs import ROOT, RunFailed, Runs


def pull(axes, runs, curves, stiffness):
    """Force over elongation of runs pulled at both ends, and the theory's straight line."""
    longest = 0
    for name, label, style in curves:
        run = runs.get(name)
        u = measure.column(run, "u_right") - measure.column(run, "u_left")
        longest = max(longest, u[-1])
        axes.plot(1e6 * u, measure.column(run, "force") / 1e3, label=label, **style)
    axes.plot([0, 1e6 * longest], [0, stiffness * longest / 1e3], label="theory", **THEORY)
    axes.set_xlim(0)
    axes.set_ylim(0)


def fig13(runs, out):
    """Prism in tension: meshes, with and without joints."""
    figure, axes = axes_of("elongation [micrometre]", "force [kN]")
    curves = [("prism_A", "mesh A, no joints", {"color": "C0", "lw": 3, "alpha": 0.5}),
              ("prism_B", "mesh B, no joints", {"color": "C0", "lw": 1}),
              ("prism_A_20", "mesh A, joints, p = 20 E", {"color": "C3", "lw": 3, "alpha": 0.5}),
              ("prism_B_20", "mesh B, joints, p = 20 E", {"color": "C3", "lw": 1})]
    pull(axes, runs, curves, measure.PRISM_STIFFNESS / 1.0)
    save(figure, axes, "Figure 13: prism in tension, two meshes", out)


def penalties(prefix):
    return [(f"{prefix}_{p}", f"p = {p} E", {"color": f"C{i}", "lw": 1.3}) for i, p in enumerate((20, 60, 100))]


def fig14(runs, out):
    """Prism in tension: penalties."""
    figure, axes = axes_of("elongation [micrometre]", "force [kN]")
    pull(axes, runs, penalties("prism_B"), measure.PRISM_STIFFNESS / 1.0)
    save(figure, axes, "Figure 14: prism in tension, mesh B, three penalties", out)


def fig17(runs, out):
    """Oscillation of the beam under its own weight with the paper's viscosity."""
    figure, axes = axes_of("time [s]", "deflection at midspan [mm]")
    run = runs.get("self_weight_A_viscous")
    axes.plot(measure.column(run, "time"), 1e3 * measure.column(run, "deflection"), lw=0.7, label="mesh A, viscosity 7e6 Pa s")
    axes.axhline(1e3 * measure.TIMOSHENKO, label="Timoshenko at rest: 0.729 mm", **THEORY)
    axes.axhline(0.723, color="C1", lw=1, ls=":", label="paper's mesh C at rest: 0.723 mm")
    axes.set_xlim(0)
    save(figure, axes, "Figure 17: beam under its own weight", out)


def fig19(runs, out):
    """Elastic tie: penalties."""
    figure, axes = axes_of("elongation [micrometre]", "force [kN]")
    pull(axes, runs, penalties("elastic_tie"), measure.TIE_STIFFNESS / measure.TIE_LENGTH)
    save(figure, axes, "Figure 19: elastic tie, three penalties", out)


SIZES = {"A": "30 cm", "B": "15 cm", "C": "10 cm", "D": "7.5 cm"}


def fig21(runs, out):
    """Tie to failure: average stress over average strain."""
    figure, axes = axes_of("average strain [%]", "average stress F/A [MPa]")
    inset = axes.inset_axes([0.36, 0.10, 0.46, 0.50])
    for i, (mesh, size) in enumerate(SIZES.items()):
        run = runs.get(f"tie_{mesh}")
        strain = 100 * measure.column(run, "elongation")
        stress = measure.column(run, "force") / measure.TIE_AREA / 1e6
        # After the rupture the halves recoil: not part of the curve.
        end = measure.first(measure.column(run, "bars_broken") > 0) or len(strain)
        axes.plot(strain[:end], stress[:end], lw=0.9, color=f"C{i}", label=f"mesh {mesh}, h = {size}")
        inset.plot(strain[:end], stress[:end], lw=0.8, color=f"C{i}")
    right = axes.get_xlim()[1]
    for value, text in ((3.18, "cracking 3.18"), (5.30, "yield 5.30"), (6.50, "ultimate 6.50")):
        axes.axhline(value, **{**THEORY, "lw": 0.8})
        axes.text(1.04 * right, value + 0.08, text + " MPa", ha="right", fontsize=8)
    axes.set_xlim(0, 1.05 * right)
    axes.set_ylim(0, 7.4)
    inset.plot([0, 0.252], [0, 5.3], **THEORY)
    inset.set_xlim(0, 0.3)
    inset.set_ylim(0, 6)
    inset.tick_params(labelsize=7)
    inset.set_title("up to yield; dashed: the bare bar", fontsize=7)
    save(figure, axes, "Figure 21: tie to failure, four meshes", out)


def fig22(runs, out):
    """Tie to failure: cracks of the four meshes."""
    scenes, titles = [], []
    for mesh, size in SIZES.items():
        run = runs.get(f"tie_{mesh}")
        # The last frame before the bar ruptures.
        broken = measure.first(measure.column(run, "bars_broken") > 0)
        until = measure.column(run, "time")[broken] if broken else np.inf
        times = [t for t, _ in read_pvd(run.folder / "fields.pvd") if t < until]
        moment, scene = picture.make_scene(run, times[-1], 1.0, 0.5)
        scenes.append(wide(scene, 0.5))
        titles.append(f"mesh {mesh}, h = {size}, t = {moment:.3f} s")
    crack_pictures(scenes, titles, "Figure 22: cracks of the tie wider than 0.5 mm before the bar ruptures", out)


def beam_curve(run):
    """Load [kN] as read and as mean over 10 ms, and deflection [mm], from the start of `push`."""
    begin = measure.push_begins(run)
    time = measure.clock(run)[begin:]
    load = measure.column(run, "load")[begin:] / 1e3
    return load, measure.running_mean(time, load, measure.SHOCK), 1e3 * measure.column(run, "deflection")[begin:]


BEAM_RUNS = (("four_point", "36x4x8 cells, p = 20 E", "C0"), ("four_point_60", "36x4x8 cells, p = 60 E", "C2"),
             ("four_point_unstructured", "unstructured, 30 mm", "C3"))


def beam_runs(runs):
    found = [(runs.get(name), label, colour) for name, label, colour in BEAM_RUNS if name not in runs.failed]
    if not found:
        raise RunFailed("no run of the four-point beam")
    return found


def fig31(runs, out):
    """Four-point beam: load over deflection."""
    figure, axes = axes_of("deflection at midspan [mm]", "load [kN]")
    for run, label, colour in beam_runs(runs):
        load, mean, w = beam_curve(run)
        axes.plot(w, load, lw=0.4, color=colour, alpha=0.4)
        axes.plot(w, mean, lw=1.4, color=colour, label=f"{label} (mean over 10 ms)")
    axes.axhspan(54.7, 57.6, color="grey", alpha=0.25, label="section analysis, yield: 54.7 to 57.6 kN")
    axes.axhline(56, color="C1", lw=1, ls=":", label="paper, yield: 56 kN")
    axes.axhline(64.3, color="C1", lw=1, ls="--", label="paper, failure: 64.3 kN")
    axes.axhline(65.0, color="black", lw=1, label="test, failure: 65.0 kN")
    axes.plot([25], [57.5], "k+", label="cracked section at 57.5 kN (upper reference)")
    axes.set_xlim(0)
    axes.set_ylim(0, 80)
    save(figure, axes, "Figure 31: four-point beam", out)


def fig32(runs, out):
    """Four-point beam: stress of the bars at midspan."""
    figure, axes = axes_of("load [kN]", "stress of the bottom bars at midspan [MPa]")
    for run, label, colour in beam_runs(runs):
        _, mean, _ = beam_curve(run)
        stress = measure.column(run, "steel_stress")[-len(mean):] / 1e6
        axes.plot(mean[:int(np.argmax(mean)) + 1], stress[:int(np.argmax(mean)) + 1], lw=1.2, color=colour, label=label)
    # Cracked section: z = 0.19 m, M = 1.25 m load/2 and 1.81 kNm of self-weight.
    load = np.array([10.0, 56.0])
    axes.plot(load, (1.25 * load / 2 + 1.81) * 1e3 / (4.52e-4 * 0.19) / 1e6, label="cracked section, lever arm 0.19 m", **THEORY)
    axes.axhline(420, color="grey", lw=0.8, label="f_y = 420 MPa")
    axes.axvline(56, color="C1", lw=1, ls=":", label="paper, yield: 56 kN")
    axes.set_xlim(0)
    axes.set_ylim(0)
    save(figure, axes, "Figure 32: stress of the reinforcement at midspan", out)


def fig33(runs, out):
    """Four-point beam: cracks just before the collapse; one picture per mesh."""
    for run, label, _ in beam_runs(runs):
        if "60 E" in label:
            continue
        _, mean, w = beam_curve(run)
        time = measure.column(run, "time")[-len(mean):]
        top = time[int(np.argmax(np.where(time < time[-1] - measure.SHOCK / 2, mean, 0)))]
        frames = [t for t, _ in read_pvd(run.folder / "fields.pvd")]
        scenes, titles = [], []
        for t in sorted({*[t for t in frames if t <= top][-3:], frames[-1]}):
            moment, scene = picture.make_scene(run, t, 5.0, 0.5)
            scenes.append(scene)
            state = "collapse" if t == frames[-1] and mean[-1] < 0.9 * mean.max() else f"load {np.interp(moment, time, mean):.1f} kN"
            titles.append(f"{state}, deflection {np.interp(moment, time, w):.1f} mm")
        heading = f"Figure 33: cracks before the collapse, {label} (displacements x 5)"
        crack_pictures(scenes, titles, heading, out.with_stem(out.stem + "_unstructured") if "unstructured" in label else out)


PAPER = {13: (fig13, ("prism_A", "prism_B", "prism_A_20", "prism_B_20")),
         14: (fig14, tuple(f"prism_B_{p}" for p in (20, 60, 100))),
         17: (fig17, ("self_weight_A_viscous",)),
         19: (fig19, tuple(f"elastic_tie_{p}" for p in (20, 60, 100))),
         21: (fig21, tuple(f"tie_{m}" for m in "ABCD")),
         22: (fig22, tuple(f"tie_{m}" for m in "ABCD")),
         31: (fig31, tuple(b[0] for b in BEAM_RUNS)),
         32: (fig32, tuple(b[0] for b in BEAM_RUNS)),
         33: (fig33, tuple(b[0] for b in BEAM_RUNS))}
FIGURES = PAPER | figures_cyclic.FIGURES | figures_dynamic.FIGURES


def main():
    parser = argparse.ArgumentParser(description="Draws the figures of the verification page from runs.")
    parser.add_argument("--program", default=str(ROOT / "build" / "fissura"))
    parser.add_argument("--runs", default=str(ROOT / "build" / "verify"))
    parser.add_argument("--out", default=str(ROOT / "docs" / "verification" / "figures"))
    parser.add_argument("--only", action="append", choices=FIGURES, metavar="N", type=lambda n: int(n) if n.isdigit() else n,
                        help="this figure only: a number of the paper, or a name")
    parser.add_argument("--long", action="store_true", help="also make the long runs")
    parser.add_argument("--cached", action="store_true", help="make no runs")
    parser.add_argument("--jobs", type=int, default=0)
    arguments = parser.parse_args()
    runs = Runs(arguments.program, arguments.runs, arguments.jobs, arguments.cached)
    chosen = arguments.only or list(FIGURES)
    needed = list(dict.fromkeys(name for n in chosen for name in FIGURES[n][1]))
    dear = [name for name in needed if runs.specs[name].long and not arguments.long]
    runs.make([name for name in needed if name not in dear])
    runs.failed.update({name: f"{name} takes long: add --long" for name in dear if not runs.is_cached(name)})
    Path(arguments.out).mkdir(parents=True, exist_ok=True)
    for number in chosen:
        out = Path(arguments.out) / figure_file(number)
        try:
            FIGURES[number][0](runs, out)
            print(f"figure {number}: {out}")
        except (RunFailed, BadFile, OSError) as error:
            print(f"figure {number}: not drawn: {error}")


if __name__ == "__main__":
    main()
