"""Figures of cyclic and plain-concrete examples: the paper's 26 to 28, the column, Winkler's panel, the notched beam."""
import sys
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parent))
import picture
import verify_measures as measure
from figure_parts import THEORY, axes_of, crack_pictures, save
from verify_runs import RunFailed

MESHES = (("cyclic_tie_coarse", "coarse mesh", "C0"), ("cyclic_tie_fine", "fine mesh", "C3"))
OTHER_LAW = (("cyclic_tie_coarse_mp", "coarse mesh, Menegotto-Pinto", "C2"), ("cyclic_tie_fine_mp", "fine mesh, Menegotto-Pinto", "C1"))


def present(runs, wanted):
    """Of the runs wanted those that are there; at least one."""
    found = [(runs.get(name), label, colour) for name, label, colour in wanted if name not in runs.failed]
    if not found:
        raise RunFailed("none of its runs is there")
    return found


def fig26(runs, out):
    """Cyclic tie: cracks at 1.5 % of mean strain."""
    scenes, titles = [], []
    for run, label, _ in present(runs, MESHES):
        strain, time = measure.column(run, "mean_strain"), measure.column(run, "time")
        moment, scene = picture.make_scene(run, time[int(np.argmax(strain))], 5.0, 0.5)
        scenes.append(scene)
        titles.append(f"{label}, mean strain {100 * np.interp(moment, time, strain):.2f} %")
    crack_pictures(scenes, titles, "Figure 26: cracks of the cyclic tie (displacements x 5)", out)


def fig27(runs, out):
    """Cyclic tie: strain of the bar at a crack over its normalised slip."""
    figure, axes = axes_of("normalised slip", "strain of the bar at the crack [%]")
    for run, label, colour in present(runs, MESHES):
        axes.plot(measure.column(run, "slip"), 100 * measure.column(run, "steel_strain"), lw=1, color=colour, label=label)
    axes.axhline(100 * measure.TIE_YIELD / 190e9, color="grey", lw=0.7, ls=":")
    axes.axhline(1.65, color="grey", lw=0.7, ls=":", label="yield strain; start of hardening")
    axes.set_xlim(0)
    axes.set_ylim(0)
    save(figure, axes, "Figure 27: slip and strain at the notch next to the middle", out)


def fig28(runs, out):
    """Cyclic tie: force of the bar at a crack over the mean strain of the tie."""
    figure, axes = axes_of("mean strain [%]", "force of the bar at the crack [kN]")
    for run, label, colour in present(runs, MESHES + OTHER_LAW[:1]):
        axes.plot(100 * measure.column(run, "mean_strain"), measure.TIE_BAR * measure.column(run, "steel_stress") / 1e3, lw=0.9,
                  color=colour, label=label)
    axes.axhline(100.3, label="A_s f_y = 100.3 kN", **THEORY)
    axes.axhline(0, color="black", lw=0.6)
    save(figure, axes, "Figure 28: steel force and mean strain of the cyclic tie", out)


def column_loops(runs, out):
    """Cyclic column: shear over drift, and below the axial load at the base."""
    run = runs.get("cyclic_column")
    time = measure.column(run, "time")
    figure, (axes, below) = axes_of("drift [%]", "shear at the base [kN]", size=(7, 7), rows=(3, 1))
    shear = measure.running_mean(time, measure.column(run, "base_shear") / 1e3, 2e-3)
    axes.plot(100 * measure.column(run, "drift") / 1.25, shear, lw=0.9, label="mean over 2 ms")
    axes.axhline(0, color="black", lw=0.6)
    axes.axvline(0, color="black", lw=0.6)
    axial = measure.column(run, "axial") / 1e3
    below.plot(time, axial, lw=0.3, color="C0", alpha=0.5, label="reading")
    below.plot(time, measure.running_mean(time, axial, measure.SHOCK), lw=1.2, color="C3", label="mean over 10 ms")
    below.axhspan(0.95 * 250, 1.05 * 250, color="grey", alpha=0.25, label="250 kN, 5 %")
    below.set_xlabel("time [s]")
    below.set_ylabel("axial load\nat the base [kN]")
    below.set_ylim(225, 275)
    below.legend(fontsize=7, loc="lower right")
    save(figure, axes, "Column under cyclic drift and axial load", out)


def column_steel(runs, out):
    """Cyclic column: stress of a bar at the base over its strain."""
    run = runs.get("cyclic_column")
    figure, axes = axes_of("strain of the bar at the base [%]", "stress [MPa]")
    for side, colour in (("left", "C0"), ("right", "C3")):
        axes.plot(100 * measure.column(run, f"strain_{side}"), measure.column(run, f"stress_{side}") / 1e6, lw=0.8, color=colour,
                  label=f"bar on the {side}")
    for sign in (1, -1):
        axes.axhline(sign * 420, **(THEORY | ({"label": "f_y = 420 MPa"} if sign > 0 else {})))
    save(figure, axes, "Column under cyclic drift: steel at the base (Menegotto-Pinto)", out)


def l_panel(runs, out):
    """Winkler's L-panel: load over lift, the test beside."""
    figure, axes = axes_of("lift [mm]", "load [kN]")
    for run, label, colour in present(runs, (("l_panel", "G_f = 65 N/m", "C0"), ("l_panel_90", "G_f = 90 N/m", "C3"))):
        lift, load = measure.l_panel_curve(run)
        axes.plot(lift, load, lw=1.2, color=colour, label=label)
    test = measure.L_PANEL_TEST
    axes.plot(test[1:, 0], test[1:, 1] / 1e3, "ko-", ms=3, lw=0.6, label="test (Winkler)")
    axes.plot([0, 0.12], [0, 0.12 * 59.0], label="elastic, plane stress: 59 kN/mm", **THEORY)
    axes.set_xlim(0, 1.02)
    axes.set_ylim(0, 9)
    save(figure, axes, "L-panel", out)


def notched_beam(runs, out):
    """Notched beam: load over deflection."""
    figure, axes = axes_of("deflection [mm]", "load [N]")
    for run, label, colour in present(runs, (("notched_beam_coarse", "cells of 20 mm", "C2"), ("notched_beam", "cells of 10 mm", "C0"),
                                             ("notched_beam_unstructured", "unstructured", "C3"))):
        load = measure.running_mean(measure.column(run, "time"), measure.column(run, "jack"), 3e-3)
        work = measure.notched_beam(run)["work"]
        axes.plot(1e3 * measure.column(run, "deflection"), load, lw=1.1, color=colour, label=f"{label}: {work:.1f} N/m")
    axes.set_xlim(0, 2.5)
    axes.set_ylim(0)
    save(figure, axes, "Notched beam: work of fracture over the ligament, G_f = 137 N/m", out)


TIES = tuple(name for name, _, _ in MESHES)
FIGURES = {26: (fig26, TIES), 27: (fig27, TIES), 28: (fig28, TIES + ("cyclic_tie_coarse_mp",)),
           "cyclic_column": (column_loops, ("cyclic_column",)), "cyclic_column_steel": (column_steel, ("cyclic_column",)),
           "l_panel": (l_panel, ("l_panel", "l_panel_90")),
           "notched_beam": (notched_beam, ("notched_beam_coarse", "notched_beam", "notched_beam_unstructured"))}
