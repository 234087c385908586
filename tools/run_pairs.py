"""Runs of the program in pairs: an uninterrupted one, and one that was stopped or killed and went on. What they leave is
compared byte by byte."""
import json
import os
import re
import signal
import subprocess
import time
from pathlib import Path
from xml.etree import ElementTree

ROOT = Path(__file__).resolve().parent.parent
SMASHED = ROOT / "tests" / "regression" / "decks" / "smashed_beam.toml"
OF_THE_MACHINE = ("threads", "wall_seconds", "tet_steps_per_second")
LISTS = ("fields.pvd", "cracks.pvd", "bars.pvd", "surface.pvd", "rigid.pvd")


class Program:
    def __init__(self, path, kernels=None):
        self.path = str(Path(path).resolve())
        self.environment = dict(os.environ, **({"FISSURA_KERNELS": kernels} if kernels else {}))

    def command(self, deck, *options):
        return [self.path, "run", str(deck), "--quiet", *map(str, options)]

    def run(self, deck, *options):
        """The finished process; its texts are captured."""
        return subprocess.run(self.command(deck, *options), capture_output=True, text=True, env=self.environment)

    def must_run(self, deck, *options):
        done = self.run(deck, *options)
        if done.returncode != 0:
            raise RuntimeError(f"{' '.join(self.command(deck, *options))}\n{done.stderr}")

    def start(self, deck, *options):
        """A process that goes on."""
        return subprocess.Popen(self.command(deck, *options), stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True,
                                env=self.environment)


def summary(folder):
    return json.loads((Path(folder) / "run.json").read_text())


def checkpoints(folder):
    return sorted((Path(folder) / "checkpoints").glob("checkpoint_*.bin"))


def hashes_in_log(folder):
    """Step -> hash of the state."""
    lines = (Path(folder) / "log.txt").read_text().splitlines()
    found = [re.search(r"step (\d+): state ([0-9a-f]{16})", line) for line in lines]
    return {int(f[1]): f[2] for f in found if f}


def differences(one, two):
    """Names of what two run folders do not have in common, to the byte."""
    one, two = Path(one), Path(two)
    names = {"history.csv", *LISTS}
    for folder in (one, two):
        names |= {str(p.relative_to(folder)) for p in (folder / "frames").iterdir()}
    wrong = [n for n in sorted(names) if ((one / n).exists() or (two / n).exists()) and
             not ((one / n).exists() and (two / n).exists() and (one / n).read_bytes() == (two / n).read_bytes())]
    a, b = ({k: v for k, v in summary(f).items() if k not in OF_THE_MACHINE} for f in (one, two))
    wrong += [f"run.json: {k}" for k in sorted(a.keys() | b.keys()) if a.get(k) != b.get(k)]
    logged_a, logged_b = hashes_in_log(one), hashes_in_log(two)
    if logged_a != logged_b:
        wrong.append("log.txt: hashes of the state")
    return wrong


def broken_lines(folder):
    """What a reader of a killed run would stumble over: in history.csv and in the lists of frames."""
    folder = Path(folder)
    wrong = []
    history = folder / "history.csv"
    if history.exists() and history.stat().st_size > 0:
        text = history.read_text()
        lines = text.split("\n")
        columns = lines[0].count(",")
        if lines[-1] or any(line.count(",") != columns for line in lines[:-1]):
            wrong.append("history.csv")
    for name in LISTS:
        if not (folder / name).exists():
            continue
        try:
            for entry in ElementTree.parse(folder / name).iter("DataSet"):
                if not (folder / entry.get("file")).exists():
                    wrong.append(f"{name}: {entry.get('file')} is not there")
        except ElementTree.ParseError as error:
            wrong.append(f"{name}: {error}")
    return wrong


def wait_for(condition, seconds=900):
    """Whether the condition came true in time."""
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        if condition():
            return True
        time.sleep(0.002)
    return False


def send(process, which=signal.SIGINT):
    process.send_signal(which)
