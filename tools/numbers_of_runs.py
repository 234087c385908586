"""What the pages say of runs beyond the rows of the verification: quantities by run and name, in the unit that the name says."""
import sys
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parent))
import examples
import verify_checks
import verify_measures as measure
from verify_measures import column, first

# Of run.json, for any run.
SUMMARY = {
    "tets": lambda s: s["tets"],
    "joints": lambda s: s["joints"],
    "bar elements": lambda s: s["bar_elements"],
    "bar joints": lambda s: s["bar_joints"],
    "steps": lambda s: s["steps"],
    "time step [us]": lambda s: 1e6 * s["dt"],
    "end [ms]": lambda s: 1e3 * s["time"],
    "energy residual [%]": lambda s: abs(100 * s["energy_residual"]),
    "largest kinetic over internal [%]": lambda s: 100 * s["max_kinetic_ratio"],
    "quiet readings [%]": lambda s: 100 * s["quasi_static_share"],
    "forces out of balance [%]": lambda s: 100 * s["force_imbalance"],
    "joints cracked": lambda s: s["joints_cracked"],
    "joints broken": lambda s: s["joints_broken"],
    "bar joints yielded": lambda s: s["bar_joints_yielded"],
    "bars broken": lambda s: s["bars_broken"],
    "vibration [ms]": lambda s: 1e3 * s["vibration_period"],
    "fragments": lambda s: s["fragments"]["count"],
    "added mass [%]": lambda s: 100 * s["added_mass"] / (s["total_mass"] - s["added_mass"]),
}
for _account in ("kinetic", "friction", "contact_friction", "fracture_I", "bond_steel", "mass_damping"):
    SUMMARY[f"energy {_account} [J]"] = lambda s, a=_account: s["energy"][a]
    SUMMARY[f"energy {_account} [kJ]"] = lambda s, a=_account: 1e-3 * s["energy"][a]
# Counts of what does not depend on how it cracks.
EXACT = ("tets", "joints", "bar elements", "bar joints", "time step [us]", "bars broken")

KILO, MILLI = 1e-3, 1e3


def peak(name, factor=1.0):
    return lambda run: factor * np.abs(column(run, name)).max()


def last(name, factor=1.0):
    return lambda run: factor * column(run, name)[-1]


def when(count, name, factor=1.0, window=0.0):
    """A reading where a count leaves zero; as a mean over `window` seconds of the loads' time."""
    def read(run):
        values = column(run, name)
        if window:
            values = measure.running_mean(measure.clock(run), values, window)
        return factor * values[first(column(run, count) > 0)]
    return read


def demo_quantities():
    for key, text in (("cracking", "load at the first crack [kN]"), ("yield", "load at first yield [kN]"), ("maximum", "largest load [kN]"),
                      ("cracking_deflection", "deflection at the first crack [mm]"), ("yield_deflection", "deflection at first yield [mm]"),
                      ("maximum_deflection", "deflection at the largest load [mm]")):
        yield text, lambda run, key=key: measure.demo(run)[key]
    for key, text in (("cracking", "first crack by hand [kN]"), ("yield", "yield by hand [kN]"), ("strength", "strength by hand [kN]"), ("arm", "arm at yield [mm]")):
        yield text, lambda run, key=key: measure.demo_by_hand()[key]
    yield "arm at yield over depth", lambda run: measure.demo_by_hand()["arm"] / (1e3 * measure.DEMO_D)
    yield "first crack over that by hand [%]", lambda run: 100 * (measure.demo(run)["cracking"] / measure.demo_by_hand()["cracking"] - 1)
    yield "yield over that by hand [%]", lambda run: 100 * (measure.demo(run)["yield"] / measure.demo_by_hand()["yield"] - 1)
    yield "strength over that by hand [%]", lambda run: 100 * (measure.demo(run)["maximum"] / measure.demo_by_hand()["strength"] - 1)
    yield "largest single reading [kN]", peak("load", KILO)
    yield "largest stress of the bars [MPa]", peak("steel_stress", 1e-6)
    yield "crack width at first yield [mm]", when("bar_joints_yielded", "crack_width", MILLI)
    yield "crack width at the largest load [mm]", lambda run: MILLI * np.interp(measure.demo(run)["maximum_deflection"], MILLI * column(run, "deflection"), column(run, "crack_width"))
    yield "largest pace", peak("pace")


def tie_quantities():
    for i, level in enumerate(measure.TIE_LEVELS):
        yield f"force at {100 * level:g} % [kN]", lambda run, i=i: measure.tie_peaks(run)[i]


def four_point_quantities(window=measure.SHOCK):
    for key, text in (("yield", "load at first yield [kN]"), ("failure", "failure load [kN]")):
        yield text, lambda run, key=key: measure.four_point(run, window)[key]


def slow_quantities():
    return four_point_quantities(5 * measure.SHOCK)


def largest_mean(name, window):
    return lambda run: KILO * np.abs(measure.running_mean(column(run, "time"), column(run, name), window)).max()


def drop_quantities():
    yield "largest mean over 1 ms [kN]", largest_mean("impact_force", 1e-3)
    yield "time of the largest deflection [ms]", lambda run: MILLI * column(run, "time")[np.argmax(column(run, "deflection"))]
    yield "time of first yield [ms]", when("bar_joints_yielded", "time", MILLI)
    yield "error of the impulse balance", lambda run: abs(measure.drop_weight(run)["balance"]) / 100
    yield "error of the force's integral", lambda run: abs(measure.drop_weight(run)["curve"]) / 100


def floor_force(run):
    """Of the dropped block, from its impulse: vertical, as means over each row of the history [kN]."""
    return KILO * np.gradient(column(run, "impulse"), column(run, "time"))


def block_quantities():
    yield "largest force of the floor [kN]", lambda run: np.abs(floor_force(run)).max()
    yield "largest mean over 1 ms [kN]", lambda run: np.abs(measure.running_mean(column(run, "time"), floor_force(run), 1e-3)).max()


def column_quantities():
    for turn in range(1, 9):
        yield f"shear at turn {turn} [kN]", lambda run, turn=turn: abs(measure.column_cycles(run)[turn - 1][1])
    for key, text in (("axial_low", "least axial load [kN]"), ("axial_high", "largest axial load [kN]")):
        yield text, lambda run, key=key: KILO * measure.COLUMN_AXIAL * measure.cyclic_column(run)[key]


FAMILIES = {"drop_weight": drop_quantities, "dropped_block": block_quantities, "cyclic_column": column_quantities, "demo": demo_quantities, "cyclic_tie_coarse": tie_quantities, "cyclic_tie_fine": tie_quantities, "cyclic_tie_coarse_mp": tie_quantities,
            "four_point_steady": four_point_quantities, "four_point_slow": slow_quantities}


def of_rows(rows):
    """Further rows, over those of the verification: extremes that a page tells in one number."""
    def over(case, quantity, chosen, extreme):
        runs = list(dict.fromkeys(name for c in chosen for name in c.runs))
        place = {name: i for i, name in enumerate(runs)}
        return verify_checks.Check(case, quantity, float("nan"), verify_checks.INFORMATION,
                                   lambda *r: extreme(c.measure(*(r[place[name]] for name in c.runs)) for c in chosen), tuple(runs))
    residuals = [c for c in rows if "energy residual" in c.quantity]
    peaks = [c for c in rows if c.case == "cyclic_tie" and c.quantity.startswith("force at") and "fine over coarse" in c.quantity]
    works = {c.runs[0]: c for c in rows if c.case == "notched_beam" and c.quantity.startswith("work of the jack")}
    pair = works["notched_beam"], works["notched_beam_unstructured"]
    yield verify_checks.Check("notched_beam", "work of the unstructured mesh over that of cells of 10 mm [%]", float("nan"), verify_checks.INFORMATION,
                              lambda a, b: 100 * (pair[1].measure(b) / pair[0].measure(a) - 1), ("notched_beam", "notched_beam_unstructured"))
    yield over("all", "largest energy residual [%]", residuals, max)
    yield over("peaks", "least of the fine mesh over the coarse", peaks, min)
    yield over("peaks", "largest of the fine mesh over the coarse", peaks, max)


def of_run(name):
    """{quantity: function of the run} of a run of verify_runs.py."""
    return dict(FAMILIES[name]()) if name in FAMILIES else {}


def scatter_of(run, what):
    """By what share of itself a number may differ from one instruction set to the other: cracking is sensitive to the last digit. The
    examples' own tolerances (examples.py) say how much; what no crack changes is exact."""
    if what in EXACT:
        return 0.0
    return next((e.tolerance for e in examples.EXAMPLE.values() if e.run == run), 0.02)
