#!/usr/bin/python3
"""Tests of the verification tools: each states its requirement. Run: python3 tools/test_verify.py"""
import csv
import json
import math
import stat
import subprocess
import sys
import tempfile
import types
import unittest
from pathlib import Path

import numpy as np

TOOLS = Path(__file__).resolve().parent
sys.path.insert(0, str(TOOLS))
import fissura_io as io
import verify
import verify_checks
import verify_measures as measure
import verify_runs
from verify_page import older_rows, write_page

# A program that writes a run folder with a straight line in it: force = 0.9 of what the prism's theory says.
PROGRAM = f"""#!{sys.executable}
import json, os, sys
out = sys.argv[sys.argv.index("--out") + 1]
os.makedirs(out, exist_ok=True)
if "concrete.0.penalty=60" in sys.argv:
    sys.exit("fissura: it broke")
u = 1e-6
open(out + "/history.csv", "w").write("time [s],force [N],u_right [m],u_left [m]\\n0,0,0,0\\n1,%.17g,%g,0\\n" % (0.9 * 30e9 * 0.04 * u, u))
deck = sys.argv[2]
echo = open(deck).read() if "/runs/" in deck else repr([a for a in sys.argv if "=" in a])
open(out + "/case.toml", "w").write(echo)
json.dump({{"status": "complete", "energy_residual": -0.001, "state_hash": "1", "bar_elements": 8}}, open(out + "/run.json", "w"))
open(out + "/count", "a").write("x")
"""


class Folder(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.path = Path(self.folder.name)
        self.program = self.path / "program"
        self.program.write_text(PROGRAM)
        self.program.chmod(self.program.stat().st_mode | stat.S_IXUSR)

    def tearDown(self):
        self.folder.cleanup()

    def runs(self, **options):
        return verify_runs.Runs(self.program, self.path / "runs", jobs=2, **options)


class Rows(Folder):
    def check(self, name="prism_A", tolerance=0.1, reference=10):
        return verify_checks.Check("tension_prism", "error [%]", reference, tolerance, measure.prism_error, (name,))

    def test_a_value_within_its_tolerance_passes_and_one_outside_does_not(self):
        runs = self.runs()
        runs.make(["prism_A"])
        row, trouble = verify.evaluate(self.check(), runs)
        self.assertEqual((trouble, row[5]), ("", "true"))
        self.assertAlmostEqual(float(row[3]), 10, places=6)
        self.assertEqual(verify.evaluate(self.check(reference=10.2), runs)[0][5], "false")
        self.assertEqual(verify.evaluate(self.check(reference=math.nan, tolerance=math.inf), runs)[0][5], "true")

    def test_a_run_that_fails_gives_a_failing_row_that_says_why(self):
        runs = self.runs()
        runs.make(["prism_A", "prism_A_60"])
        row, trouble = verify.evaluate(self.check("prism_A_60"), runs)
        self.assertEqual(row[5], "false")
        self.assertIn("it broke", trouble)
        self.assertEqual(verify.evaluate(self.check("prism_A"), runs)[0][5], "true")

    def test_a_run_that_lacks_what_is_read_gives_a_failing_row(self):
        runs = self.runs()
        runs.make(["prism_A"])
        check = verify_checks.Check("x", "y", 0, math.inf, measure.tie, ("prism_A",))
        row, trouble = verify.evaluate(check, runs)
        self.assertEqual(row[5], "false")
        self.assertIn("elongation", trouble)

    def test_a_missing_program_gives_failing_rows_and_exit_code_1(self):
        out = self.path / "v.csv"
        done = subprocess.run([sys.executable, TOOLS / "verify.py", "--program", self.path / "none", "--runs", self.path / "r",
                               "--out", out], capture_output=True, text=True)
        self.assertEqual(done.returncode, 1)
        self.assertNotIn("Traceback", done.stderr)
        with open(out, newline="") as file:
            rows = list(csv.DictReader(file))
        self.assertGreaterEqual(len(rows), 20)
        self.assertEqual({r["pass"] for r in rows}, {"false"})
        self.assertEqual(list(rows[0]), ["case", "quantity", "reference", "computed", "tolerance", "pass"])


class Cache(Folder):
    def made(self, name="prism_A"):
        return (self.path / "runs" / name / "count").read_text()

    def test_a_run_is_used_again_until_the_program_changes(self):
        self.runs().make(["prism_A"])
        self.runs().make(["prism_A"])
        self.assertEqual(self.made(), "x")
        self.program.write_text(PROGRAM + "# newer\n")
        self.runs().make(["prism_A"])
        self.assertEqual(self.made(), "xx")

    def test_other_changes_of_the_deck_are_another_run(self):
        keys = {verify_runs.key_of(spec, self.program) for spec in verify_runs.all_runs().values()}
        self.assertEqual(len(keys), len(verify_runs.all_runs()))

    def test_only_cached_runs_nothing(self):
        runs = self.runs(only_cached=True)
        runs.make(["prism_A"])
        with self.assertRaises(verify_runs.RunFailed):
            runs.get("prism_A")

    def test_a_run_that_somebody_stopped_is_not_kept(self):
        self.program.write_text(self.program.read_text().replace('"complete"', '"stopped"'))
        runs = self.runs()
        runs.make(["prism_A"])
        self.assertFalse(runs.is_cached("prism_A"))
        with self.assertRaisesRegex(verify_runs.RunFailed, "prism_A: the run is stopped"):
            runs.get("prism_A")

    def test_a_run_that_is_wanted_until_a_time_may_end_before_it(self):
        """A run with `until` counts whether it was stopped at that time or came to an end of its own before; stopped otherwise it does not."""
        name = next(n for n, s in verify_runs.all_runs().items() if s.until)
        for status, reason, good in (("complete", "stop of `load`", True), ("stopped", "time of --until reached", True), ("stopped", "signal 15", False)):
            self.program.write_text(PROGRAM.replace('"status": "complete"', f'"status": "{status}", "reason": "{reason}"'))
            runs = self.runs()
            runs.make([name])
            self.assertEqual(runs.is_cached(name), good, (status, reason))

    def test_a_finished_run_of_the_same_deck_is_adopted_and_no_other(self):
        self.runs().make(["prism_A", "prism_B"])
        runs = self.runs()
        (self.path / "runs" / "prism_A").rename(self.path / "runs" / "by_hand")
        source = self.path / "runs" / "by_hand"
        runs.adopt("prism_A", source)
        self.assertTrue(runs.is_cached("prism_A"))
        with self.assertRaises(verify_runs.RunFailed):
            runs.adopt("prism_B", source)
        (source / "run.json").write_text(json.dumps({"status": "stopped"}))
        with self.assertRaises(verify_runs.RunFailed):
            runs.adopt("prism_A", source)


class Table(unittest.TestCase):
    def test_every_check_names_a_known_case_and_known_runs(self):
        specs = verify_runs.all_runs()
        for check in verify_checks.all_checks():
            self.assertIn(check.case, verify_checks.CASES)
            for name in check.runs:
                self.assertIn(name, specs)

    def test_rows_are_unique_and_the_short_set_has_twenty(self):
        checks = verify_checks.all_checks()
        self.assertEqual(len({(c.case, c.quantity) for c in checks}), len(checks))
        specs = verify_runs.all_runs()
        self.assertGreaterEqual(sum(not any(specs[n].long for n in c.runs) for c in checks), 20)

    def test_every_deck_is_there(self):
        for spec in verify_runs.all_runs().values():
            self.assertTrue((verify_runs.EXAMPLES / spec.deck).is_file(), spec.deck)

    def test_the_page_shows_failing_rows_as_such(self):
        checks = [c for c in verify_checks.all_checks() if c.case == "elastic_tie"][:2]
        rows = [[checks[0].case, checks[0].quantity, "11", "11.3", "1", "true"],
                [checks[1].case, checks[1].quantity, "4.1", "9", "1", "false"]]
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "index.md"
            write_page(path, rows, checks)
            text = path.read_text()
        self.assertIn("2 rows, 1 outside their tolerance", text)
        self.assertIn("| 4.1 | 9 | 1 | **no** |", text)


    def test_the_page_keeps_rows_that_are_not_computed_and_marks_them(self):
        checks = [c for c in verify_checks.all_checks() if c.case == "elastic_tie"][:2]
        rows = [[c.case, c.quantity, f"{c.reference:g}", f"{c.reference:g}", f"{c.tolerance:g}", "true"] for c in checks]
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "index.md"
            write_page(path, rows, checks)
            self.assertIn("All rows were computed by one build", path.read_text())
            for _ in range(2):  # also from a page that has marks already
                older = older_rows(path, checks[1:])
                self.assertEqual(older, {checks[1]: [*rows[1][:2], f"{checks[1].reference:.6g}", rows[1][3], f"{checks[1].tolerance:.6g}", "true"]})
                write_page(path, [rows[0], older[checks[1]]], checks, older)
            text = path.read_text()
            older = older_rows(path, checks)
            write_page(path, [older[c] for c in checks], checks, older)
            all_older = path.read_text()
        self.assertIn("1 rows were computed by one build; 1 are older", text)
        self.assertEqual((text.count("° |"), text.count("*Computed by an earlier build.*")), (1, 0))
        self.assertIn("0 rows were computed by one build; 2 are older", all_older)
        self.assertEqual((all_older.count("° |"), all_older.count("*Computed by an earlier build.*")), (0, 1))


class Measures(unittest.TestCase):
    def test_the_running_mean_keeps_a_constant_and_levels_a_spike(self):
        time = np.linspace(0, 1, 1001)
        values = np.full(1001, 3.0)
        self.assertTrue(np.allclose(measure.running_mean(time, values, 0.1), 3))
        values[500] = 103
        self.assertLess(measure.running_mean(time, values, 0.1).max(), 4.1)

    def test_curves_follow_the_time_of_the_loads_where_pace_control_bends_it(self):
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "history.csv"
            for head, row, expected in (("time [s]", "1", 1), ("time [s],load_time [s]", "1,2.5", 2.5)):
                path.write_text(f"{head}\n{row}\n{row}\n")
                run = types.SimpleNamespace(history=io.History(path))
                self.assertEqual(measure.clock(run)[0], expected)


if __name__ == "__main__":
    unittest.main()
