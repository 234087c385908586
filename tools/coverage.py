#!/usr/bin/python3
"""Sums up what the tests of `make coverage` ran: lines by module, and the error messages that no test has provoked.

    tools/coverage.py build-coverage [--run [--jobs 2] [--kinds unit,faults]] [--html]

With --run every test program runs first, as a whole and with a profile of its own, and then those tests that run `fissura` itself
(without kills and restarts); else the profiles in BUILD/raw are read as they are. (They hold clang's counters: those belong to the
source, not to the instructions, so that optimised code counts as it is written.) Writes BUILD/coverage/{counts.json,lines.txt}, and
pages with --html. Exits with 1 if there is a message without a test.
"""
import argparse
import json
import os
import shutil
import subprocess
import sys
from collections import defaultdict
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
import unprovoked_errors

ROOT = Path(__file__).resolve().parent.parent


def programs(build):
    """The programs whose profiles count: fissura and the tests."""
    found = [build / "fissura", *sorted((build / "tests").iterdir())]
    return [p for p in found if p.is_file() and os.access(p, os.X_OK) and p.suffix == ""]


def run_tests(build, raw, jobs, kinds):
    """Runs the test programs of the given kinds, then the tests of the house; profiles in `raw`. Tests that fail are named, and count
    all the same."""
    shutil.rmtree(raw, ignore_errors=True)
    def run(program):
        environment = {**os.environ, "LLVM_PROFILE_FILE": f"{raw}/{program.name}.profraw"}
        done = subprocess.run([program, "--gtest_brief=1"], env=environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        print(f"{program.name}: {'passed' if done.returncode == 0 else 'FAILED: ' + done.stdout}", flush=True)
    with ThreadPoolExecutor(jobs) as pool:
        list(pool.map(run, [p for p in programs(build)[1:] if p.name.split("_")[0] in kinds]))
    chosen = r"^(look|faults\.io|house\.(examples|mistakes|commands))"
    subprocess.run(["ctest", "--test-dir", build, "-R", chosen, "-j", str(jobs), "--output-on-failure"],
                   env={**os.environ, "LLVM_PROFILE_FILE": f"{raw}/fissura_%4m.profraw"})


def llvm(tool, *arguments, **options):
    for name in (f"{tool}-14", tool):
        try:
            return subprocess.run([name, *map(str, arguments)], check=True, **options)
        except FileNotFoundError:
            continue
    sys.exit(f"there is no {tool}: it comes with clang (package llvm)")


def counts(build, raw, out):
    """The counters of all programs as llvm-cov exports them, and the arguments that name them. (llvm-cov warns of some hundred functions
    with mismatched data: inline functions of headers that a program reads and does not call. It holds an empty entry for them, with
    the hash 0; they are counted where a program does call them, so nothing is lost.)
    """
    profiles = sorted(raw.glob("*.profraw"))
    if not profiles:
        sys.exit(f"no profiles in {raw}: --run makes them")
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
    parser.add_argument("--run", action="store_true")
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("--kinds", default="unit,laws,faults,regression,verification", help="of tests, with --run")
    parser.add_argument("--html", action="store_true")
    arguments = parser.parse_args()
    build, out = arguments.build.resolve(), arguments.build.resolve() / "coverage"
    out.mkdir(exist_ok=True)
    if arguments.run:
        run_tests(build, build / "raw", arguments.jobs, arguments.kinds.split(","))
    files, named = counts(build, build / "raw", out)
    text = table(files)
    (out / "lines.txt").write_text(text + "\n")
    print(text)
    if arguments.html:
        llvm("llvm-cov", "show", "-format=html", f"-output-dir={out}", *named)
    print("\nError messages that no test has provoked:")
    text, good = unprovoked_errors.report(files)
    print("\n".join(text))
    sys.exit(not good)


if __name__ == "__main__":
    main()
