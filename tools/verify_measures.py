"""What is read from the runs: one function per example, plain numbers out. SI inside, shown units in the names."""
import sys
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parent))
import fissura_io as io

# Example 3.1: E = 30 GPa, 0.2 x 0.2 m. Example 3.3: Table 4, gross section and bar, 1.2 m.
PRISM_STIFFNESS = 30e9 * 0.04
TIE_STIFFNESS = 30.5e9 * 0.09 + 210e9 * 9e-4
TIE_LENGTH, TIE_AREA = 1.2, 0.09
TIMOSHENKO = 0.729e-3


def column(run, name):
    return run.history[name].values


def prism_error(run):
    """1 - F/F_theory at the end, at equal displacement [%]."""
    u = column(run, "u_right")[-1] - column(run, "u_left")[-1]
    return 100 * (1 - column(run, "force")[-1] / (PRISM_STIFFNESS * u))


def elastic_tie_error(run):
    u = (column(run, "u_right")[-1] - column(run, "u_left")[-1]) / TIE_LENGTH
    return 100 * (1 - column(run, "force")[-1] / (TIE_STIFFNESS * u))


def deflection_error(run):
    """|w/w_theory - 1| at rest [%]; w is the mean over the last tenth of the run."""
    w = column(run, "deflection")
    return 100 * abs(w[-max(1, len(w) // 10):].mean() / TIMOSHENKO - 1)


def residual(run):
    """Largest energy residual [%], without its sign."""
    return 100 * abs(run.summary["energy_residual"])


def momentum_error(run):
    """Change of the momentum of example 16 over what the missile brought, 11.25 kg at (-10, -5, 2.5) m/s."""
    now = sum(f["mass"] * np.array(f["velocity"]) for f in run.summary["fragments"]["largest"])
    start = 11.25 * np.array([-10, -5, 2.5])
    return np.linalg.norm(now - start) / np.linalg.norm(start)


def energy_beyond_the_start(run):
    """Largest kinetic energy less what there was at the start and was put in, over the former [%]; negative: below."""
    work = sum(column(run, f"energy_{a}") for a in ("work_supports", "work_forces", "work_gravity"))
    kinetic = column(run, "energy_kinetic")
    return 100 * np.max(kinetic[1:] - kinetic[0] - work[1:]) / kinetic[0]


def fragment_mass_error(run):
    """Sum of the masses of the fragments over the mass of the model, less 1."""
    return run.summary["fragments"]["mass"] / run.summary["total_mass"] - 1


def first(condition):
    """Index of the first row that meets it, or None."""
    where = np.flatnonzero(condition)
    return int(where[0]) if where.size else None


def tie(run):
    """Example 3.4: cracking, first yield and ultimate average stress [MPa], mean strains at first yield [1e-3]."""
    stress = column(run, "force") / TIE_AREA / 1e6
    elongation = column(run, "elongation")
    cracked = first(elongation > 2.5e-4)
    i = first(column(run, "bar_joints_yielded") > 0)
    # n bar elements have n - 1 joints: half an element at each grip belongs to none and stays elastic.
    n = run.summary["bar_elements"]
    sound = stress[i] * 1e6 * TIE_AREA / TIE_STIFFNESS
    middle = (column(run, "u_b")[i] - column(run, "u_a")[i]) / 0.6
    return {"cracking": stress[:cracked].max(), "yield": stress[i], "ultimate": stress.max(),
            "yield_strain": 1e3 * (elongation[i] - sound / n) * n / (n - 1), "yield_strain_middle": 1e3 * middle}


def prism_strength(run):
    """Example 7: peak load over the cross-section of 100 x 100 mm [MPa]."""
    return column(run, "load").max() / 0.01 / 1e6


def running_mean(time, values, window):
    """Mean over `window` seconds around each row, shorter at the ends."""
    area = np.concatenate([[0], np.cumsum((values[1:] + values[:-1]) / 2 * np.diff(time))])
    begin, end = np.maximum(time - window / 2, time[0]), np.minimum(time + window / 2, time[-1])
    return (np.interp(end, time, area) - np.interp(begin, time, area)) / (end - begin)


# Loads of the beam are means over 10 ms of the loads' time, one millimetre of the jacks' way: a crack's shock lasts one.
SHOCK = 10e-3


def clock(run):
    """The time that loads follow [s]: under pace control it runs faster than that of the run."""
    return column(run, "load_time" if "load_time" in run.history.columns else "time")


def push_begins(run):
    """First row of the stage in which the jacks move."""
    return first(np.abs(column(run, "reaction_load_1_z")) > 0)


def four_point_cracking(run):
    """Example 4.2, loads [kN]: first joint damaged, first joint cracked through, first crack at a bar."""
    load = column(run, "load") / 1e3
    after = np.arange(len(load)) > push_begins(run)

    def load_at(count):
        return load[first(after & (column(run, count) > 0))]

    return {"first_damage": load_at("joints_damaged"), "cracking": load_at("joints_cracked"),
            "crack_at_bar": load_at("bar_joints_activated")}


def quiet_before_peak(run):
    """Share of the readings up to the largest load in which kinetic energy is below 5 % of the internal [%], as the report counts them."""
    kinetic = column(run, "energy_kinetic")
    internal = sum(column(run, f"energy_{a}") for a in ("strain", "joints", "bars", "bar_joints", "contact"))
    counted = np.flatnonzero(internal > 0.01 * internal.max())
    counted = counted[counted <= np.argmax(np.convolve(column(run, "load"), np.ones(5) / 5, "same"))]
    return 100 * np.mean(kinetic[counted] < 0.05 * internal[counted])


def four_point(run, window=SHOCK):
    """Example 4.2 to collapse, from the start of `push`: loads [kN] and deflections [mm]; loads are means over `window` of the loads' time."""
    time = clock(run)
    after = np.arange(len(time)) > push_begins(run)
    load, jack = column(run, "load") / 1e3, column(run, "jack") / 1e3
    steel, w = column(run, "steel_stress") / 1e6, 1e3 * column(run, "deflection")
    mean, mean_jack = (running_mean(time, x, window) for x in (load, jack))
    yielded = first(column(run, "bar_joints_yielded") > 0)
    top = int(np.argmax(np.where(after & (time < time[-1] - window / 2), mean, 0)))
    return {"yield": mean[yielded], "yield_deflection": w[yielded], "failure": mean[top], "failure_deflection": w[top],
            "failure_jack": mean_jack[top], "peak_reading": load[after].max(), "steel_at_failure": steel[top],
            "yields_first": float(yielded < top)}


# The demo: breadth, depth of the bars, height, shear span [m]; two bars of 8 mm; moduli and strengths [Pa].
DEMO_B, DEMO_D, DEMO_H, DEMO_A = 0.12, 0.175, 0.2, 0.35
DEMO_STEEL, DEMO_E_S, DEMO_F_Y, DEMO_F_U = 2 * np.pi / 4 * 0.008 ** 2, 200e9, 500e6, 540e6
DEMO_E_C, DEMO_F_T, DEMO_F_C = 33e9, 2.9e6, 38e6
# Its loads are means over 3 ms: the beam, which one support alone holds along its axis, sways with that period.
DEMO_WINDOW = 3e-3


def demo_by_hand():
    """Loads of the demo by section analysis [kN]: first crack (elastic, plain section), yield (elastic, cracked), strength (rectangular block of
    stress); arm of the inner forces at yield [mm]. No tension in cracked concrete; bars below only."""
    n_rho = DEMO_E_S / DEMO_E_C * DEMO_STEEL / (DEMO_B * DEMO_D)
    k = np.sqrt(2 * n_rho + n_rho ** 2) - n_rho
    arm = DEMO_D * (1 - k / 3)
    arm_at_strength = DEMO_D - 0.5 * DEMO_STEEL * DEMO_F_U / (DEMO_B * DEMO_F_C)
    kilo = 1e-3 * 2 / DEMO_A
    return {"cracking": kilo * DEMO_F_T * DEMO_B * DEMO_H ** 2 / 6, "yield": kilo * DEMO_STEEL * DEMO_F_Y * arm,
            "strength": kilo * DEMO_STEEL * DEMO_F_U * arm_at_strength, "arm": 1e3 * arm}


def demo(run):
    load, w = column(run, "load") / 1e3, 1e3 * column(run, "deflection")
    mean = running_mean(column(run, "time"), load, DEMO_WINDOW)
    cracked, yielded = (first(column(run, f"{count}") > 0) for count in ("joints_cracked", "bar_joints_yielded"))
    top = int(np.argmax(mean))
    return {"cracking": mean[cracked], "cracking_deflection": w[cracked], "yield": mean[yielded], "yield_deflection": w[yielded],
            "maximum": mean[top], "maximum_deflection": w[top], "failed": float(abs(load[-1]) < 0.61 * load.max())}


def change_up_to_yield(run, other):
    """Mean difference of two load-deflection curves up to first yield over the load at yield [%]. (The largest one is that of two cracks that open
    at different moments.)"""
    def curve(of):
        return column(of, "deflection"), running_mean(column(of, "time"), column(of, "load"), DEMO_WINDOW)

    (w, load), (other_w, other_load) = curve(run), curve(other)
    end = first(column(run, "bar_joints_yielded") > 0) + 1
    order = np.argsort(other_w, kind="stable")
    shifted = np.interp(w[:end], other_w[order], other_load[order])
    return 100 * np.abs(shifted - load[:end]).mean() / load[:end].max()


# Winkler's L-panel: displacement [mm] and load [N] of the test.
L_PANEL_TEST = np.array([[0, 0], [.0498, 2015], [.1097, 4578], [.1483, 5999], [.1839, 6992], [.2078, 7219], [.2384, 6714],
                         [.2693, 5996], [.3238, 4801], [.3996, 3529], [.4992, 2477], [.5986, 1911], [.7988, 1283], [1.0003, 1041]])
L_PANEL_CORNER = np.array([0.25, 0.25])


def l_panel_curve(run):
    """Lift [mm] and load [kN], a mean over 1 ms: 0.01 mm of the lift."""
    return 1e3 * column(run, "lift"), running_mean(column(run, "time"), column(run, "load") / 1e3, 1e-3)


def l_panel(run):
    lift, load = l_panel_curve(run)
    test = np.interp(lift, *L_PANEL_TEST.T) / 1e3
    rising = (lift > 0.01) & (lift < 0.04)
    top = int(np.argmax(load))
    return {"peak": load[top], "peak_lift": lift[top], "stiffness": np.polyfit(lift[rising], load[rising], 1)[0],
            "work": np.trapz(load, lift), "test_work": np.trapz(test, lift), "tail": np.interp(0.5, lift, load)}


def first_failure(run):
    """Place (x, z) [m] of the joint that fails first, and the place of all failed ones, in the last frame."""
    places, times = [], []
    for part in run.frame("cracks", "last")[1]:
        grid = io.read_frame(part)
        triangles, which = grid.cells(io.TRIANGLE)
        places.append(grid.points[triangles].mean(axis=1)[:, [0, 2]])
        times.append(grid.cell_data["time_of_failure"][which])
    places, times = np.concatenate(places), np.concatenate(times)
    failed = times > 0
    return places[failed][np.argmin(times[failed])], places[failed]


def l_panel_crack(run):
    """Distance of the first failed joint from the corner [mm]; height above it where the crack is 100 mm to its left [mm]."""
    start, failed = first_failure(run)
    there = np.abs(failed[:, 0] - (L_PANEL_CORNER[0] - 0.1)) < 0.02
    return {"start": 1e3 * np.hypot(*(start - L_PANEL_CORNER)), "height": 1e3 * (failed[there, 1].mean() - L_PANEL_CORNER[1]),
            "reach": 1e3 * (L_PANEL_CORNER[0] - failed[:, 0].min())}


# Petersson's beam: ligament b (D - a_0).
LIGAMENT = 0.05 * 0.1


def notched_beam(run):
    """Work of fracture [N/m]: of the jack, and dissipated by the joints, over the ligament; peak [N]; crack area over the ligament."""
    load, deflection = column(run, "jack"), column(run, "deflection")
    mean = running_mean(column(run, "time"), column(run, "load"), SHOCK)
    lost = sum(column(run, f"energy_{name}")[-1] for name in ("fracture_I", "fracture_II", "friction"))
    held = sum(column(run, f"energy_{name}")[-1] for name in ("kinetic", "strain", "joints"))
    return {"work": np.trapz(load, deflection) / LIGAMENT, "ledger": column(run, "energy_work_supports")[-1] / LIGAMENT,
            "dissipated": lost / LIGAMENT, "held": held / LIGAMENT, "peak": mean.max()}


# The cyclic tie 4.1: one D19, A_s f_y = 100.3 kN.
TIE_BAR, TIE_YIELD = 286.5e-6, 350e6
TIE_LEVELS = (0.002, 0.005, 0.010, 0.015)
TIE_SHOCK = 1e-3  # its forces are means over so many seconds, 1e-5 of mean strain


def tie_peaks(run):
    """Force [kN] where the mean strain reaches each level for the first time."""
    strain, force = column(run, "mean_strain"), column(run, "force") / 1e3
    return [force[max(0, first(strain >= 0.999 * level) - 1)] for level in TIE_LEVELS]


def tie_unloading(run):
    """Stiffness of the branches down to zero force [kN per 1e-3 of mean strain], one per level; the last strain at rest."""
    strain, force = column(run, "mean_strain"), column(run, "force") / 1e3
    slopes, begin = [], 0
    for level in TIE_LEVELS:
        top = begin + first(strain[begin:] >= 0.999 * level)
        down = top + first(force[top:] < 0.7 * force[top])
        begin = down + first(force[down:] < 0.1 * force[top])
        slopes.append(1e-3 * np.polyfit(strain[down:begin], force[down:begin], 1)[0])
    return slopes


def cyclic_tie(run):
    yielded = first(column(run, "bar_joints_yielded") > 0)
    force = running_mean(column(run, "time"), column(run, "force") / 1e3, TIE_SHOCK)
    return {"yield": force[yielded], "yield_strain": 1e3 * column(run, "mean_strain")[yielded]}


def tie_cracks(run):
    """Largest distance of a failed joint from the nearest notch along the tie [mm], and number of notches with failed joints."""
    _, failed = first_failure(run)
    notch = np.round(failed[:, 0] / 0.3)
    return {"distance": 1e3 * np.abs(failed[:, 0] - 0.3 * notch).max(), "notches": len(set(notch))}


def tie_at_rest(run, share=0.1):
    """Change of the mean force from the first to the second half of the last part of the run, at rest without load [kN]."""
    time, force = column(run, "time"), column(run, "force") / 1e3
    last = time[-1] - share * np.ptp(time)
    middle = (last + time[-1]) / 2
    return force[time > middle].mean() - force[(time > last) & (time <= middle)].mean()


# The cyclic column.
COLUMN_AXIAL, COLUMN_YIELD, COLUMN_E_S = 250e3, 420e6, 200e9


def column_cycles(run, force="shear", window=SHOCK):
    """Drift [mm] and shear [kN] of each half cycle at its turning point; means over `window` seconds, 0: single readings."""
    time, drift = column(run, "time"), 1e3 * column(run, "drift")
    shear = column(run, force) / 1e3
    if window:
        shear = running_mean(time, shear, window)
    signs = np.sign(np.where(np.abs(drift) > 0.5, drift, 0))
    halves, current = [], 0
    for i, s in enumerate(signs):
        if s and s != current:
            halves.append([])
            current = s
        if s:
            halves[-1].append(i)
    turns = [half[int(np.argmax(np.abs(drift[half])))] for half in halves]
    return [(drift[i], shear[i]) for i in turns]


def plastic_under_compression(run, side):
    """Plastic strain that a bar at the base has gained in compression over the run [-]."""
    stress = column(run, f"stress_{side}")
    plastic = np.diff(column(run, f"strain_{side}") - stress / COLUMN_E_S)
    return -plastic[(stress[1:] < 0) & (plastic < 0)].sum()


def column_stability(run, ago=0, **reading):
    """Mean shear at the turning points of the last cycle over that of the cycle before, both to the same drift; `ago` cycles earlier."""
    shear = [abs(s) for _, s in column_cycles(run, **reading)]
    end = len(shear) - 2 * ago
    return sum(shear[end - 2:end]) / sum(shear[end - 4:end - 2])


def cyclic_column(run):
    time = column(run, "time")
    after = column(run, "time") > run.history["time"].values[first(np.abs(column(run, "reaction_top_x")) > 0)]
    axial = running_mean(time, column(run, "axial"), SHOCK)[after] / COLUMN_AXIAL
    stress = np.array([column(run, f"stress_{side}") for side in ("left", "right")])
    back = min(plastic_under_compression(run, side) for side in ("left", "right"))
    return {"axial_low": axial.min(), "axial_high": axial.max(), "tension": stress.max(axis=1).min() / COLUMN_YIELD,
            "back": 100 * back, "compression": -stress.min() / 1e6, "shear": np.abs(column(run, "shear")).max() / 1e3}


# The decks of rigid contact: a cube of 20 kg and a ball of 4 kg; a block of 0.4 m thrown with 0.5 m/s.
CUBE, BALL = 20.0, 4.0


def momentum_change(run):
    """Largest change of the linear momentum of cube and ball, along z and x, over the first [-]."""
    along_z = CUBE * column(run, "cube") + BALL * column(run, "ball")
    along_x = CUBE * column(run, "cube_x") + BALL * column(run, "ball_x")
    return max(np.ptp(along_z), np.ptp(along_x)) / np.hypot(along_z[0], along_x[0])


def landing_balance(run):
    """Impulse of the floor over the cube's change of momentum, less 1."""
    return column(run, "impulse")[-1] / (CUBE * (column(run, "speed")[-1] - column(run, "speed")[0])) - 1


def creep(run):
    """Of the block on a slope, in the stage `rest`: sizes (0.4 m) per second."""
    time, way = column(run, "time"), column(run, "creep")
    rest = time > 0.021
    return abs(way[rest][-1] - way[rest][0]) / (time[rest][-1] - time[rest][0]) / 0.4


def slope_acceleration(run):
    """Between 30 ms and the end [m/s2]."""
    time, speed = column(run, "time"), column(run, "speed")
    return np.polyfit(time[time > 0.03], speed[time > 0.03], 1)[0]


def drop_weight(run):
    """Example 14: error of the impulse balance [%], largest force [kN], largest deflection [mm], rebound [m/s]."""
    time, speed = column(run, "time"), column(run, "hammer_velocity")
    mass = next(b["mass"] for b in run.summary["rigid_bodies"] if b["name"] == "hammer")
    gained = mass * (speed[-1] - speed[0])
    given = column(run, "impulse")[-1] - mass * 9.81 * time[-1]
    force = column(run, "impact_force")
    summed = np.sum(0.5 * (force[1:] + force[:-1]) * np.diff(time))
    return {"balance": 100 * (given / gained - 1), "curve": 100 * (summed / column(run, "impulse")[-1] - 1),
            "force": force.max() / 1e3, "deflection": 1e3 * column(run, "deflection").max(), "rebound": speed.max()}
