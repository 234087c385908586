#!/usr/bin/python3
"""Kills a run at random moments, again and again, and lets it go on each time.

    kill_test.py --program build/fissura --kills 200 --seed 1

After every kill the newest checkpoint must be readable (the run goes on with it), no line of history.csv and no list of frames
may be broken, and no more than one interval between checkpoints may be lost. Whenever the run gets to its end it must have left
the same files as a run that was never killed; then it starts anew. Exits with 1 if anything is wrong.
"""
import argparse
import random
import re
import shutil
import signal
import sys
import tempfile
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
from run_pairs import ROOT, SMASHED, Program, broken_lines, checkpoints, differences, summary, wait_for

UNTIL = 0.0016
INTERVAL = 40  # steps between two checkpoints


def last_row(folder, dt):
    """The step of the last row of the history, or 0."""
    history = Path(folder) / "history.csv"
    rows = history.read_text().split("\n") if history.exists() else []
    whole = [r for r in rows[1:-1] if r]
    return round(float(whole[-1].split(",")[0]) / dt) if whole else 0


def log_of(folder):
    log = Path(folder) / "log.txt"
    return log.read_text() if log.exists() else ""


def step_of_restart(log):
    """The step at which the run has gone on the last time."""
    found = re.findall(r"goes on from .*, step (\d+)", log)
    return int(found[-1]) if found else 0


class Killer:
    def __init__(self, program, kills, seed, folder):
        self.program = Program(program)
        self.kills, self.random, self.folder = kills, random.Random(seed), Path(folder)
        self.run, self.whole = self.folder / "run", self.folder / "whole"
        self.options = ("--until", UNTIL, "--set", f"output.checkpoint_steps={INTERVAL}", "--set", "output.hash_every=100",
                        "--set", "output.history_points=100000", "--set", "output.frames=150")
        self.trouble, self.completed, self.worst = [], 0, 0

    def once(self, number):
        """One run that is killed, from the last checkpoint or from the start."""
        newest = checkpoints(self.run)[-1:] if self.run.exists() else []
        before = last_row(self.run, self.dt) if newest else 0
        if not newest:
            shutil.rmtree(self.run, ignore_errors=True)
        old_log = log_of(self.run)  # cut back first: the new one says more once the run has begun
        begin = ("--restart", self.run) if newest else ("--out", self.run)
        process = self.program.start(SMASHED, *begin, "--threads", self.random.choice((1, 2)), *self.options)
        # Most kills come while it runs, some while it begins.
        if self.random.random() < 0.8:
            wait_for(lambda: process.poll() is not None or not old_log.startswith(log_of(self.run)))
        time.sleep(self.random.uniform(0, self.pace))
        process.send_signal(signal.SIGKILL)
        _, text = process.communicate()
        if process.returncode == 0:
            return self.complete()
        if process.returncode != -signal.SIGKILL:
            self.trouble.append(f"kill {number}: the run ended with {process.returncode}: {text.strip()}")
            shutil.rmtree(self.run, ignore_errors=True)
            return None
        self.trouble += [f"kill {number}: {wrong}" for wrong in broken_lines(self.run)]
        if newest and not old_log.startswith(log_of(self.run)):
            lost = before - step_of_restart(log_of(self.run))
            self.worst = max(self.worst, lost)
            if lost > INTERVAL:
                self.trouble.append(f"kill {number}: {lost} steps were lost")
        return None

    def complete(self):
        self.completed += 1
        self.trouble += [f"run {self.completed}: {name} differs" for name in differences(self.whole, self.run)]
        shutil.rmtree(self.run)

    def go(self):
        begin = time.monotonic()
        self.program.must_run(SMASHED, "--out", self.whole, "--threads", 1, *self.options)
        self.pace = (time.monotonic() - begin) / 3
        self.dt = summary(self.whole)["dt"]
        for number in range(1, self.kills + 1):
            self.once(number)
        while self.run.exists() and checkpoints(self.run):  # to the end
            self.program.must_run(SMASHED, "--restart", self.run, *self.options)
            self.complete()
        return self.trouble


def main():
    parser = argparse.ArgumentParser(description="Kills a run at random moments and lets it go on.")
    parser.add_argument("--program", default=str(ROOT / "build" / "fissura"))
    parser.add_argument("--kills", type=int, default=200)
    parser.add_argument("--seed", type=int, default=1)
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        killer = Killer(arguments.program, arguments.kills, arguments.seed, folder)
        trouble = killer.go()
    for line in trouble:
        print(line)
    print(f"{arguments.kills} kills, {killer.completed} runs to their end, at most {killer.worst} of {INTERVAL} steps lost, "
          f"{len(trouble)} things wrong")
    sys.exit(1 if trouble else 0)


if __name__ == "__main__":
    main()
