"""What is read from the runs: one function per example, plain numbers out. SI inside, shown units in the names."""
import numpy as np

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


# Loads of the beam are means over 10 ms, one millimetre of the jacks' way: a crack's shock lasts one.
SHOCK = 10e-3


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


def four_point(run):
    """Example 4.2 to collapse, from the start of `push`: loads [kN] and deflections [mm]."""
    time = column(run, "time")
    after = np.arange(len(time)) > push_begins(run)
    load, jack = column(run, "load") / 1e3, column(run, "jack") / 1e3
    steel, w = column(run, "steel_stress") / 1e6, 1e3 * column(run, "deflection")
    mean, mean_jack = (running_mean(time, x, SHOCK) for x in (load, jack))
    yielded = first(column(run, "bar_joints_yielded") > 0)
    top = int(np.argmax(np.where(after & (time < time[-1] - SHOCK / 2), mean, 0)))
    return {"yield": mean[yielded], "yield_deflection": w[yielded], "failure": mean[top], "failure_deflection": w[top],
            "failure_jack": mean_jack[top], "peak_reading": load[after].max(), "steel_at_failure": steel[top],
            "yields_first": float(yielded < top)}


def demo(run):
    load = column(run, "load") / 1e3
    mean = running_mean(column(run, "time"), load, SHOCK)
    yielded = first(column(run, "bar_joints_yielded") > 0)
    return {"yield": mean[yielded], "maximum": mean.max(), "cracked": float(run.summary["joints_broken"] > 0),
            "failed": float(abs(load[-1]) < 0.35 * load.max())}


def change_up_to_yield(run, other):
    """Largest difference of two load-deflection curves up to first yield over the load at yield [%]."""
    i = first(column(run, "bar_joints_yielded") > 0)
    time = column(run, "time")[:i + 1]
    load = running_mean(column(run, "time"), column(run, "load"), SHOCK)[:i + 1]
    shifted = np.interp(time, column(other, "time"), running_mean(column(other, "time"), column(other, "load"), SHOCK))
    return 100 * np.abs(shifted - load).max() / load.max()
