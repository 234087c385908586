#!/usr/bin/python3
"""Checks that the hot loops of a built program still fetch ahead: check_prefetch.py PROGRAM.

A function that only prefetches has no effect that a compiler must keep, and gcc drops calls of it unless they are
inlined at once. Nothing fails then; the step is only a sixth slower. So the instructions are looked for, in the joint
and tet loops of every instruction set. Exits with 77 (skipped) where there is no objdump.
"""
import re
import shutil
import subprocess
import sys

LOOPS = ("joint_forces", "tet_forces")
SETS = ("isa_v2", "isa_v3", "isa_v4")
KINDS = {"prefetcht0", "prefetchw"}  # to read, to write


def fetches(listing):
    """(set, loop) -> the kinds of prefetch instructions, from what objdump prints; without a symbol of a loop nothing."""
    found = {(one, loop): set() for one in SETS for loop in LOOPS}
    here = None
    for line in listing:
        if line.endswith(">:\n"):
            here = next((key for key in found if key[0] in line and re.search(r"\d" + key[1] + "I", line)), None)
        elif here and (what := re.search(r"\t(prefetch\w*)\s", line)):
            found[here].add(what.group(1))
    return found


def main():
    if not shutil.which("objdump"):
        return 77
    run = subprocess.run(["objdump", "-d", "--no-show-raw-insn", sys.argv[1]], capture_output=True, text=True, check=True)
    found = fetches(run.stdout.splitlines(keepends=True))
    for (one, loop), kinds in found.items():
        print(f"{one} {loop}: {', '.join(sorted(kinds)) or 'nothing'}")
    bare = [key for key, kinds in found.items() if not KINDS <= kinds]
    for one, loop in bare:
        print(f"{loop} of {one} does not fetch ahead: is its prefetch still inlined at once?", file=sys.stderr)
    return 1 if bare else 0


if __name__ == "__main__":
    sys.exit(main())
