#!/usr/bin/python3
"""The four-point beam of example 4.2 from Python to its collapse, as the tutorial does it: started, stepped, looked at and plotted. It must
end in the same step with the same state, to the last bit, as the run of the command line. Minutes; part of `make validate`.

    PYTHONPATH=build/python validate_python.py --program build/fissura [--runs build/verify]
"""
import argparse
import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
from verify_runs import ROOT, RunFailed, Runs

TUTORIAL = ROOT / "docs" / "tutorials" / "four_point_beam.py"
PNG = b"\x89PNG\r\n\x1a\n"


def from_python(*words):
    """Steps and state hash at the end of the tutorial's run, and its log."""
    # The script runs in a folder of its own, so folders named from here must not be.
    modules = os.pathsep.join(str(Path(p).resolve()) for p in os.environ.get("PYTHONPATH", "").split(os.pathsep) if p)
    with tempfile.TemporaryDirectory() as folder:
        done = subprocess.run([sys.executable, str(TUTORIAL), *words], cwd=folder, env={**os.environ, "PYTHONPATH": modules},
                              capture_output=True, text=True)
        if done.returncode != 0:
            raise RunFailed(f"{TUTORIAL.name}: exit code {done.returncode}\n{done.stderr.strip()}")
        curve = Path(folder) / "four_point_beam.png"
        if not curve.is_file() or not curve.read_bytes().startswith(PNG):
            raise RunFailed(f"{TUTORIAL.name}: no curve was drawn")
    end = re.search(r"^state ([0-9a-f]{16}) after (\d+) steps$", done.stdout, re.MULTILINE)
    if not end:
        raise RunFailed(f"{TUTORIAL.name}: it does not tell its state:\n{done.stdout[-1000:]}")
    return int(end[2]), end[1], done.stdout


def main():
    parser = argparse.ArgumentParser(description="Compares the four-point beam from Python with that of the command line.")
    parser.add_argument("--program", default=str(ROOT / "build" / "fissura"))
    parser.add_argument("--runs", default=str(ROOT / "build" / "verify"))
    arguments = parser.parse_args()
    runs = Runs(arguments.program, arguments.runs)
    runs.make(["four_point"])
    try:
        summary = runs.get("four_point").summary
        steps, state, log = from_python()
    except (RunFailed, OSError) as error:
        sys.exit(str(error))
    print(*[line for line in log.splitlines() if line.startswith("t = ")][-1:], sep="\n")
    for name, ours, theirs in (("steps", steps, summary["steps"]), ("state", state, summary["state_hash"])):
        print(f"{name}: {ours} from Python, {theirs} from the command line")
    if (steps, state) != (summary["steps"], summary["state_hash"]):
        sys.exit("the runs differ")
    print("the same bits")


if __name__ == "__main__":
    main()
