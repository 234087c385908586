#!/usr/bin/python3
# %% [markdown]
# # The four-point beam of example 4.2, from Python
# Cells for an editor that shows them as a notebook; as a script:
#
#     PYTHONPATH=build/python docs/tutorials/four_point_beam.py [end time, e.g. "20 ms"]

# %%
import sys
from pathlib import Path

import matplotlib
import numpy as np

import fissura

if "ipykernel" not in sys.modules:
    matplotlib.use("Agg")  # draws into a file
import matplotlib.pyplot as plt  # noqa: E402

deck = Path(__file__).resolve().parents[2] / "examples/06_four_point_beam/case.toml"
changes = {"run.end_time": sys.argv[1]} if len(sys.argv) > 1 else {}

# %% What the run will cost, and what the program assumes
print(fissura.check(deck, set=changes))

# %% Step it, and look at it on the way
run = fissura.open(deck, set=changes, threads=2)
print(run)
u = run.view("u")  # read-only, on the memory of the run: it changes as the run goes on
widest = []
while run.step(2000):
    opening = run.cracks["opening"]
    widest.append((run.time, opening.max() if len(opening) else 0))
    print(f"t = {run.time * 1e3:6.2f} ms  deflection {-u[..., 2].min() * 1e3:6.3f} mm  "
          f"widest crack {widest[-1][1] * 1e3:.4f} mm")

# %% The curve
h = run.history
fig, (left, right) = plt.subplots(1, 2, figsize=(11, 4))
left.plot(h["deflection"] * 1e3, h["load"] / 1e3)
left.set(xlabel="deflection [mm]", ylabel="load [kN]", title=run.title)
right.plot(*np.array(widest).T * 1e3)
right.set(xlabel="time [ms]", ylabel="widest crack [mm]")
fig.savefig("four_point_beam.png", dpi=120)

# %% Where it is stressed most: a field is a copy in the order of the input
stress = run.field("stress")
x = run.field("position").mean(axis=1)
most = stress[:, 0].argmin()
print(f"largest compression along the beam: {-stress[most, 0] / 1e6:.1f} MPa at {x[most].round(3)} m")
print("state", run.state_hash, "after", run.steps, "steps")
