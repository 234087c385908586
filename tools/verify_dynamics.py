"""What is read from the dynamic examples: waves and spalls of the bar, the column on its shaken foot. SI inside."""
import math

import numpy as np

from verify_measures import column
from verify_runs import EXAMPLES

# Example 13: bar of 2 m, 37.5 mm square; tail of the pulse 300 us; gauges at a quarter, the middle and the free end.
BAR_E, BAR_DENSITY, BAR_AREA = 30e9, 2500, 0.0375**2
SPALL_RATIO, TAIL = 4 / 10, 300e-6
# sum(A h n_x^2)/V of Kuhn's cells, with h that of the regular tet: (1 + sqrt 2) 2^(1/6) times the cell's edge.
KUHN = (1 + math.sqrt(2)) * 2 ** (1 / 6)
PASSED = 0.9e-3  # the wave has passed the middle on its way out and has not come back there [s]


def bar_wave_speed(penalty):
    return math.sqrt(BAR_E / BAR_DENSITY / (1 + KUHN / penalty))


def arrival(run, name):
    """When the velocity first reaches half of the passing wave's peak [s]."""
    time, v = column(run, "time"), column(run, name)
    half = v[time < PASSED].max() / 2
    i = int(np.flatnonzero(v > half)[0])
    return time[i - 1] + (half - v[i - 1]) / (v[i] - v[i - 1]) * (time[i] - time[i - 1])


def wave_speed(run):
    return 0.5 / (arrival(run, "v_b") - arrival(run, "v_a"))


def free_end_factor(run):
    """Velocity of the free end over that of the wave that runs into it."""
    return column(run, "v_end").max() / column(run, "v_b")[column(run, "time") < PASSED].max()


def first_spall(run):
    """Length of the piece that has left the free end [m]."""
    last = max(run.summary["fragments"]["largest"], key=lambda f: f["centroid"][0])
    return last["mass"] / (BAR_DENSITY * BAR_AREA)


def spall_length():
    return SPALL_RATIO * bar_wave_speed(20) * TAIL / 2


# Example 10: a column of 3 m under a head of 8 t whose centre is at 3.25 m.
GRAVITY, PGA, START = 9.80665, 0.35 * 9.80665, 0.08
LATERAL = 9.81 * 0.02 / math.hypot(1, 0.02)  # of the static run [m/s2]
DRAG = 0.5                                   # mass_damping [1/s]
# Of a cantilever bent by a force at its head, the column's mass counts 3/8 in sum m psi and 33/140 in sum m psi^2.
HEAD, SHAFT = 8000, 0.09 * 3 * 2500
PARTICIPATION = (HEAD + 3 / 8 * SHAFT) / (HEAD + 33 / 140 * SHAFT)


def baseline_corrected(time, acceleration):
    """Takes the line out that leaves the least mean square of the velocity and none of it at the end."""
    def integral(rate):
        return np.concatenate([[0], np.cumsum((rate[1:] + rate[:-1]) / 2 * np.diff(time))])

    shapes = np.array([np.ones_like(time), time / time[-1]])
    velocity, basis = integral(acceleration), np.array([integral(s) for s in shapes])
    weight = np.gradient(time)
    weight[[0, -1]] /= 2
    matrix = np.zeros((3, 3))
    matrix[:2, :2] = basis * weight @ basis.T
    matrix[:2, 2] = matrix[2, :2] = basis[:, -1]
    right = [*(basis * weight @ velocity), velocity[-1]]
    return acceleration - np.linalg.solve(matrix, right)[:2] @ shapes


def ground():
    """Times, acceleration and velocity of the foot, from the record itself."""
    time, a = np.loadtxt(EXAMPLES / "10_column_ground_motion" / "record.txt", skiprows=2, unpack=True)
    a = baseline_corrected(time, a)
    a *= PGA / np.abs(a).max()
    return time, a, np.concatenate([[0], np.cumsum((a[1:] + a[:-1]) / 2 * np.diff(time))])


def frequency(static):
    """omega of the first mode [rad/s] by Rayleigh: from the rest under a lateral acceleration, mean of the last tenth."""
    sway = column(static, "head") - column(static, "foot")
    return math.sqrt(LATERAL * PARTICIPATION / abs(sway[-max(1, len(sway) // 10):].mean()))


def one_degree(omega, until, step=2e-4):
    """x'' + c x' + omega^2 x = -Gamma (a + c v) by Newmark's constant acceleration: times from the start of the record, x."""
    time, a, v = ground()
    t = np.arange(0, until, step)
    a, v = np.interp(t, time, a, right=0), np.interp(t, time, v)
    load = -PARTICIPATION * (a + DRAG * v)
    x, speed, rate, path = 0.0, 0.0, load[0], [0.0]
    for p in load[1:]:
        x += step * speed + step**2 / 4 * rate
        speed += step / 2 * rate
        rate = (p - DRAG * speed - omega**2 * x) / (1 + DRAG * step / 2 + omega**2 * step**2 / 4)
        x += step**2 / 4 * rate
        speed += step / 2 * rate
        path.append(x)
    return t, np.array(path)


def sway(run):
    """Times from the start of the record [s] and displacement of the head against the foot [m]."""
    time = column(run, "time") - START
    return time[time > 0], (column(run, "head") - column(run, "foot"))[time > 0]


def largest_sway(run):
    return np.abs(sway(run)[1]).max()


def sway_over_one_degree(static, linear):
    time, _ = sway(linear)
    return largest_sway(linear) / np.abs(one_degree(frequency(static), time[-1])[1]).max()
