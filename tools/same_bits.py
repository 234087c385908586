#!/usr/bin/python3
"""Runs the smashed beam (fracture, bars, contact) on different numbers of threads, each several times: the same state, to the
last bit, at every hundredth step and at the end; the same history, byte by byte.

    same_bits.py --program build/fissura --threads 1 2 3 4 8 16 --repeats 3

Exits with 1 if two runs differ. The program may be of any compiler: it is compared with itself.
"""
import argparse
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
from run_pairs import ROOT, SMASHED, Program, hashes_in_log, summary

COUNTS = ("joints_damaged", "joints_broken", "bar_joints_activated", "bar_joints_yielded")


def outcome(program, folder, threads, until):
    """All that must be the same: hashes on the way, the one at the end, the history."""
    program.must_run(SMASHED, "--out", folder, "--force", "--threads", threads, "--until", until,
                     "--set", "output.hash_every=100", "--set", "output.frames=2")
    numbers = summary(folder)
    return numbers, (hashes_in_log(folder), numbers["state_hash"], (Path(folder) / "history.csv").read_bytes())


def main():
    parser = argparse.ArgumentParser(description="Compares runs on different numbers of threads.")
    parser.add_argument("--program", default=str(ROOT / "build" / "fissura"))
    parser.add_argument("--threads", type=int, nargs="+", default=[1, 2, 3, 4, 8, 16])
    parser.add_argument("--repeats", type=int, default=3)
    parser.add_argument("--until", type=float, default=0.006, help="time of the beam, s (default: all of it)")
    arguments = parser.parse_args()
    program, first, runs, trouble = Program(arguments.program), None, 0, []
    with tempfile.TemporaryDirectory() as folder:
        for threads in arguments.threads:
            for repeat in range(arguments.repeats):
                numbers, found = outcome(program, folder, threads, arguments.until)
                runs += 1
                first = first or found
                if found != first:
                    trouble.append(f"{threads} threads, run {repeat + 1}: differs from the first run")
    for line in trouble:
        print(line)
    if not numbers["joints_broken"] or not first[0]:
        trouble.append("nothing broke")
    counts = ", ".join(f"{name} {numbers[name]}" for name in COUNTS)
    print(f"{runs} runs of {numbers['steps']} steps, {len(first[0])} hashes each, {counts}: state {first[1]}, "
          f"{len(trouble)} things wrong")
    sys.exit(1 if trouble else 0)


if __name__ == "__main__":
    main()
