#!/usr/bin/python3
"""Runs the verification cases and compares them with theory and with the founding paper.

    verify.py --program build/fissura --out build/verification.csv            the short cases, minutes
    verify.py --program build/fissura --out build/validation.csv --long       all of them, an hour or more
    verify.py --out build/validation.csv --page docs/verification/index.md    also write the page

Rows: case, quantity, reference, computed, tolerance, pass. A row with tolerance inf is information. Exits with 1 if a row fails;
a run that fails gives failing rows, not an end.
"""
import argparse
import csv
import math
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
import verify_checks
from fissura_io import BadFile
from verify_page import older_rows, write_page
from verify_runs import ROOT, RunFailed, Runs

HEAD = ["case", "quantity", "reference", "computed", "tolerance", "pass"]


def evaluate(check, runs):
    """One row, and what went wrong if something did."""
    computed, trouble = math.nan, ""
    try:
        computed = float(check.measure(*(runs.get(name) for name in check.runs)))
    except (RunFailed, BadFile, OSError) as error:
        trouble = str(error)
    except (KeyError, IndexError, TypeError, ValueError, ZeroDivisionError) as error:
        trouble = f"the run does not show it ({type(error).__name__}: {error})"
    if not trouble and not math.isfinite(computed):
        trouble = "not a finite number"
    passed = not trouble and (check.tolerance == math.inf or abs(computed - check.reference) <= check.tolerance)
    row = [check.case, check.quantity, f"{check.reference:.6g}", f"{computed:.6g}", f"{check.tolerance:.6g}",
           "true" if passed else "false"]
    return row, trouble


def print_table(rows):
    width = [max(len(r[i]) for r in [HEAD, *rows]) for i in range(6)]
    for r in [HEAD, *rows]:
        shown = r if r is HEAD else [*r[:5], "ok" if r[5] == "true" else "FAIL"]
        print("  ".join(text.ljust(width[i]) if i < 2 else text.rjust(width[i]) for i, text in enumerate(shown)))


def parse():
    parser = argparse.ArgumentParser(description="Runs the verification cases and compares them with theory and the paper.")
    parser.add_argument("--program", default=str(ROOT / "build" / "fissura"))
    parser.add_argument("--out", default=str(ROOT / "build" / "verification.csv"), help="CSV to write")
    parser.add_argument("--runs", default=str(ROOT / "build" / "verify"), help="folder of the runs; runs of the same program and deck are used again")
    parser.add_argument("--long", action="store_true", help="also the cases that take long")
    parser.add_argument("--only", action="append", metavar="CASE", help="this case only; may be given several times")
    parser.add_argument("--jobs", type=int, default=0, help="runs at a time (default: one per core)")
    parser.add_argument("--cached", action="store_true", help="run nothing; leave out rows whose runs are not there")
    parser.add_argument("--adopt", action="append", default=[], metavar="NAME=DIR", help="take a run folder made by hand")
    parser.add_argument("--page", metavar="FILE", help="write the verification page; rows that are not computed now stay as they stand in it, marked as older")
    return parser.parse_args()


def main():
    arguments = parse()
    runs = Runs(arguments.program, arguments.runs, arguments.jobs, arguments.cached)
    try:
        for name, _, source in (a.partition("=") for a in arguments.adopt):
            runs.adopt(name, source)
    except (RunFailed, KeyError, OSError) as error:
        sys.exit(f"verify: cannot adopt {error}")

    every = verify_checks.all_checks()
    checks = [c for c in every if not arguments.only or c.case in arguments.only]
    if not arguments.long:
        checks = [c for c in checks if not any(runs.specs[name].long for name in c.runs)]
    needed = list(dict.fromkeys(name for c in checks for name in c.runs))
    if arguments.cached:
        checks = [c for c in checks if all(runs.is_cached(name) for name in c.runs)]
    if not checks:
        sys.exit("verify: nothing to check; cases: " + ", ".join(verify_checks.CASES))
    runs.make(needed)

    results = [evaluate(c, runs) for c in checks]
    rows = [row for row, _ in results]
    Path(arguments.out).parent.mkdir(parents=True, exist_ok=True)
    with open(arguments.out, "w", newline="", encoding="utf-8") as file:
        csv.writer(file, lineterminator="\n").writerows([HEAD, *rows])
    print_table(rows)
    for (row, trouble) in results:
        if trouble:
            print(f"{row[0]}, {row[1]}: {trouble}")
    if arguments.page:
        row_of = dict(zip(checks, rows))
        older = older_rows(arguments.page, [c for c in every if c not in row_of])
        shown = [c for c in every if c in row_of or c in older]
        write_page(arguments.page, [row_of.get(c) or older[c] for c in shown], shown, older,
                   [a.partition("=")[0] for a in arguments.adopt])
    failed = sum(row[5] != "true" for row in rows)
    print(f"{len(rows)} rows, {failed} failed: {arguments.out}")
    sys.exit(1 if failed else 0)


if __name__ == "__main__":
    main()
