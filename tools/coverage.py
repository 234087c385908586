#!/usr/bin/python3
"""Sums up what the tests of `make coverage` ran: lines by module, and the error messages that no test has provoked.

    tools/coverage.py build-coverage [--raw build-coverage/raw] [--html]

Reads the profiles that the programs left in the folder --raw (clang's counters: they belong to the source, not to the
instructions, so that optimised code counts as it is written). Writes BUILD/coverage/{counts.json,lines.txt}, and pages with
--html.
"""
import argparse
import json
import os
import subprocess
import sys
from collections import defaultdict
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
import unprovoked_errors

ROOT = Path(__file__).resolve().parent.parent


def programs(build):
    """The programs whose profiles count: fissura and the tests."""
    found = [build / "fissura", *sorted((build / "tests").iterdir())]
    return [p for p in found if p.is_file() and os.access(p, os.X_OK) and p.suffix == ""]


def llvm(tool, *arguments, **options):
    for name in (f"{tool}-14", tool):
        try:
            return subprocess.run([name, *map(str, arguments)], check=True, **options)
        except FileNotFoundError:
            continue
    sys.exit(f"there is no {tool}: it comes with clang (package llvm)")


def counts(build, raw, out):
    """The counters of all programs as llvm-cov exports them, and the arguments that name them."""
    profiles = sorted(raw.glob("*.profraw"))
    if not profiles:
        sys.exit(f"no profiles in {raw}: run the tests with LLVM_PROFILE_FILE={raw}/%p-%m.profraw")
    merged = out / "all.profdata"
    llvm("llvm-profdata", "merge", "-sparse", *profiles, "-o", merged)
    first, *others = programs(build)
    named = [first, *(f"-object={p}" for p in others), f"-instr-profile={merged}", "-ignore-filename-regex=(^|/)(tests|usr)/"]
    exported = llvm("llvm-cov", "export", "-format=text", *named, stdout=subprocess.PIPE)
    data = json.loads(exported.stdout)
    files = data["data"][0]["files"]
    for file in files:
        file["filename"] = os.path.normpath(file["filename"])  # a compiler cache makes them relative
    wanted = (f"{ROOT}/src/", f"{ROOT}/apps/")
    data["data"][0]["files"] = files = [f for f in files if f["filename"].startswith(wanted)]
    (out / "counts.json").write_text(json.dumps(data))
    return files, named


def module_of(path):
    parts = Path(path).relative_to(ROOT).parts
    return parts[2] if parts[:2] == ("src", "fissura") else "/".join(parts[:2])


def table(files):
    """Lines by module, the worst files below."""
    total, covered = defaultdict(int), defaultdict(int)
    for file in files:
        lines = file["summary"]["lines"]
        for name in (module_of(file["filename"]), "all"):
            total[name] += lines["count"]
            covered[name] += lines["covered"]
    row = lambda name, have, of: f"{name:50} {have:6} of {of:6} lines  {100 * have / max(of, 1):5.1f} %"
    text = [row(m, covered[m], total[m]) for m in sorted(total, key=lambda m: (m == "all", m))]
    text.append("\nFiles below 90 %:")
    for file in sorted(files, key=lambda f: f["summary"]["lines"]["percent"]):
        lines = file["summary"]["lines"]
        if lines["percent"] < 90:
            text.append(row(str(Path(file["filename"]).relative_to(ROOT)), lines["covered"], lines["count"]))
    return "\n".join(text)


def main():
    parser = argparse.ArgumentParser(description="Lines and error messages that the tests ran.")
    parser.add_argument("build", type=Path)
    parser.add_argument("--raw", type=Path)
    parser.add_argument("--html", action="store_true")
    arguments = parser.parse_args()
    build, out = arguments.build.resolve(), arguments.build.resolve() / "coverage"
    out.mkdir(exist_ok=True)
    files, named = counts(build, arguments.raw or build / "raw", out)
    text = table(files)
    (out / "lines.txt").write_text(text + "\n")
    print(text)
    if arguments.html:
        llvm("llvm-cov", "show", "-format=html", f"-output-dir={out}", *named)
    print("\nError messages that no test has provoked:")
    print("\n".join(unprovoked_errors.report(files)))


if __name__ == "__main__":
    main()
