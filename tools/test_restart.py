#!/usr/bin/python3
"""Tests of runs that stop and go on: each states its requirement. Run: python3 tools/test_restart.py [PROGRAM] [--long]

--long: the examples as they stand instead of their first steps, and more seeds.
"""
import random
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
import run_pairs
from run_pairs import ROOT, SMASHED, Program, checkpoints, differences, hashes_in_log, summary, wait_for

PROGRAM = ROOT / "build" / "fissura"
LONG = False
SHORT_UNTIL = 0.0016  # [s] of the smashed beam: joints part, fragments touch, bars yield
WORK, LONG_WORK = 5e5, 3e7  # tet-steps of an example's short version


def catches(pid, number):
    """Whether a process has a handler for a signal."""
    try:
        status = Path(f"/proc/{pid}/status").read_text()
    except FileNotFoundError:
        return False
    caught = next((line.split()[1] for line in status.splitlines() if line.startswith("SigCgt:")), "0")
    return bool(int(caught, 16) >> (number - 1) & 1)


class Folder(unittest.TestCase):
    def setUp(self):
        self.temporary = tempfile.TemporaryDirectory()
        self.folder = Path(self.temporary.name)
        self.program = Program(PROGRAM)

    def tearDown(self):
        self.temporary.cleanup()

    def path(self, name):
        return str(self.folder / name)

    def smash(self, name, *options):
        self.program.must_run(SMASHED, "--out", self.path(name), "--until", SHORT_UNTIL, *options)
        return self.path(name)


class SameBits(Folder):
    def test_for_every_number_of_threads(self):
        """Requirement: a fracturing reinforced body with contact ends in the same state, with the same files and the same
        hashes on the way, on any number of threads and in every repetition."""
        one = self.smash("one", "--threads", 1, "--set", "output.hash_every=100")
        result = summary(one)
        self.assertGreater(result["joints_broken"], 50)
        self.assertGreater(result["bar_joints_yielded"], 0)
        self.assertGreater(result["fragments"]["count"], 5)
        self.assertGreater(result["energy"]["contact_friction"], 0)
        self.assertGreater(len(hashes_in_log(one)), 5)
        for threads in (1, 2, 3, 4, 8, 16):
            for repeat in range(3 if LONG else 1):
                other = self.smash("other", "--threads", threads, "--force", "--set", "output.hash_every=100")
                self.assertEqual(differences(one, other), [], f"{threads} threads, repetition {repeat}")

    def test_with_every_kernel_set(self):
        """Requirement: each kernel set this machine can run gives bits of its own on any number of threads, and is named in
        run.json; a set that is unknown is refused."""
        seen = set()
        for kernels in ("scalar", "v2", "v3", "v4"):
            self.program = Program(PROGRAM, kernels)
            done = self.program.run(SMASHED, "--out", self.path("x"), "--force", "--set", "run.max_steps=1")
            if done.returncode == 2:
                self.assertIn("not for this machine", done.stderr)
                continue
            one = self.smash("one", "--threads", 1, "--force")
            self.assertEqual(differences(one, self.smash("two", "--threads", 2, "--force")), [], kernels)
            seen.add(summary(one)["kernels"])
        self.assertGreaterEqual(len(seen), 2)
        done = Program(PROGRAM, "v9").run(SMASHED, "--out", self.path("y"))
        self.assertEqual(done.returncode, 2)
        self.assertIn("kernel set 'v9' is unknown", done.stderr)


class GoingOn(Folder):
    def compare(self, deck, steps, at, options=(), threads=1, name=""):
        """Stops a run at the given steps, lets it go on, and compares it with one that was never stopped."""
        whole, parts = self.path(f"{name}whole"), self.path(f"{name}parts")
        end = ("--set", f"run.max_steps={steps}") if steps else ()
        if not Path(whole).exists():
            self.program.must_run(deck, "--out", whole, "--threads", threads, *options, *end)
        first = True
        for stop in at:
            begin = ("--out", parts, "--force") if first else ("--restart", parts)
            self.program.must_run(deck, *begin, "--threads", threads, *options, "--set", f"run.max_steps={stop}")
            self.assertEqual(summary(parts)["status"], "stopped")
            first = False
        self.program.must_run(deck, "--restart", parts, "--threads", threads + 1, *options, *end)
        self.assertEqual(differences(whole, parts), [], f"{deck}, stopped at {at} of {steps} steps")
        return whole, parts

    def test_smashed_beam(self):
        """Requirement: a run that was stopped at any step goes on to the last bit: with another number of threads, from a
        restart of a restart, while joints part and are released, fragments touch and bars break."""
        for seed in range(12 if LONG else 4):
            steps = 1185
            at = sorted(random.Random(seed).sample(range(1, steps), 1 + seed % 3))
            whole, _ = self.compare(SMASHED, steps, at, ("--set", "output.hash_every=50"), threads=1 + seed % 2)
        self.assertGreater(summary(whole)["joints_broken"], 50)

    def test_with_pace_control(self):
        """Requirement: the same where the loads have a time of their own."""
        deck = ROOT / "examples" / "04_tie_to_failure" / "case.toml"
        self.compare(deck, 1500, [611, 1200], ("--set", "run.pace=8", "--set", "mesh.box.0.cells=[4,3,3]"))

    def test_every_example(self):
        """Requirement: the same for every deck of the examples, stopped at two random steps of its short version."""
        for deck in sorted((ROOT / "examples").glob("*/*.toml")):
            name = f"{deck.parent.name}_{deck.stem}"
            with self.subTest(name):
                forecast = subprocess.run([self.program.path, "check", str(deck)], capture_output=True, text=True).stdout
                read = lambda pattern: re.search(pattern, forecast, re.MULTILINE)[1]
                tets, dt, all_steps = (float(read(p)) for p in (r"^tets +(\d+)", r"^time step +(\S+) s", r"^steps +(\d+)"))
                steps = int(min(all_steps, max(40, (LONG_WORK if LONG else WORK) / tets)))
                at = sorted(random.Random(name).sample(range(1, steps), 2))
                self.compare(deck, steps, at, ("--set", f'output.history_every="{5 * dt} s"', "--set",
                                                 f'output.frames_every="{steps * dt / 3} s"'), name=name)

    def test_in_a_new_folder(self):
        """Requirement: with --out the run goes on in a new folder that holds all of it, from an older checkpoint too, and
        leaves the old folder alone; that new folder can be gone on with in turn."""
        whole = self.smash("whole")
        old = self.smash("old", "--set", "output.checkpoint_steps=300", "--set", "run.max_steps=800")
        before = {p: p.read_bytes() for p in Path(old).rglob("*") if p.is_file()}
        self.assertEqual(len(checkpoints(old)), 2)
        self.program.must_run(SMASHED, "--restart", checkpoints(old)[0], "--out", self.path("new"), "--until", SHORT_UNTIL)
        self.assertEqual(differences(whole, self.path("new")), [])
        self.assertEqual(before, {p: p.read_bytes() for p in Path(old).rglob("*") if p.is_file()})
        self.program.must_run(SMASHED, "--restart", self.path("new"), "--out", self.path("newer"), "--until", SHORT_UNTIL)
        self.assertEqual(differences(whole, self.path("newer")), [])
        done = self.program.run(SMASHED, "--restart", old, "--out", self.path("new"))
        self.assertEqual(done.returncode, 3)
        self.assertIn("exists already", done.stderr)

    def test_from_an_older_checkpoint(self):
        """Requirement: going on from an older checkpoint in its own folder drops what came after it: newer checkpoints, rows,
        frames, lines of the log."""
        whole = self.smash("whole")
        run = self.smash("run", "--set", "output.checkpoint_steps=500")
        older = checkpoints(run)[0]
        self.program.must_run(SMASHED, "--restart", older, "--until", SHORT_UNTIL, "--set", "run.max_steps=1100")
        self.assertEqual(summary(run)["steps"], 1100)
        log = (Path(run) / "log.txt").read_text()
        self.assertIn("goes on from", log)
        self.assertNotIn("time of --until", log)
        self.program.must_run(SMASHED, "--restart", run, "--until", SHORT_UNTIL)
        self.assertEqual(differences(whole, run), [])

    def test_at_the_end(self):
        """Requirement: a run that is over can be gone on with to a later --until; and to the same one, which changes
        nothing."""
        run = self.smash("run")
        self.program.must_run(SMASHED, "--restart", run, "--until", SHORT_UNTIL)
        self.program.must_run(SMASHED, "--restart", run, "--until", 2 * SHORT_UNTIL)
        self.program.must_run(SMASHED, "--out", self.path("whole"), "--until", 2 * SHORT_UNTIL)
        self.assertEqual(differences(self.path("whole"), run), [])


class Refused(Folder):
    def setUp(self):
        super().setUp()
        self.run_folder = self.path("run")
        self.program.must_run(SMASHED, "--out", self.run_folder, "--set", "run.max_steps=30")

    def refusal(self, *options, deck=SMASHED):
        before = {p: p.read_bytes() for p in Path(self.run_folder).rglob("*") if p.is_file()}
        done = self.program.run(deck, "--restart", self.run_folder, *options)
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertEqual(before, {p: p.read_bytes() for p in Path(self.run_folder).rglob("*") if p.is_file()})
        return done.stderr

    def test_another_deck(self):
        """Requirement: a changed deck is refused with the first line that differs, and the folder is left as it was; keys
        that change no result may change."""
        self.assertRegex(self.refusal("--set", "concrete.0.f_t=\"3 MPa\""),
                         r"deck has changed since, .*: \[\[concrete\]\] 1, f_t = .3 MPa. \(was .2.9 MPa.\)")
        self.program.must_run(SMASHED, "--restart", self.run_folder, "--set", "run.max_steps=60", "--set", "run.threads=2",
                              "--set", "output.checkpoint_steps=20", "--set", "output.hash_every=7")

    def test_another_mesh_or_record(self):
        """Requirement: a mesh file or a record with other contents under the same name is refused; the same contents
        elsewhere are not."""
        for deck, file, change, word in (
                ("07_compression_prism/unstructured.toml", "*.geo", self.change_a_size, "mesh has changed"),
                ("10_column_ground_motion/case.toml", "*.txt", self.change_a_number, "record of a load has changed")):
            source = (ROOT / "examples" / deck).parent
            shutil.copytree(source, self.folder / source.name)
            copy = self.folder / source.name / Path(deck).name
            run = self.path(source.name + ".run")
            self.program.must_run(copy, "--out", run, "--set", "run.max_steps=3")
            self.program.must_run(ROOT / "examples" / deck, "--restart", run, "--set", "run.max_steps=5")
            files = list((self.folder / source.name).glob(file))
            self.assertTrue(files, f"{deck}: no {file}")
            for f in files:
                change(f)
            done = self.program.run(copy, "--restart", run, "--set", "run.max_steps=9")
            self.assertEqual(done.returncode, 2, done.stderr)
            self.assertIn(word, done.stderr)

    @staticmethod
    def change_a_size(path):
        path.write_text(path.read_text().replace("= 22;", "= 23;"))

    @staticmethod
    def change_a_number(path):
        lines = path.read_text().splitlines()
        middle = len(lines) // 2
        lines[middle] = re.sub(r"(\S+)\s*$", lambda f: f"{float(f[1]) + 1e-3:.6g}", lines[middle])
        path.write_text("\n".join(lines) + "\n")

    def test_damaged_files(self):
        """Requirement: a checkpoint that was cut off or altered is refused with the reason, and so is a history.csv that is
        shorter than it was or has other columns."""
        newest = checkpoints(self.run_folder)[-1]
        whole = newest.read_bytes()
        newest.write_bytes(whole[:-1000])
        self.assertIn("cut off", self.refusal())
        newest.write_bytes(whole[:5000] + bytes([whole[5000] ^ 1]) + whole[5001:])
        self.assertIn("checksum is wrong", self.refusal())
        newest.write_bytes(b"")
        self.assertIn("not a checkpoint", self.refusal())
        newest.write_bytes(whole[:16] + (1000).to_bytes(4, "little") + whole[20:])
        self.assertIn("has the format 1000", self.refusal())
        newest.write_bytes(whole)
        history = Path(self.run_folder) / "history.csv"
        rows = history.read_bytes()
        for content, reason in ((rows[:-200], "shorter"), (b"x" + rows[1:], "columns"), (rows[:-1] + b"0\n", "no line ends")):
            history.write_bytes(content)
            done = self.program.run(SMASHED, "--restart", self.run_folder)
            self.assertEqual(done.returncode, 2, done.stderr)
            self.assertIn(reason, done.stderr)
        history.write_bytes(rows)
        self.program.must_run(SMASHED, "--restart", self.run_folder, "--set", "run.max_steps=40")

    def test_what_is_not_there(self):
        """Requirement: a folder without checkpoints, and no folder at all, are refused in words."""
        shutil.rmtree(Path(self.run_folder) / "checkpoints")
        self.assertIn("no checkpoint in this run folder", self.refusal())
        done = self.program.run(SMASHED, "--restart", self.path("nowhere"))
        self.assertEqual(done.returncode, 2)
        self.assertIn("neither a checkpoint nor a run folder", done.stderr)

    def test_other_kernels_are_a_warning(self):
        """Requirement: another kernel set goes on with a warning in the log: the results agree to rounding only."""
        kernels = "v2" if "v2" not in summary(self.run_folder)["kernels"] else "v3"
        Program(PROGRAM, kernels).must_run(SMASHED, "--restart", self.run_folder, "--set", "run.max_steps=40")
        self.assertRegex((Path(self.run_folder) / "log.txt").read_text(), "warning: .*written with kernels .*agree to rounding")
        self.assertEqual(summary(self.run_folder)["steps"], 40)


class Asked(Folder):
    """Runs that are asked to stop."""

    def stopped(self, ask):
        """A run that is asked once it has begun; then gone on with to the end of the short version."""
        whole, run = self.smash("whole", "--force"), self.path("run")
        shutil.rmtree(run, ignore_errors=True)
        process = self.program.start(SMASHED, "--out", run, "--until", SHORT_UNTIL, "--set", "output.hash_every=10")
        began = lambda: (Path(run) / "log.txt").exists() and len(hashes_in_log(run)) > 2
        self.assertTrue(wait_for(began))
        ask(process, Path(run))
        _, text = process.communicate(timeout=900)
        self.assertEqual(process.returncode, 0, text)
        result = summary(run)
        self.assertEqual(result["status"], "stopped")
        self.assertEqual(len(checkpoints(run)), 1)
        self.program.must_run(SMASHED, "--restart", run, "--until", SHORT_UNTIL, "--set", "output.hash_every=10")
        self.assertEqual([d for d in differences(whole, run) if "log.txt" not in d], [])
        return result

    def test_by_signals(self):
        """Requirement: SIGINT and SIGTERM leave a checkpoint, the last frame and run.json; the exit code is 0."""
        for which, name in ((signal.SIGINT, "SIGINT"), (signal.SIGTERM, "SIGTERM")):
            result = self.stopped(lambda process, run: process.send_signal(which))
            self.assertIn(name, result["reason"])
            self.assertLess(result["time"], SHORT_UNTIL)

    def test_by_a_file(self):
        """Requirement: a file `stop` in the run folder does the same, and is gone afterwards."""
        result = self.stopped(lambda process, run: (run / "stop").touch())
        self.assertIn("a file `stop`", result["reason"])
        self.assertFalse((self.folder / "run" / "stop").exists())

    def test_by_wall_time(self):
        """Requirement: --walltime stops a run within a step of the time given."""
        whole, run = self.smash("whole"), self.path("run")
        for share in (0.3, 0.1, 0.03, 0.01):  # of the time that it took on a machine that may have been busier then
            self.program.must_run(SMASHED, "--out", run, "--force", "--until", SHORT_UNTIL, "--walltime", share * summary(whole)["wall_seconds"])
            if summary(run)["status"] == "stopped":
                break
        self.assertEqual(summary(run)["reason"], "wall time used up")
        self.program.must_run(SMASHED, "--restart", run, "--until", SHORT_UNTIL)
        self.assertEqual(differences(whole, run), [])

    def test_to_show_itself(self):
        """Requirement: a file `output_now` brings a frame and a checkpoint at once; the run goes on to the same end."""
        whole, run = self.smash("whole"), Path(self.path("run"))
        process = self.program.start(SMASHED, "--out", run, "--until", SHORT_UNTIL, "--set", "output.hash_every=10")
        # Beyond the first step, which has a frame of its own.
        self.assertTrue(wait_for(lambda: (run / "log.txt").exists() and len(hashes_in_log(run)) > 2))
        (run / "output_now").touch()
        self.assertTrue(wait_for(lambda: not (run / "output_now").exists()))
        process.communicate(timeout=900)
        self.assertEqual(process.returncode, 0)
        self.assertEqual(len(checkpoints(run)), 2)
        left = len(list((run / "frames").glob("fields_*"))) - len(list((Path(whole) / "frames").glob("fields_*")))
        self.assertEqual(left, 1)
        self.assertEqual(summary(run)["state_hash"], summary(whole)["state_hash"])
        self.assertEqual((run / "history.csv").read_bytes(), (Path(whole) / "history.csv").read_bytes())

    def interrupt_twice(self):
        """Two SIGINT: the second once the first has been taken, told by the handler being gone, and before the run has ended.

        Slices of time between SIGCONT and SIGSTOP are short against what a stopped run still writes."""
        process = self.program.start(SMASHED, "--out", self.path("run"), "--force", "--threads", 1, "--set", "output.hash_every=10")
        self.assertTrue(wait_for(lambda: (self.folder / "run" / "log.txt").exists()))
        process.send_signal(signal.SIGSTOP)
        process.send_signal(signal.SIGINT)
        while catches(process.pid, signal.SIGINT):
            process.send_signal(signal.SIGCONT)
            process.send_signal(signal.SIGSTOP)
        process.send_signal(signal.SIGINT)
        process.send_signal(signal.SIGCONT)
        process.communicate(timeout=900)
        return process.returncode

    def test_twice(self):
        """Requirement: a second SIGINT ends the program at once, by the signal."""
        for _ in range(20):
            code = self.interrupt_twice()
            if code != 0:  # it had not ended before the second came
                break
        self.assertEqual(code, -signal.SIGINT)

    def test_failed_runs_keep_their_checkpoint(self):
        """Requirement: a run that fails leaves the last good checkpoint untouched and names it."""
        run = self.path("run")
        done = self.program.run(SMASHED, "--out", run, "--set", 'run.dt="12 us"', "--set", "output.checkpoint_steps=2")
        self.assertEqual(done.returncode, 1, done.stderr)
        newest = checkpoints(run)[-1]
        self.assertEqual(summary(run)["failure"]["checkpoint"], str(newest))
        self.assertIn(f"the last good checkpoint is {newest}", (Path(run) / "log.txt").read_text())


if __name__ == "__main__":
    LONG = "--long" in sys.argv
    sys.argv = [a for a in sys.argv if a != "--long"]
    if len(sys.argv) > 1 and not sys.argv[1].startswith("-") and Path(sys.argv[1]).exists():
        PROGRAM = Path(sys.argv.pop(1)).resolve()
    unittest.main()
