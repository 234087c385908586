#!/usr/bin/python3
"""The commands that look at a run: report, picture, plot, compare, watch. Each test states its requirement.

    commands_test.py build/fissura
"""
import json
import os
import resource
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
PROGRAM = str(Path(sys.argv.pop(1)).resolve()) if len(sys.argv) > 1 else str(ROOT / "build/fissura")
DECK = ROOT / "tests/look/beam/case.toml"
# A beam of few elements, until its first cracks: seconds become tenths of one.
SMALL = ["--set", "mesh.box.0.cells=[16,2,3]", "--threads", "1", "--quiet"]
PNG = b"\x89PNG\r\n\x1a\n"


def fissura(*words, **environment):
    return subprocess.run([PROGRAM, *map(str, words)], capture_output=True, text=True, env={**os.environ, **{k: str(v) for k, v in environment.items()}},
                          timeout=900)


def has_page():
    """Whether this program was built with the report page."""
    return Commands.page


class Commands(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.scratch = tempfile.TemporaryDirectory()
        cls.folder = Path(cls.scratch.name)
        cls.run_a, cls.run_b = cls.folder / "a", cls.folder / "b"
        for out, until, more in ((cls.run_a, "6e-3", []), (cls.run_b, "6e-3", ["--no-report", "--set", 'concrete.0.f_t="0.5 MPa"'])):
            done = fissura("run", DECK, *SMALL, "--until", until, "--out", out, *more)
            assert done.returncode == 0, done.stdout + done.stderr
        done = fissura("report", cls.run_b, "-o", cls.folder / "try.html")
        cls.page = done.returncode == 0

    @classmethod
    def tearDownClass(cls):
        cls.scratch.cleanup()

    def test_a_run_leaves_its_report(self):
        """A run writes report.html unless --no-report is given; a program without the page says so and goes on."""
        self.assertEqual((self.run_a / "report.html").exists(), has_page())
        self.assertFalse((self.run_b / "report.html").exists())
        if not has_page():
            self.assertIn("none is built into this program", (self.run_a / "log.txt").read_text())

    def test_report_without_page_says_what_is_missing(self):
        """Without the page, `fissura report` names what to install and exits with 3."""
        if has_page():
            self.skipTest("this program has the page")
        done = fissura("report", self.run_a)
        self.assertEqual(done.returncode, 3)
        self.assertIn("Install nodejs and npm", done.stderr)

    def test_report_is_one_file_that_asks_for_nothing(self):
        """The page names no other file and no server, and forbids itself to ask for any."""
        if not has_page():
            self.skipTest("built without the page")
        done = fissura("report", self.run_a, "-o", self.folder / "one.html")
        self.assertEqual(done.returncode, 0, done.stderr)
        text = (self.folder / "one.html").read_text()
        head = text[:text.index("<style>")]
        self.assertIn("default-src 'none'", head)
        for mark in ("<link", "<script src", "@import", "<img", "<iframe"):
            self.assertNotIn(mark, text[:text.index("<script")])
        self.assertLess(len(text), 3e6)

    def test_title_is_escaped(self):
        """A title with markup stays text, in the head of the page too."""
        if not has_page():
            self.skipTest("built without the page")
        out = self.folder / "odd"
        done = fissura("run", DECK, *SMALL, "--until", "2e-4", "--out", out, "--set", 'title="</title><script>alert(1)</script>"')
        self.assertEqual(done.returncode, 0, done.stderr)
        text = (out / "report.html").read_text()
        self.assertNotIn("<script>alert(1)", text)
        self.assertIn("&lt;script&gt;alert(1)", text)

    def test_report_of_a_run_that_goes_on(self):
        """A folder without run.json, as while a run goes on, gets its page."""
        if not has_page():
            self.skipTest("built without the page")
        partial = self.folder / "partial"
        subprocess.run(["cp", "-r", self.run_a, partial], check=True)
        (partial / "run.json").unlink()
        (partial / "report.html").unlink()
        self.assertEqual(fissura("report", partial).returncode, 0)
        self.assertTrue((partial / "report.html").exists())

    def test_no_run_folder(self):
        """Every command names a folder that is none, and exits with 3."""
        for words in (["report"], ["picture"], ["plot", "--y", "load"], ["watch"], ["compare", self.run_a]):
            done = fissura(*words, self.folder / "nowhere")
            if words == ["report"] and not has_page():
                continue # says that the page is missing, first
            self.assertEqual(done.returncode, 3, words)
            self.assertIn("nowhere: no such run folder", done.stderr)
        done = fissura("plot", self.folder, "--y", "load")
        self.assertIn("no run folder (it holds neither history.csv nor run.json)", done.stderr)

    def test_picture(self):
        """`fissura picture` writes a PNG, of any of its fields; unknown fields and times are refused."""
        for field in ("opening", "sliding", "damage"):
            out = self.folder / f"{field}.png"
            done = fissura("picture", self.run_b, "--field", field, "--time", "last", "-o", out)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertEqual(out.read_bytes()[:8], PNG)
        done = fissura("picture", self.run_b, "--field", "velocity")
        self.assertGreaterEqual(done.returncode, 2)
        self.assertIn("opening", done.stderr)
        done = fissura("picture", self.run_b, "--time", "late")
        self.assertEqual(done.returncode, 2)
        self.assertIn("--time: `late` is not a time", done.stderr)

    def test_plot(self):
        """`fissura plot` writes a PNG of columns; a column that is missing is named with those there are."""
        out = self.folder / "curve.png"
        done = fissura("plot", self.run_a, "--x", "deflection", "--y", "load", "--peak", "-o", out)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(out.read_bytes()[:8], PNG)
        self.assertIn("peak load", done.stdout)
        done = fissura("plot", self.run_a, "--y", "laod")
        self.assertEqual(done.returncode, 2)
        self.assertIn("no column 'laod'; there are: time, load", done.stderr)
        done = fissura("plot", self.run_a, "--y", "load", "-o", self.folder / "nowhere" / "curve.png")
        self.assertEqual(done.returncode, 3)
        self.assertIn("nowhere", done.stderr)

    def test_drawing_tools_missing(self):
        """Without the drawing tools where FISSURA_TOOLS says, the error says where they are looked for; where it is empty
        they are found."""
        words = ["plot", self.run_a, "--y", "load", "-o", self.folder / "again.png"]
        done = fissura(*words, FISSURA_TOOLS=str(self.folder))
        self.assertEqual(done.returncode, 3)
        self.assertIn("the drawing tool plot_history.py is not beside this program; install it with `make install`, or name its "
                      "folder in FISSURA_TOOLS", done.stderr)
        self.assertEqual(fissura(*words, FISSURA_TOOLS="").returncode, 0)

    def test_python_missing(self):
        """Without Python, or with one that lacks numpy or matplotlib, the error names the packages to install."""
        words = ["plot", self.run_a, "--y", "load", "-o", self.folder / "never.png"]
        done = fissura(*words, FISSURA_PYTHON=self.folder / "python3")
        self.assertEqual(done.returncode, 3)
        self.assertIn("python3 is missing: apt install python3-numpy python3-matplotlib", done.stderr)
        for lacks in ("numpy", "matplotlib"):
            bare = self.folder / f"no_{lacks}"
            bare.mkdir()
            (bare / "sitecustomize.py").write_text(
                "import importlib.util as u\nfind = u.find_spec\n"
                f"u.find_spec = lambda name, *more: None if name == '{lacks}' else find(name, *more)\n")
            done = fissura(*words, PYTHONPATH=bare)
            self.assertEqual(done.returncode, 3)
            self.assertIn(f"pictures are drawn with Python's {lacks}, which is missing: apt install python3-{lacks}", done.stderr)
        self.assertFalse((self.folder / "never.png").exists())

    def test_new_case_and_bench(self):
        """`fissura new` writes a case that `check` takes, `check --picture` draws it, `bench` times a step."""
        case = self.folder / "tie" / "case.toml"
        done = fissura("new", "tie", case.parent)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn(f"wrote {case}; next: fissura check {case}", done.stdout)
        again = fissura("new", "tie", case.parent)
        self.assertEqual((again.returncode, again.stderr), (2, f"fissura: {case} exists already; choose another folder\n"))
        self.assertIn("there is no template `bridge`", fissura("new", "bridge", self.folder / "bridge").stderr)
        picture = self.folder / "tie.png"
        self.assertEqual(fissura("check", case, "--picture", picture).returncode, 0)
        self.assertEqual(picture.read_bytes()[:8], PNG)
        self.assertIn("ns per tet-step", fissura("bench", "--tets", "500", "--steps", "20").stdout)
        self.assertEqual(fissura("bench", "--scene", "moon").returncode, 2)

    def test_run_that_fails(self):
        """A run that goes wrong ends with 1 and its reason."""
        done = fissura("run", DECK, *SMALL, "--no-report", "--out", self.folder / "wrong", "--set", 'run.dt="0.1 ms"')
        self.assertEqual(done.returncode, 1, done.stdout + done.stderr)
        self.assertIn("fissura: the run failed: ", done.stderr)

    def test_out_of_memory(self):
        """A case that needs more memory than there is ends with 1 and the way to learn what it needs."""
        little = lambda: resource.setrlimit(resource.RLIMIT_AS, (500 << 20, 500 << 20))
        done = subprocess.run([PROGRAM, "check", str(DECK), "--set", "mesh.box.0.cells=[400,100,100]"], capture_output=True, text=True,
                              preexec_fn=little, timeout=900)
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertIn("fissura: out of memory; `fissura check` tells what a case needs", done.stderr)

    def test_unit_database_missing(self):
        """Without the database of units nothing can be read, and the error names it (exit 3)."""
        done = fissura("check", DECK, UDUNITS2_XML_PATH=self.folder / "udunits2.xml")
        self.assertEqual(done.returncode, 3)
        self.assertIn("cannot read the unit database of UDUNITS-2 (udunits2.xml)", done.stderr)

    def test_words_of_the_command_line(self):
        """A mistyped command, a folder for its deck and a time without sense are told with what would be right (exit 2); times may
        carry a unit."""
        for words, said in ((["rn", DECK], "there is no command `rn`; did you mean `run`?"), (["frobnicate"], "there are `run`, `check`"),
                            (["check", DECK.parent], f'is a folder; its deck is "{DECK}"'),
                            (["run", DECK, "--until", "3 mm"], "--until: "), (["picture", self.run_b, "--time", "3 xs"], "--time: unknown unit `xs`")):
            done = fissura(*words)
            self.assertEqual(done.returncode, 2, words)
            self.assertIn(said, done.stderr)
        out = self.folder / "until"
        done = fissura("run", DECK, *SMALL, "--no-report", "--until", "0.1 ms", "--set", "run.joint_inertia=false", "--out", out)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertAlmostEqual(json.loads((out / "run.json").read_text())["time"], 1e-4, delta=2e-6)
        self.assertEqual(fissura("picture", self.run_b, "--time", "3 ms", "-o", self.folder / "then.png").returncode, 0)

    def test_compare(self):
        """A run compared with itself agrees to the last bit (exit 0); another one differs (exit 1)."""
        same = fissura("compare", self.run_a, self.run_a, "--tolerance", "0")
        self.assertEqual(same.returncode, 0, same.stderr)
        self.assertIn("same state, to the last bit", same.stdout)
        other = fissura("compare", self.run_a, self.run_b)
        self.assertEqual(other.returncode, 1, other.stdout)
        self.assertIn("load [N]", other.stdout)
        self.assertTrue(other.stdout.rstrip().endswith("differ"))
        self.assertEqual(fissura("compare", self.run_a, self.run_b, "--tolerance", "100").returncode, 0)

    def test_compare_page(self):
        """-o writes a page with both curves, besides the table."""
        if not has_page():
            self.skipTest("built without the page")
        out = self.folder / "both.html"
        done = fissura("compare", self.run_a, self.run_b, "-o", out)
        self.assertEqual(done.returncode, 1)
        self.assertTrue(out.exists())

    def test_compare_refuses(self):
        """A column that is missing is an error of the input (exit 2)."""
        done = fissura("compare", self.run_a, self.run_b, "--y", "laod")
        self.assertEqual(done.returncode, 2)
        self.assertIn("no column `laod`", done.stderr)

    def test_watch(self):
        """A run that has ended is shown once, with its curve, and the exit code is that of the run."""
        done = fissura("watch", self.run_a)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("stopped: time of --until reached", done.stdout)
        self.assertIn("load [", done.stdout)
        failed = self.folder / "failed"
        subprocess.run(["cp", "-r", self.run_a, failed], check=True)
        summary = json.loads((failed / "run.json").read_text())
        (failed / "run.json").write_text(json.dumps({**summary, "status": "failed", "reason": "a test"}))
        self.assertEqual(fissura("watch", failed).returncode, 1)

    def test_watch_follows(self):
        """A run in progress is followed until it ends."""
        out = self.folder / "going"
        run = subprocess.Popen([PROGRAM, "run", str(DECK), *SMALL, "--until", "6e-3", "--out", str(out), "--no-report"])
        while not (out / "history.csv").exists() and run.poll() is None:
            pass
        done = fissura("watch", out, "--every", "0.1")
        self.assertEqual(run.wait(60), 0)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("stopped", done.stdout)

    def test_plain_log(self):
        """What is no terminal gets plain lines: no escape sequences, no carriage returns."""
        done = fissura("run", DECK, *[w for w in SMALL if w != "--quiet"], "--until", "1e-4", "--out", self.folder / "plain")
        self.assertEqual(done.returncode, 0)
        self.assertNotIn("\x1b", done.stdout)
        self.assertNotIn("\r", done.stdout)

    def test_no_color(self):
        """On a terminal with NO_COLOR no colours are used; without it warnings are yellow."""
        if subprocess.run(["script", "-qec", "true", "/dev/null"], capture_output=True, stdin=subprocess.DEVNULL).returncode:
            self.skipTest("no terminal to be had: /dev/pts is not mounted")
        words = " ".join([PROGRAM, "run", str(DECK), *[w for w in SMALL if w != "--quiet"], "--until", "1e-4", "--force", "--out", str(self.folder / "colour")])
        for environment, coloured in (({}, True), ({"NO_COLOR": "1"}, False), ({"TERM": "dumb"}, False)):
            done = subprocess.run(["script", "-qec", words, "/dev/null"], capture_output=True, text=True, timeout=900,
                                  env={**{k: v for k, v in os.environ.items() if k != "NO_COLOR"}, "TERM": "xterm", **environment}, stdin=subprocess.DEVNULL)
            self.assertEqual("\x1b[33m" in done.stdout, coloured, environment)


if __name__ == "__main__":
    unittest.main()
