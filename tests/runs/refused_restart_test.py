#!/usr/bin/python3
"""Requirement: a restart that is refused leaves the run folder as it was, to the byte, the newer checkpoint included, and says why.

    refused_restart_test.py PROGRAM

Every kind of refusal is provoked on a copy of one run with two checkpoints, from the older of them: what a restart would take away
or write over is all there.
"""
import fcntl
import hashlib
import re
import shutil
import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent.parent / "tools"))
from run_pairs import ROOT, Program, checkpoints

PROGRAM = ROOT / "build" / "fissura"
DECK = ROOT / "tests" / "runs" / "tie.toml"
OLDER = "checkpoint_00001.bin"
BEGIN = ("--set", "output.checkpoint_steps=20", "--set", "run.max_steps=35")


def fingerprint(folder):
    """Of names, kinds, modes and contents of all that is in a folder."""
    all_of_it = hashlib.sha256()
    for path in sorted(Path(folder).rglob("*")):
        all_of_it.update(f"{path.relative_to(folder)} {path.stat().st_mode}\n".encode())
        if path.is_file():
            all_of_it.update(path.read_bytes())
    return all_of_it.hexdigest()


def put(path, at, value):
    """Other bytes at a place of a file, counted from its end if it is negative."""
    content = bytearray(path.read_bytes())
    at += len(content) if at < 0 else 0
    content[at:at + len(value)] = value
    path.write_bytes(bytes(content))


def flip(path, at):
    put(path, at, bytes([path.read_bytes()[at] ^ 4]))


def with_gauge(text, **keys):
    """The deck with one gauge more."""
    lines = "\n".join(f"{k} = {v}" for k, v in keys.items())
    return f"{text}\n[[gauge]]\n{lines}\n"


def older(run):
    return run / "checkpoints" / OLDER


def swap(old, new):
    return lambda text: text.replace(old, new)


# kind: (what is done to the folder, what is done to the deck, further options, exit code, words of the refusal)
KINDS = {
    "another material": (None, swap('f_t = "2.9 MPa"', 'f_t = "3 MPa"'), (), 2, r"\[\[concrete\]\] 1, f_t = .* \(was"),
    "another mesh": (None, swap("cells = [3, 1, 1]", "cells = [4, 1, 1]"), (), 2, r"\[\[mesh.box\]\] 1, cells"),
    "another bar": (None, swap('"12 mm"', '"14 mm"'), (), 2, r"\[\[bar\]\] 1, diameter"),
    "one bar more": (None, lambda text: text + '\n[[bar]]\nsteel = "B500"\ndiameter = "8 mm"\n'
                     'points = [["0 m", "20 mm", "50 mm"], ["0.3 m", "20 mm", "50 mm"]]\n', (), 2, r"\[\[bar\]\] 2"),
    "another steel": (None, swap('"500 MPa"', '"450 MPa"'), (), 2, r"\[\[steel\]\] 1, f_y"),
    "another support": (None, swap('["x", "y", "z"]', '["x"]'), (), 2, r"\[\[support\]\] 1, fix"),
    "another load": (None, swap('"0.2 m/s"', '"0.3 m/s"'), (), 2, r"\[\[motion\]\] 1, velocity"),
    "another stage": (None, swap('duration = "0.05 ms"', 'duration = "0.06 ms"'), (), 2, r"\[\[stage\]\] 1, duration"),
    "one stage more": (None, lambda text: text + '\n[[stage]]\nname = "c"\nduration = "1 ms"\n', (), 2, r"\[\[stage\]\]"),
    "another time step": (None, None, ("--set", "run.dt_factor=0.5"), 2, r"\[run\] dt_factor"),
    "no TOML": (None, lambda text: text + "\n[run\n", (), 2, r"tie.toml:\d+"),
    "an unknown key": (None, None, ("--set", "run.end_tine=1"), 2, "unknown key `end_tine`"),
    "a mesh file that is not there": (None, lambda text: re.sub(r"\[\[mesh.box\]\].*?\n\n", '[mesh]\nfile = "no.msh"\n\n', text, flags=re.S),
                                      (), 2, "no.msh"),
    "an end in the past": (None, None, ("--set", "run.end_time=1 us"), 2, r"is to end at 1e-06 s \(the deck\), and has come to"),
    "an --until in the past": (None, None, ("--until", "1 us"), 2, r"is to end at 1e-06 s \(--until\), and has come to"),
    "an --until that is no time": (None, None, ("--until", "nan"), 2, "--until must be a time of 0 s or more, not `nan`"),
    "a --walltime below zero": (None, None, ("--walltime=-1",), 2, "--walltime must be a time of 0 s or more, not `-1`"),
    "too many threads": (None, None, ("--threads", "100000"), 2, "--threads: Value 100000 not in range"),
    "fewer than no threads": (None, None, ("--threads=-2",), 2, "--threads: Value -2 not in range"),
    "no checkpoint by its magic": (lambda run: flip(older(run), 3), None, (), 2, "not a checkpoint of Fissura"),
    "a newer format": (lambda run: put(older(run), 16, (1000).to_bytes(4, "little")), None, (), 2, "format 1000"),
    "an older format": (lambda run: put(older(run), 16, (1).to_bytes(4, "little")), None, (), 2, "format 1, this program reads"),
    "another order of bytes": (lambda run: flip(older(run), 20), None, (), 2, "another order of bytes"),
    "a damaged body": (lambda run: flip(older(run), 3000), None, (), 2, "checksum is wrong"),
    "a damaged checksum": (lambda run: flip(older(run), -12), None, (), 2, "checksum is wrong"),
    "a checkpoint cut off": (lambda run: older(run).write_bytes(older(run).read_bytes()[:-700]), None, (), 2, "cut off"),
    "an empty checkpoint": (lambda run: older(run).write_bytes(b""), None, (), 2, "not a checkpoint"),
    "a checkpoint that is not there": (lambda run: older(run).unlink(), None, (), 2, "neither a checkpoint nor a run folder"),
    "a checkpoint of another case": (lambda run: shutil.copy(run.parent / "other" / "checkpoints" / OLDER, older(run)), None, (), 2,
                                     "the deck has changed since"),
    "a history that is gone": (lambda run: (run / "history.csv").unlink(), None, (), 3, "cannot open '.*history.csv'"),
    "a history cut short": (lambda run: (run / "history.csv").write_bytes((run / "history.csv").read_bytes()[:900]), None, (), 2, "shorter"),
    "a history of other columns": (lambda run: put(run / "history.csv", 0, b"x"), None, (), 2, "its columns are others"),
    "a history with a broken row": (lambda run: (run / "history.csv").write_text(
        re.sub(r"\n([^,]*),", r"\n\1;", (run / "history.csv").read_text(), count=1)), None, (), 2, "too few or too many values"),
    "a gauge whose zero has passed": (None, lambda text: with_gauge(text, name='"late"', kind='"reaction"', of='["pull"]', axis='"x"',
                                                                    zero_at='"a"'), (), 2, "its zero is not known"),
    "a stop that was met before": (None, lambda text: text + '\n[[stop]]\ngauge = "u"\nabove = "-1 mm"\n', (), 2,
                                   "before the checkpoint: the run would have ended there"),
    "one in a folder that a killed run has left": (lambda run: (run / ".lock").write_text("fissura: in use by process 1 on x\n"), None,
                                                   ("--set", "run.dt_factor=0.5"), 2, "dt_factor"),
    "a stop of no gauge": (None, lambda text: text + '\n[[stop]]\ngauge = "no"\nabove = 1\n', (), 2, "no"),
}


class RefusedRestarts(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory()
        cls.folder = Path(cls.temporary.name)
        cls.program = Program(PROGRAM)
        cls.program.must_run(DECK, "--out", cls.folder / "run", *BEGIN)
        cls.program.must_run(DECK, "--out", cls.folder / "other", *BEGIN, "--set", "concrete.0.E=\"31 GPa\"")
        assert [c.name for c in checkpoints(cls.folder / "run")][0] == OLDER, "two checkpoints are wanted"
        assert len(checkpoints(cls.folder / "run")) == 2

    @classmethod
    def tearDownClass(cls):
        cls.temporary.cleanup()

    def copy(self, change_folder, change_deck):
        """A run and its deck, both changed."""
        run, deck = self.folder / "copy", self.folder / "tie.toml"
        shutil.rmtree(run, ignore_errors=True)
        shutil.copytree(self.folder / "run", run)
        deck.write_text((change_deck or str)(DECK.read_text()))
        if change_folder:
            change_folder(run)
        return run, deck

    def test_leave_the_folder_as_it_was(self):
        """Each kind ends with its exit code and its words, and the folder's fingerprint is what it was."""
        self.assertGreaterEqual(len(KINDS), 12)
        for kind, (change_folder, change_deck, options, code, words) in KINDS.items():
            with self.subTest(kind):
                run, deck = self.copy(change_folder, change_deck)
                before = fingerprint(run)
                done = self.program.run(deck, "--restart", older(run), *options)
                self.assertEqual(done.returncode, code, done.stderr)
                self.assertRegex(done.stderr, words)
                self.assertEqual(fingerprint(run), before)

    def test_while_somebody_holds_the_folder(self):
        """A folder that another process has locked is refused and left alone."""
        run, deck = self.copy(None, None)
        with open(run / ".lock", "w") as lock:
            fcntl.flock(lock, fcntl.LOCK_EX)
            before = fingerprint(run)
            done = self.program.run(deck, "--restart", older(run))
            self.assertEqual(done.returncode, 3)
            self.assertIn("is in use by another run", done.stderr)
            self.assertEqual(fingerprint(run), before)

    def test_accepted_ones_differ(self):
        """The same restart without a fault goes on: the table refuses for its own reasons."""
        run, deck = self.copy(None, None)
        before = fingerprint(run)
        done = self.program.run(deck, "--restart", older(run), "--set", "run.max_steps=50")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertNotEqual(fingerprint(run), before)


if __name__ == "__main__":
    if len(sys.argv) > 1 and not sys.argv[1].startswith("-"):
        PROGRAM = Path(sys.argv.pop(1)).resolve()
    unittest.main()
