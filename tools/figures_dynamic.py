"""Figures of the dynamic examples: the spalling bar, the column on its shaken foot."""
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
import picture
import verify_dynamics as dynamics
import verify_measures as measure
from figure_parts import THEORY, axes_of, crack_pictures, save


def spalling_bar(runs, out):
    """The bar at four moments: the pulse has arrived, the first piece leaves, others follow."""
    run = runs.get("spalling_bar")
    scenes, titles = [], []
    for time in (0.75e-3, 0.85e-3, 1e-3, 1.2e-3):
        moment, scene = picture.make_scene(run, time, 40.0, 0.5)
        scenes.append(scene)
        titles.append(f"t = {1e3 * moment:.2f} ms")
    first = dynamics.first_spall(run)
    crack_pictures(scenes, titles, f"Spalling bar (displacements x 40): first piece {1e3 * first:.0f} mm, formula "
                                   f"{1e3 * dynamics.spall_length():.0f} mm", out)


def ground_motion(runs, out):
    """Column on its shaken foot: sway, linear with one degree of freedom beside, and cracking; the ground below."""
    linear, cracking, static = (runs.get(f"column_{n}") for n in ("linear", "quake", "static"))
    figure, (axes, below) = axes_of("", "sway of the head [mm]", size=(8, 6.5), rows=(3, 1))
    for run, label, colour in ((linear, "uncracked column", "C0"), (cracking, "cracking column", "C3")):
        time, x = dynamics.sway(run)
        axes.plot(time, 1e3 * x, lw=1.2, color=colour, label=label)
    time, x = dynamics.one_degree(dynamics.frequency(static), measure.column(linear, "time")[-1] - dynamics.START)
    axes.plot(time, 1e3 * x, label="one degree of freedom", **THEORY)
    t, a, _ = dynamics.ground()
    below.plot(t, a / dynamics.GRAVITY, lw=0.8, color="black")
    below.set_xlabel("time since the start of the record [s]")
    below.set_ylabel("ground [g]")
    below.set_xlim(axes.get_xlim())
    save(figure, axes, "Column under a ground motion", out)


FIGURES = {"spalling_bar": (spalling_bar, ("spalling_bar",)),
           "ground_motion": (ground_motion, ("column_linear", "column_quake", "column_static"))}
