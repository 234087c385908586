"""The runs behind the verification page and the figures: which deck, which changes, and a cache of run folders.

A run folder is used again if it was made by the same program from the same deck with the same changes; its file
`made_from` says so. Every run takes one thread: several runs at a time use the machine better, and results do not
depend on the number of threads.
"""
import hashlib
import json
import os
import shutil
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
import fissura_io as io

ROOT = Path(__file__).resolve().parent.parent
EXAMPLES = ROOT / "examples"


class RunFailed(Exception):
    """A run that a row needs is not there; the text says why."""


@dataclass(frozen=True)
class Spec:
    """One run. `cost`: seconds on one quiet core, about; the dear ones start first."""
    deck: str
    changes: tuple = ()
    until: float = 0
    cost: float = 1
    long: bool = False
    threads: int = 1


def prism_runs():
    cells = {"A": "[10,2,2]", "B": "[20,4,4]"}
    cost = {"A": 1, "B": 12}
    for mesh, of_mesh in cells.items():
        change = f"mesh.box.0.cells={of_mesh}"
        yield f"prism_{mesh}", Spec("01_tension_prism/case.toml", (change, "concrete.0.joints=false"), cost=cost[mesh] / 5)
        for p in (20, 60, 100):
            yield f"prism_{mesh}_{p}", Spec("01_tension_prism/case.toml", (change, f"concrete.0.penalty={p}"),
                                            cost=cost[mesh] * (p / 20) ** 0.5)
    yield "prism_B_20_edge", Spec("01_tension_prism/case.toml", ("mesh.box.0.cells=[20,4,4]", 'concrete.0.h="0.05 m"'),
                                  cost=12)


def self_weight_runs():
    deck = "02_self_weight_beam/case.toml"
    for mesh, cells, cost in (("A", "[12,1,4]", 1), ("B", "[18,1,6]", 2), ("C", "[24,2,8]", 10)):
        yield f"self_weight_{mesh}", Spec(deck, (f"mesh.box.0.cells={cells}",), cost=cost)
    for p in (20, 60, 100):
        yield f"self_weight_C_{p}", Spec(deck, ("concrete.0.joints=true", f"concrete.0.penalty={p}"),
                                         cost=50 * (p / 20) ** 0.5, long=p > 20)
    # Figure 17: only the viscosity of the paper, 1.6 % of critical, brings the beam to rest. The viscosity limits the time
    # step with the square of the element size: mesh A takes minutes, the paper's mesh C hours.
    yield "self_weight_A_viscous", Spec(deck, ("mesh.box.0.cells=[12,1,4]", 'run.mass_damping="0 1/s"',
                                               'concrete.0.mu_bar="7e6 Pa s"', 'run.end_time="3 s"',
                                               "output.history_points=3000"), cost=150, long=True)


def tie_runs():
    for p in (20, 60, 100):
        yield f"elastic_tie_{p}", Spec("03_elastic_tie/case.toml", (f"concrete.0.penalty={p}",), cost=4 * (p / 20) ** 0.5)
    deck = "04_tie_to_failure/case.toml"
    for mesh, cells, cost in (("A", 4, 2), ("B", 8, 5), ("C", 12, 12), ("D", 16, 20)):
        change = f"mesh.box.0.cells=[{cells},3,3]"
        yield f"tie_{mesh}", Spec(deck, (change,), cost=cost)
        yield f"tie_{mesh}_elastic", Spec(deck, (change, "bars.between_cracks=elastic"), until=0.05, cost=cost / 3)
    yield "tie_A_two_threads", Spec(deck, ("mesh.box.0.cells=[4,3,3]",), cost=2, threads=2)


def beam_runs():
    demo = "00_demo_beam/case.toml"
    yield "demo", Spec(demo, cost=60)
    # Bars 1e-3 of the element size (25 mm) away from where they are; to some way beyond yield.
    yield "demo_shifted", Spec(demo, ('cage.0.cover="15.025 mm"',), until=0.17, cost=50)
    for mesh in ("case", "unstructured"):
        yield f"compression_{mesh}", Spec(f"07_compression_prism/{mesh}.toml", cost=10)
    yield "compression_slender", Spec("07_compression_prism/case.toml", ("mesh.box.0.cells=[4,4,4]",), cost=5)
    yield "collision", Spec("16_colliding_blocks/case.toml", cost=1)
    yield "shattering", Spec("16_colliding_blocks/shattering.toml", cost=20)
    four = "06_four_point_beam/case.toml"
    yield "four_point", Spec(four, cost=180, long=True)
    yield "four_point_steady", Spec(four, ("run.pace=1",), cost=280, long=True)
    # Jacks that begin at a fifth of the speed: the ways of the deck's, in five times the time.
    yield "four_point_slow", Spec(four, ('motion.0.velocity.value="-20 mm/s"', 'motion.1.velocity.value="-20 mm/s"', 'stage.1.duration="2100 ms"',
                                         "run.pace=15"), cost=240, long=True)
    yield "four_point_start", Spec(four, until=0.12, cost=70, long=True)  # up to 15 kN, before anything is chaotic
    yield "four_point_60", Spec(four, ("concrete.0.penalty=60",), cost=300, long=True)
    yield "four_point_unstructured", Spec("06_four_point_beam/unstructured.toml", cost=1500, long=True)


def cyclic_runs():
    deck = "05_cyclic_tie/{}.toml"
    for mesh, name, cost in (("coarse", "case", 15), ("fine", "fine", 450)):
        yield f"cyclic_tie_{mesh}", Spec(deck.format(name), cost=cost, long=cost > 60)
        yield f"cyclic_tie_{mesh}_mp", Spec(deck.format(name), ("steel.0.law=menegotto_pinto",), cost=cost, long=cost > 60)
    column = "09_cyclic_column/case.toml"
    yield "cyclic_column", Spec(column, cost=200, long=True)
    # Two more cycles of 2 %: whether the loops settle.
    yield "cyclic_column_more", Spec(column, ('motion.0.displacement.cycles=["6.25 mm","12.5 mm","25 mm","25 mm","25 mm","25 mm"]',
                                              'stage.1.duration="1.51 s"', "output.history_points=4500"), cost=300, long=True)


def plain_runs():
    panel = "11_l_panel/case.toml"
    yield "l_panel", Spec(panel, cost=500, long=True)
    yield "l_panel_90", Spec(panel, ('concrete.0.G_f="90 N/m"',), cost=500, long=True)
    notched = "12_notched_beam/{}.toml"
    yield "notched_beam", Spec(notched.format("case"), cost=600, long=True)
    # A coarser mesh with cells of 20 mm over the ligament.
    coarse = [f"mesh.box.{i}.cells=[{x},1,{z}]" for i, (x, z) in enumerate(((9, 3), (9, 5), (4, 3), (4, 5), (9, 3), (9, 5)))]
    yield "notched_beam_coarse", Spec(notched.format("case"), tuple(coarse), cost=60)
    yield "notched_beam_unstructured", Spec(notched.format("unstructured"), cost=600, long=True)


def rigid_contact_runs():
    decks = "../tests/verification/decks"
    yield "sliding", Spec(f"{decks}/sliding.toml", cost=2)
    yield "slope", Spec(f"{decks}/slope.toml", cost=2)
    # 35 degrees, steeper than the friction angle; viscosity keeps the block from chattering.
    yield "slope_steep", Spec(f"{decks}/slope.toml", ("gravity.direction=[0.573576436351,0,-0.819152044289]",
                                                      'stage.0.mass_damping="0 1/s"', 'concrete.0.mu_bar="1 MPa s"'), cost=4)
    yield "landing", Spec(f"{decks}/landing.toml", cost=1)
    yield "landing_corner", Spec(f"{decks}/landing.toml", ('plane.0.point=["-0.1 mm","0 m","0 m"]', "plane.0.normal=[1,1.2,0.9]",
                                                           'initial_velocity.0.velocity=["-1.11 m/s","-1.332 m/s","-1 m/s"]',
                                                           'run.end_time="4 ms"', "mesh.box.0.cells=[4,4,4]"), cost=1)
    yield "ball", Spec(f"{decks}/ball.toml", cost=1)
    yield "ball_friction", Spec(f"{decks}/ball.toml", ("impactor.0.friction=0.3", 'impactor.0.velocity=["3 m/s","-1 m/s","-3 m/s"]'),
                                cost=1)
    yield "drop_weight", Spec("14_drop_weight_beam/case.toml", cost=60)
    yield "dropped_block", Spec("15_dropped_block/case.toml", cost=60)


def dynamic_runs():
    bar = "13_spalling_bar/case.toml"
    yield "spalling_bar", Spec(bar, cost=15)
    gentle = 'traction.0.traction={cycles=["20 kPa"],period="300 us",one_sided=true}'
    for p in (20, 60):
        yield f"bar_wave_{p}", Spec(bar, (gentle, f"concrete.0.penalty={p}", "output.frames=1"), cost=15)
    column = "10_column_ground_motion/case.toml"
    linear, level = "concrete.0.crackable=false", 'motion.1.acceleration.pga="1e-9 g"'
    yield "column_quake", Spec(column, cost=90)
    yield "column_linear", Spec(column, (linear, level), cost=60)
    yield "column_static", Spec(column, (linear, level, 'motion.0.acceleration.pga="1e-9 g"', "gravity.direction=[0.02,0,-1]",
                                         'stage.0.duration="1 s"', 'stage.0.mass_damping="26 1/s"'), until=1, cost=25)


def all_runs():
    specs = {}
    for family in (prism_runs, self_weight_runs, tie_runs, beam_runs, cyclic_runs, plain_runs, rigid_contact_runs, dynamic_runs):
        specs.update(family())
    return specs


def key_of(spec, program):
    """What a run folder was made from: program, deck, the other files beside the deck that it may read, changes."""
    deck = EXAMPLES / spec.deck
    digest = hashlib.sha256(Path(program).read_bytes())
    for path in [deck, *sorted(p for p in deck.parent.iterdir() if p.suffix in (".geo", ".msh", ".txt"))]:
        digest.update(path.read_bytes())
    digest.update(repr((spec.changes, spec.until, spec.threads)).encode())
    return digest.hexdigest()


class Runs:
    def __init__(self, program, folder, jobs=0, only_cached=False):
        self.program = Path(program).resolve()
        self.folder = Path(folder)
        self.jobs = jobs or os.cpu_count() or 1
        self.only_cached = only_cached
        self.specs = all_runs()
        self.failed = {}

    def path(self, name):
        return self.folder / name

    def is_cached(self, name):
        made_from = self.path(name) / "made_from"
        return made_from.exists() and made_from.read_text(encoding="utf-8") == key_of(self.specs[name], self.program)

    def command(self, name, *more):
        spec = self.specs[name]
        command = [str(self.program), "run", str(EXAMPLES / spec.deck), "--quiet", "--no-report", "--force", "--threads", str(spec.threads)]
        for change in spec.changes:
            command += ["--set", change]
        return command + list(more)

    def make(self, names):
        """Makes what is not cached. Whatever goes wrong is kept and told by `get`."""
        if not self.program.is_file():
            self.failed = dict.fromkeys(names, f"{self.program}: no such program")
            return
        wanted = [n for n in names if not self.is_cached(n)]
        if self.only_cached:
            self.failed.update(dict.fromkeys(wanted, "not run"))
            return
        self.folder.mkdir(parents=True, exist_ok=True)
        with ThreadPoolExecutor(self.jobs) as pool:
            list(pool.map(self.make_one, sorted(wanted, key=lambda n: -self.specs[n].cost)))

    def make_one(self, name):
        spec, folder = self.specs[name], self.path(name)
        key = key_of(spec, self.program)
        command = self.command(name, "--out", str(folder), *(["--until", str(spec.until)] if spec.until else []))
        (folder / "made_from").unlink(missing_ok=True)
        print(f"running {name}", file=sys.stderr, flush=True)
        try:
            done = subprocess.run(command, capture_output=True, text=True, timeout=600 + 20 * spec.cost)
        except (OSError, subprocess.TimeoutExpired) as error:
            self.failed[name] = f"{name}: {error}"
            return
        if done.returncode != 0:
            self.failed[name] = f"{name}: exit code {done.returncode}: {done.stderr.strip()}"
            return
        if status := self.cut_short(name, folder):
            self.failed[name] = f"{name}: the run is {status}"
            return
        (folder / "made_from").write_text(key, encoding="utf-8")

    def cut_short(self, name, folder):
        """The status of a run that somebody has stopped before its end; nothing for one that came there, or that ended by a [[stop]] of its own
        before the time it is wanted for."""
        summary = json.loads((Path(folder) / "run.json").read_text(encoding="utf-8"))
        at_until = self.specs[name].until and summary["status"] == "stopped" and "--until" in summary.get("reason", "")
        return "" if summary["status"] == "complete" or at_until else summary["status"]

    def echo(self, command, out):
        """The deck with every default, as this program reads it."""
        done = subprocess.run([*command, "--out", str(out), "--walltime", "1e-9"], capture_output=True, text=True)
        if done.returncode != 0:
            raise RunFailed(done.stderr.strip())
        return (out / "case.toml").read_text(encoding="utf-8")

    def adopt(self, name, source):
        """Takes a finished run made by hand, if it was made from the same deck: both echoes, read by this program, agree."""
        folder = self.path(name)
        with tempfile.TemporaryDirectory() as scratch:
            wanted = self.echo(self.command(name), Path(scratch) / "wanted")
            given = self.echo([str(self.program), "run", str(Path(source) / "case.toml"), "--quiet", "--no-report"], Path(scratch) / "given")
            if wanted != given:
                raise RunFailed(f"{source}: made from another deck than {name}")
        if status := self.cut_short(name, source):
            raise RunFailed(f"{source}: the run is {status}")
        shutil.rmtree(folder, ignore_errors=True)
        shutil.copytree(source, folder)
        (folder / "made_from").write_text(key_of(self.specs[name], self.program), encoding="utf-8")

    def get(self, name):
        if name in self.failed:
            raise RunFailed(self.failed[name])
        if not (self.path(name) / "made_from").exists():
            raise RunFailed(f"{name}: not run")
        return io.Run(self.path(name))
