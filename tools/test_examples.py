#!/usr/bin/python3
"""Tests of the examples themselves: each states its requirement. Run: python3 tools/test_examples.py [PROGRAM]

Every deck is read and checked; only runs that take seconds are made (`examples.py --long` makes all of them).
"""
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
from examples import EXAMPLE, differences
from verify_runs import EXAMPLES, ROOT, Runs

PROGRAM = ROOT / "build" / "fissura"
SHORT = 5  # seconds on one quiet core


class Examples(unittest.TestCase):
    def test_each_folder_is_complete(self):
        """Requirement: every example has a deck, a page, an expected curve and a picture, and is known to examples.py."""
        folders = sorted(p.name for p in EXAMPLES.iterdir() if p.is_dir())
        self.assertEqual(folders, sorted(EXAMPLE))
        for name in folders:
            for file in ("case.toml", "README.md", "expected.csv", "picture.png"):
                self.assertTrue((EXAMPLES / name / file).is_file(), f"{name}/{file}")

    def test_each_deck_passes_its_check(self):
        """Requirement: `fissura check` finds no error in any deck."""
        for deck in sorted(EXAMPLES.glob("*/*.toml")):
            done = subprocess.run([str(PROGRAM), "check", str(deck)], capture_output=True, text=True)
            self.assertEqual(done.returncode, 0, done.stderr)

    def test_short_runs_are_as_expected(self):
        """Requirement: runs of seconds stay within their tolerance of expected.csv."""
        with tempfile.TemporaryDirectory() as folder:
            runs = Runs(PROGRAM, folder, jobs=1)
            short = {n: e for n, e in EXAMPLE.items() if runs.specs[e.run].cost < SHORT}
            self.assertGreaterEqual(len(short), 3)
            runs.make([e.run for e in short.values()])
            for name, example in short.items():
                self.assertEqual(list(differences(example, runs.get(example.run), EXAMPLES / name / "expected.csv")), [], name)


if __name__ == "__main__":
    if len(sys.argv) > 1:
        PROGRAM = Path(sys.argv.pop(1)).resolve()
    unittest.main()
