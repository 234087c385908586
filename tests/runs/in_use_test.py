#!/usr/bin/python3
"""Runs that meet others, signals and vanishing files: each test states its requirement. in_use_test.py PROGRAM"""
import os
import re
import shutil
import signal
import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent.parent / "tools"))
from run_pairs import ROOT, Program, checkpoints, differences, hashes_in_log, summary, wait_for

PROGRAM = ROOT / "build" / "fissura"
DECK = ROOT / "tests" / "runs" / "tie.toml"
LONG = ("--set", "stage.1.duration=100 s", "--set", "output.history_every=0.1 ms", "--set", "output.frames=0", "--set",
        "output.frames_every=0 s", "--set", "output.hash_every=100", "--set", "concrete.0.crackable=false")


class Folder(unittest.TestCase):
    def setUp(self):
        self.temporary = tempfile.TemporaryDirectory()
        self.folder = Path(self.temporary.name)
        self.program = Program(PROGRAM)
        self.run_folder = self.folder / "run"
        self.process = None

    def tearDown(self):
        if self.process and self.process.poll() is None:
            self.process.kill()
            self.process.communicate()
        self.temporary.cleanup()

    def begin(self, *options, begin=("--out",)):
        """A run that would take hours, at work."""
        self.process = self.program.start(DECK, *begin, self.run_folder, *LONG, *options)
        self.assertTrue(wait_for(lambda: self.is_at_work() or self.process.poll() is not None))
        self.assertIsNone(self.process.poll(), "it should be at work")

    def is_at_work(self):
        return (self.run_folder / "log.txt").exists() and len(hashes_in_log(self.run_folder)) > 1

    def end(self, which=signal.SIGTERM):
        """Ends it in good order; its exit code and what it said."""
        self.process.send_signal(which)
        _, text = self.process.communicate(timeout=120)
        return self.process.returncode, text


class InUse(Folder):
    def test_others_are_refused_and_change_nothing(self):
        """Requirement: a second run, --force and --restart into the folder of a run at work are refused with the holder's
        name, and the run at work ends in the files of one that was alone."""
        self.begin("--set", "output.checkpoint_steps=200")
        self.assertTrue(wait_for(lambda: checkpoints(self.run_folder)))
        for options in (("--out", self.run_folder), ("--out", self.run_folder, "--force"), ("--restart", self.run_folder),
                        ("--restart", self.run_folder, "--force")):
            done = self.program.run(DECK, *options)
            self.assertEqual(done.returncode, 3, done.stderr)
            self.assertRegex(done.stderr, f"is in use by process {self.process.pid} on " if "--out" not in options[:1] or
                             "--force" in options else "exists already")
        code, text = self.end()
        self.assertEqual(code, 0, text)
        self.assertFalse((self.run_folder / ".lock").exists())
        alone = self.folder / "alone"
        self.program.must_run(DECK, "--out", alone, *LONG, "--set", f"run.max_steps={summary(self.run_folder)['steps']}")
        self.assertEqual([d for d in differences(alone, self.run_folder) if d != "run.json: reason"], [])

    def test_what_a_killed_run_leaves_keeps_nobody_out(self):
        """Requirement: after kill -9 the lock file is there and the folder is free, for --restart and for --force."""
        self.begin("--set", "output.checkpoint_steps=200")
        self.assertTrue(wait_for(lambda: checkpoints(self.run_folder)))
        self.end(signal.SIGKILL)
        self.assertTrue((self.run_folder / ".lock").exists())
        self.program.must_run(DECK, "--restart", self.run_folder, *LONG, "--walltime", 0)
        self.assertFalse((self.run_folder / ".lock").exists())
        self.begin("--force")
        self.end(signal.SIGKILL)
        self.program.must_run(DECK, "--out", self.run_folder, "--force", "--set", "run.max_steps=5")
        self.assertEqual(summary(self.run_folder)["steps"], 5)
        self.assertEqual(list(self.run_folder.glob(".*")), [])

    def test_two_that_begin_at_once(self):
        """Requirement: of two runs that begin in one new folder one goes on and one is refused."""
        both = [self.program.start(DECK, "--out", self.run_folder, "--set", "run.max_steps=150",
                                   "--set", "run.joint_inertia=false") for _ in range(2)]
        codes = []
        for process in both:
            _, text = process.communicate(timeout=120)
            codes.append(process.returncode)
            self.assertTrue(process.returncode == 0 or "in use by" in text or "exists already" in text, text)
        self.assertEqual(sorted(codes), [0, 3])
        self.assertEqual(summary(self.run_folder)["steps"], 150)


class Forced(Folder):
    def refused(self, folder, words, deck=DECK):
        before = sorted(Path(folder).rglob("*")) if Path(folder) != Path("/") else []
        done = self.program.run(deck, "--out", folder, "--force")
        self.assertEqual(done.returncode, 3, done.stderr)
        self.assertRegex(done.stderr, f"--force does not clear .*{words}")
        if before:
            self.assertEqual(sorted(Path(folder).rglob("*")), before)

    def test_only_run_folders_are_cleared(self):
        """Requirement: --force refuses a folder that holds no run, the root, the home and the deck's own folder, and says
        why; an empty folder and one of a run are taken."""
        mine = self.folder / "mine"
        mine.mkdir()
        shutil.copy(DECK, mine / "case.toml")
        (mine / "frames").mkdir()
        self.refused(mine, "it is no run folder")
        self.refused(mine, "the deck itself lies in it", mine / "case.toml")
        self.refused("/", "it is the root")
        self.refused(mine / "case.toml", "it is no folder")
        self.program.environment["HOME"] = str(self.folder)
        self.refused(self.folder, "it is your home")
        (self.folder / "empty").mkdir()
        for _ in range(2):
            self.program.must_run(DECK, "--out", self.folder / "empty", "--force", "--set", "run.max_steps=1")


class Signals(Folder):
    def test_of_queues_and_terminals(self):
        """Requirement: SIGHUP and SIGUSR1 do what SIGTERM does, also when they come twice: a checkpoint, run.json, exit
        code 0, and the run goes on."""
        for which in (signal.SIGHUP, signal.SIGUSR1):
            shutil.rmtree(self.run_folder, ignore_errors=True)
            self.begin()
            self.process.send_signal(which)
            code, text = self.end(which)
            self.assertEqual(code, 0, text)
            self.assertEqual(summary(self.run_folder)["reason"], f"stopped by {which.name}")
            self.assertEqual(len(checkpoints(self.run_folder)), 1)
            self.program.must_run(DECK, "--restart", self.run_folder, *LONG, "--walltime", 0)

    def test_that_are_ignored_stay_so(self):
        """Requirement: under nohup a SIGHUP ends nothing."""
        before = signal.signal(signal.SIGHUP, signal.SIG_IGN)
        try:
            self.begin()
        finally:
            signal.signal(signal.SIGHUP, before)
        self.process.send_signal(signal.SIGHUP)
        seen = len(hashes_in_log(self.run_folder))
        self.assertTrue(wait_for(lambda: len(hashes_in_log(self.run_folder)) > seen + 2 or self.process.poll() is not None))
        self.assertIsNone(self.process.poll())
        code, text = self.end()
        self.assertEqual((code, summary(self.run_folder)["reason"]), (0, "stopped by SIGTERM"), text)

    def test_when_the_terminal_is_gone(self):
        """Requirement: a run whose terminal closes writes its checkpoint and run.json."""
        pid, terminal = os.forkpty()
        if pid == 0:
            os.execv(self.program.path, [w for w in self.program.command(DECK, "--out", self.run_folder, *LONG) if w != "--quiet"])
        try:
            self.assertTrue(wait_for(self.is_at_work))
        finally:
            os.close(terminal)
            os.waitpid(pid, 0)
        self.assertEqual(summary(self.run_folder)["reason"], "stopped by SIGHUP")
        self.assertEqual(len(checkpoints(self.run_folder)), 1)

    def test_before_the_first_step(self):
        """Requirement: a signal that comes while the model is built ends the program with code 0 and leaves nothing behind."""
        # A hundred thousand tets: a second to build. It is asked to stop once its handlers are there.
        process = self.program.start(DECK, "--out", self.run_folder, "--set", "mesh.box.0.cells=[30,25,25]")
        self.assertTrue(wait_for(lambda: self.catches(process.pid, signal.SIGUSR1)))
        process.send_signal(signal.SIGUSR1)
        _, text = process.communicate(timeout=300)
        self.assertEqual(process.returncode, 0, text)
        self.assertFalse(self.run_folder.exists())

    @staticmethod
    def catches(pid, number):
        try:
            status = Path(f"/proc/{pid}/status").read_text()
        except FileNotFoundError:
            return False
        return bool(int(re.search(r"SigCgt:\s*(\w+)", status)[1], 16) >> (number - 1) & 1)


class Vanishing(Folder):
    def remove(self, folder):
        """Out of the run's sight at once: a tree taken down file by file may get a new file from the run under way."""
        aside = Path(tempfile.mkdtemp(dir=self.folder)) / "removed"
        folder.rename(aside)
        shutil.rmtree(aside, ignore_errors=True)

    def loses(self, what, file, *options):
        self.begin(*options)
        what()
        _, text = self.process.communicate(timeout=120)
        self.assertEqual(self.process.returncode, 3, text)
        self.assertIn(file, text)
        return text

    def test_files_that_are_removed_or_replaced(self):
        """Requirement: a run whose history, log or whole folder is removed, renamed or replaced ends with code 3 and names
        the file; what it would go on writing is nowhere to be found."""
        run = self.run_folder
        self.loses((run / "history.csv").unlink, "history.csv")
        shutil.rmtree(run)
        self.loses(lambda: (run / "history.csv").rename(run / "mine.csv"), "history.csv")
        shutil.rmtree(run)
        self.loses((run / "log.txt").unlink, "log.txt")
        shutil.rmtree(run)
        self.loses(lambda: run.rename(self.folder / "elsewhere"), "cannot")

        def replace():
            other = run / "other"
            shutil.copy(run / "history.csv", other)
            other.rename(run / "history.csv")
        self.assertIn("another file has taken its place", self.loses(replace, "history.csv"))
        shutil.rmtree(run)
        self.loses(lambda: self.remove(run / "checkpoints"), "checkpoints", "--set", "output.checkpoint_steps=200")
        shutil.rmtree(run)
        self.loses(lambda: self.remove(run / "frames"), "frames", "--set", "output.frames_every=1 ms", "--set", "stage.1.duration=10 s")
        shutil.rmtree(run)
        self.loses(lambda: self.remove(run), "cannot")


class AtOnce(Folder):
    def test_limits_of_zero(self):
        """Requirement: --until 0 and --walltime 0 end the run before its first step, with a checkpoint to go on from; units
        are understood."""
        for options, reason in ((("--until", 0), "time of --until reached"), (("--walltime", 0), "wall time used up"),
                                (("--until", "0 ms"), "time of --until reached")):
            self.program.must_run(DECK, "--out", self.run_folder, "--force", *options)
            self.assertEqual((summary(self.run_folder)["steps"], summary(self.run_folder)["reason"]), (0, reason))
            self.assertEqual(len(checkpoints(self.run_folder)), 1)
            self.program.must_run(DECK, "--restart", self.run_folder)
            self.assertEqual(summary(self.run_folder)["reason"], "end time reached")
        self.program.must_run(DECK, "--out", self.folder / "hours", "--walltime", "1 h", "--set", "run.max_steps=3")
        self.assertEqual(summary(self.folder / "hours")["reason"], "max_steps reached")

    def test_numbers_without_meaning(self):
        """Requirement: a number that is negative, not finite or out of range is refused with the name of its option."""
        for words in ("run D --until=-1", "run D --until=nan", "run D --until=inf", "run D --until=soon", "run D --until=",
                      "run D --until=-1ms", "run D --walltime=-1", "run D --walltime=nan", "run D --walltime=inf", "run D --walltime=",
                      "run D --threads=-1", "run D --threads=1025", "run D --threads=1.5", "run D --threads=nan",
                      "run D --threads=99999999999", "bench --tets=0", "bench --tets=-5", "bench --steps=-1", "bench --threads=-1",
                      "bench --threads=5000", "watch R --every=0", "watch R --every=nan", "watch R --every=inf", "watch R --every=-1",
                      "watch R --every=1e300", "compare R R --tolerance=nan", "compare R R --tolerance=-1", "compare R R --tolerance=inf",
                      "picture R --min-damage=nan", "picture R --min-damage=-1", "picture R --time=-1", "picture R --time=nan",
                      "picture R --warp=nan", "picture R --from=nan", "picture R --from=-1"):
            with self.subTest(words):
                option = re.search(r"--\S+(?==)", words)[0]
                places = {"D": str(DECK), "R": str(self.folder)}
                done = self.call(*(places.get(w, w) for w in words.split()))
                self.assertEqual(done.returncode, 2, done.stderr + done.stdout)
                self.assertIn(option, done.stderr + done.stdout)

    def call(self, *words):
        import subprocess
        return subprocess.run([self.program.path, *words], capture_output=True, text=True, timeout=60, cwd=self.folder)


if __name__ == "__main__":
    if len(sys.argv) > 1 and not sys.argv[1].startswith("-"):
        PROGRAM = Path(sys.argv.pop(1)).resolve()
    unittest.main()
