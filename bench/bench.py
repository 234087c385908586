#!/usr/bin/python3
"""Times the scenes of `fissura bench` in turn and keeps the medians in bench/results/<machine>.csv.

    bench.py --program build/fissura                 compares with the last results of this machine and replaces them
    bench.py --program build/fissura --rounds 3 --no-large
"""
import argparse
import csv
import os
import re
import statistics
import subprocess
from pathlib import Path

RESULTS = Path(__file__).resolve().parent / "results"
# scene, tets, threads, steps: about a quarter of a second each
SMALL = [("uncracked", 6000, 1, 500), ("unstructured", 6000, 1, 500), ("beam", 6000, 1, 400), ("half_damaged", 6000, 1, 250),
         ("fragmented", 6000, 1, 300), ("uncracked", 6000, 2, 800)]
LARGE = [("uncracked", 750000, 1, 10), ("uncracked", 750000, 2, 20)]
COLUMNS = ("scene", "tets", "threads", "kernels", "ns_per_tet_step", "least", "largest", "over_uncracked")


def machine():
    """Processor and number of its cores, as a file name."""
    text = Path("/proc/cpuinfo").read_text(encoding="utf-8")
    model = re.search(r"model name\s*:\s*(.*)", text)
    name = model.group(1) if model else os.uname().machine
    return re.sub(r"[^a-z0-9]+", "_", name.lower()).strip("_") + f"_{os.cpu_count()}_threads"


def measure(program, scene, tets, threads, steps):
    """ns per tet-step and the kernel set of one run."""
    text = subprocess.run([program, "bench", "--scene", scene, "--tets", str(tets), "--threads", str(threads), "--steps", str(steps)],
                          check=True, capture_output=True, text=True).stdout
    return float(re.search(r"([\d.]+) ns per", text).group(1)), re.search(r"kernels ([\w-]+)", text).group(1)


def rows_of(program, scenes, rounds):
    times = {scene: [] for scene in scenes}
    ratios = {scene: [] for scene in scenes}
    for _ in range(rounds):
        base = None
        for scene in scenes:
            nanoseconds, kernels = measure(program, *scene)
            base = base or nanoseconds
            times[scene].append(nanoseconds)
            ratios[scene].append(nanoseconds / base)
    for scene in scenes:
        t = times[scene]
        yield dict(zip(COLUMNS, (*scene[:3], kernels, f"{statistics.median(t):.1f}", f"{min(t):.1f}", f"{max(t):.1f}",
                                 f"{statistics.median(ratios[scene]):.3f}")))


def read(path):
    if not path.exists():
        return {}
    with open(path, newline="", encoding="utf-8") as file:
        return {(r["scene"], r["tets"], r["threads"]): r for r in csv.DictReader(file)}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", default="build/fissura")
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--no-large", action="store_true", help="leave out the scenes of 750,000 tets")
    arguments = parser.parse_args()
    path = RESULTS / f"{machine()}.csv"
    last = read(path)
    rows = list(rows_of(arguments.program, SMALL, arguments.rounds))
    if not arguments.no_large:
        rows += rows_of(arguments.program, LARGE, arguments.rounds)
    for r in rows:
        before = last.get((r["scene"], str(r["tets"]), str(r["threads"])))
        change = f"  last {before['ns_per_tet_step']}, over uncracked {before['over_uncracked']}" if before else ""
        print(f"{r['scene']:13} {r['tets']:7} tets {r['threads']} threads  {r['ns_per_tet_step']:>7} ns ({r['least']} to {r['largest']}), "
              f"{r['over_uncracked']} of the first{change}")
    RESULTS.mkdir(exist_ok=True)
    with open(path, "w", newline="", encoding="utf-8") as file:
        out = csv.DictWriter(file, COLUMNS, lineterminator="\n")
        out.writeheader()
        out.writerows(rows)
    print(path)


if __name__ == "__main__":
    main()
