"""A small run with every kind of frame: a tie that cracks, its bars, a floor and a ball."""
import json
import re
import subprocess

DECK = """
title = "frames"
[[mesh.box]]
name = "member"
from = ["0 mm", "0 mm", "0 mm"]
to = ["400 mm", "100 mm", "100 mm"]
cells = [8, 2, 2]
[[concrete]]
E = "30 GPa"
f_t = "2 MPa"
f_c = "30 MPa"
G_f = "80 J/m2"
density = "2400 kg/m3"
[[steel]]
name = "B500"
f_y = "500 MPa"
f_u = "550 MPa"
[[bar]]
name = "lower \\u00e9"
steel = "B500"
diameter = "12 mm"
points = [["0 mm", "40 mm", "30 mm"], ["400 mm", "40 mm", "30 mm"]]
count = 2
spacing = ["0 mm", "25 mm", "0 mm"]
[[bar]]
name = "upper"
steel = "B500"
diameter = "8 mm"
points = [["0 mm", "50 mm", "70 mm"], ["400 mm", "50 mm", "70 mm"]]
[[support]]
name = "left"
where = {plane = "x", at = "0 mm"}
fix = ["x", "y", "z"]
[[motion]]
name = "pull"
where = {plane = "x", at = "400 mm"}
axis = "x"
velocity = {value = "0.5 m/s", over = "0.1 ms"}
[[plane]]
name = "floor"
point = ["0 m", "0 m", "-200 mm"]
normal = [0, 0, 1]
[[impactor]]
name = "ball"
shape = "sphere"
centre = ["200 mm", "50 mm", "500 mm"]
radius = "50 mm"
mass = "4 kg"
velocity = ["0 m/s", "0 m/s", "-1 m/s"]
[[gauge]]
name = "force"
kind = "reaction"
of = ["pull"]
axis = "x"
[run]
end_time = "1 ms"
[output]
frames = 4
history_points = 20
"""


def make_run(program, folder):
    """Runs it below `folder`; the run folder."""
    deck = folder / "tie.toml"
    deck.write_text(DECK)
    done = subprocess.run([program, "run", str(deck), "--out", str(folder / "tie.run"), "--quiet", "--no-report", "--threads", "1"],
                          capture_output=True, text=True, timeout=300)
    assert done.returncode == 0, done.stdout + done.stderr
    return folder / "tie.run"


def change_summary(run, **keys):
    path = run / "run.json"
    path.write_text(json.dumps({**json.loads(path.read_text()), **keys}))


MARKUP = "<script>document.title = 'owned'</script><img src=x onerror=\"document.title = 'owned'\"><h6>owned</h6>"


def put_markup(run, bar):
    """Markup into every text of a run folder that a page shows; `bar`: the name of a bar of its deck."""
    change_summary(run, title=MARKUP, reason=MARKUP, version=MARKUP, kernels=MARKUP, stable_dt_limiter=MARKUP, state_hash=MARKUP)
    header, rows = (run / "history.csv").read_text().split("\n", 1)
    quoted = MARKUP.replace('"', '""')
    (run / "history.csv").write_text(re.sub(r"reaction_\w+ \[N\]", lambda _: f'"{quoted} [{quoted}]"', header, count=1) + "\n" + rows)
    (run / "log.txt").write_text(f"2026-01-31 12:00:00 warning: {MARKUP}\n2026-01-31 12:00:00 {MARKUP}: {MARKUP}\n")
    deck = (run / "case.toml").read_text()
    (run / "case.toml").write_text(deck.replace(f'"{bar}"', json.dumps(MARKUP)))
