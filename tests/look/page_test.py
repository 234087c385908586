#!/usr/bin/python3
"""The report page in a real browser: no errors in the console, nothing asked from a network, every plot drawn, the 3-D
view not empty, open within five seconds of work, and the same for a run in progress and for a comparison.

    page_test.py build/fissura [--shots FOLDER]

Exit code 77 (skipped) without Chromium or where the program was built without the page.
"""
import argparse
import json
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "tools"), str(Path(__file__).resolve().parent)]
from browser import Browser, BrowserFailed, find_browser
from small_run import put_markup

DECK = ROOT / "tests/look/beam/case.toml"
IMPACT, CYCLIC = ROOT / "tests/look/impact.toml", ROOT / "tests/look/cyclic.toml"
READY = "window.fissura?.ready || window.fissura?.errors.length"
PLOTS = ("plot-load", "plot-history", "plot-counts", "plot-energy", "plot-kinetic", "plot-bar-stress", "plot-bar-slip")
# Different colours among the pixels of a canvas; a canvas that nothing was drawn on has one.
COLOURS = """(() => {
  const canvas = document.querySelector(%r), copy = document.createElement('canvas');
  if (!canvas) return 0;
  copy.width = canvas.width, copy.height = canvas.height;
  const context = copy.getContext('2d');
  context.drawImage(canvas, 0, 0);
  const data = context.getImageData(0, 0, copy.width, copy.height).data, colours = new Set();
  for (let i = 0; i < data.length; i += 4) colours.add(data[i] << 24 | data[i + 1] << 16 | data[i + 2] << 8 | data[i + 3]);
  return colours.size;
})()"""


class Page(unittest.TestCase):
    program, shots = None, None

    @classmethod
    def setUpClass(cls):
        cls.scratch = tempfile.TemporaryDirectory()
        cls.folder = Path(cls.scratch.name)
        cls.finished = cls.folder / "run"
        done = subprocess.run([cls.program, "run", str(DECK), "--set", "mesh.box.0.cells=[16,2,3]", "--set", 'title="<b>demo</b> & more"', "--quiet", "--threads", "1",
                               "--until", "0.02", "--out", str(cls.finished)], capture_output=True, text=True, timeout=900)
        assert done.returncode == 0, done.stderr
        cls.browser = Browser()

    @classmethod
    def tearDownClass(cls):
        cls.browser.close()
        cls.scratch.cleanup()

    def shot(self, name):
        if self.shots:
            self.settle()
            self.browser.screenshot(Path(self.shots) / f"{name}.png", full=True)

    def settle(self):
        """Waits until the page has drawn all that it was asked for, however long a busy machine takes for it."""
        self.browser.evaluate("window.fissura.settled()")

    def fresh(self, path):
        seconds = self.browser.open(path, until=READY)
        self.settle()
        self.assertEqual(self.browser.errors, [])
        self.assertEqual(self.browser.evaluate("window.fissura.errors"), [])
        return seconds

    def test_report(self):
        """Every plot is drawn and the view shows body, cracks and bars; the console stays silent and nothing but the file
        itself is asked for."""
        self.fresh(self.finished / "report.html")
        for plot in PLOTS:
            self.assertGreater(self.browser.evaluate(COLOURS % f"#{plot} canvas"), 20, plot)
        self.assertGreater(self.browser.evaluate(COLOURS % ".stage canvas"), 50)
        self.assertGreater(self.browser.evaluate("window.fissura.view.cracksDrawn"), 0)
        self.assertGreater(self.browser.evaluate("document.querySelectorAll('#cracks tbody tr').length"), 0)
        self.assertEqual([u for u in self.browser.requests if not u.startswith(("file:", "data:", "blob:"))], [])
        self.assertEqual(len([u for u in self.browser.requests if u.startswith("file:")]), 1)
        self.shot("report")

    def test_text_stays_text(self):
        """Markup in a title is shown as it was written."""
        self.fresh(self.finished / "report.html")
        self.assertEqual(self.browser.evaluate("document.querySelector('h1').textContent"), "<b>demo</b> & more")
        self.assertEqual(self.browser.evaluate("document.title"), "<b>demo</b> & more")
        self.assertEqual(self.browser.evaluate("document.querySelectorAll('h1 b').length"), 0)

    def test_names_the_moments_of_inertia(self):
        """Where inertia takes part before the peak, the verdict says when and which marks of the curve are read where it is quiet."""
        self.fresh(self.finished / "report.html")
        verdict = self.browser.evaluate("document.querySelector('#verdicts').innerText").replace("\u202f", " ")
        self.assertRegex(verdict, r"5 % and more up to the peak:\s+[\d.]+ ms to [\d.]+ ms: up to \d+ %, while \d+ joints crack")
        self.assertRegex(verdict, "Read where it is quiet: .*peak")

    def test_claims_no_quiet_mark_where_nothing_is_quiet(self):
        """Where most readings up to the peak are loud, or forces are out of balance, no mark is called quiet."""
        loud = self.folder / "loud"
        subprocess.run(["cp", "-r", self.finished, loud], check=True)
        summary = json.loads((loud / "run.json").read_text())
        summary.update(quasi_static=False, quasi_static_share=0.137, force_imbalance=0.22)
        (loud / "run.json").write_text(json.dumps(summary))
        subprocess.run([self.program, "report", str(loud)], check=True, capture_output=True)
        self.fresh(loud / "report.html")
        verdict = self.browser.evaluate("document.querySelector('#verdicts').innerText").replace("\u202f", " ")
        self.assertIn("Inertia matters", verdict)
        self.assertIn("Forces are out of balance by 22 %: no mark of the curve can be taken for that of a slow test.", verdict)
        self.assertNotIn("Read where it is quiet", verdict)

    def test_titles_say_what_the_curve_is(self):
        """Only a load that goes to and fro on purpose has a hysteresis."""
        self.fresh(self.finished / "report.html")
        self.assertEqual(self.browser.evaluate("document.querySelector('#load h2').textContent"), "Load and displacement")
        for deck, title in ((IMPACT, "Force and displacement"), (CYCLIC, "Hysteresis")):
            out = self.folder / deck.stem
            done = subprocess.run([self.program, "run", str(deck), "--quiet", "--threads", "1", "--out", str(out)], capture_output=True, text=True, timeout=900)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.fresh(out / "report.html")
            self.assertEqual(self.browser.evaluate("document.querySelector('#load h2').textContent"), title)

    def test_deformation_is_that_of_the_peak(self):
        """The factor of deformation comes from the moment of the largest load: what moves after it does not change it, and the first picture
        is of a body in one place."""
        self.fresh(self.finished / "report.html")
        factor, length = self.browser.evaluate("[window.fissura.view.natural, window.fissura.view.length]")
        times = self.browser.evaluate("Array.from(window.fissura.view.times)")
        load = self.browser.evaluate("window.fissura.peak")
        frame = min(range(len(times)), key=lambda i: abs(times[i] - load))
        moved = self.browser.evaluate(f"(() => {{ const m = window.fissura.view.movements({frame}); return m[Math.floor(0.99 * (m.length - 1))]; }})()")
        self.assertLessEqual(factor * moved, 0.05 * length * 1.001)
        self.assertGreater(factor * moved, 0.05 * length / 2.6)  # the next step of 1, 2, 5 would be too large
        last = len(times) - 1
        for natural, shown in ((100, last - 1), (1, last)):  # as if the last frame had flown ten times the body's length away
            first = self.browser.evaluate(f"(() => {{ const v = Object.create(window.fissura.view); v.natural = {natural};"
                                          f"v.movements = (n) => (n === {last} ? [10 * v.length] : [1e-3 * v.length]); return v.lastInView(); }})()")
            self.assertEqual(first, shown)

    def test_opens_in_five_seconds(self):
        """The page is there and painted after at most five seconds of work of its thread; what a busy machine adds does not count."""
        self.browser.page("Performance.enable", timeDomain="threadTicks")

        def worked():
            return next(m["value"] for m in self.browser.page("Performance.getMetrics")["metrics"] if m["name"] == "ThreadTime")

        self.browser.open("about:blank")
        before = worked()
        self.fresh(self.finished / "report.html")
        self.assertLess(worked() - before, 5)
        self.assertGreater(worked(), before)

    def test_turns_and_plays(self):
        """Another moment, another factor and another eye each give another picture."""
        self.fresh(self.finished / "report.html")
        look = "window.fissura.view.picture()"
        seen = [self.browser.evaluate(look)]
        for change in ("view.show(1)", "view.show(view.times.length - 1), view.set({scale: 2 * view.natural})", "view.look('front')", "view.set({concrete: 'solid'})",
                       "view.set({cracks: 'mode', concrete: 'glass'})"):
            self.browser.evaluate(f"(() => {{ const view = window.fissura.view; {change}; }})()")
            seen.append(self.browser.evaluate(look))
        self.assertEqual(len(set(seen)), len(seen))

    def test_time_slider_moves_the_marks(self):
        """The slider moves the view, the clock and the curves along the bars together."""
        self.fresh(self.finished / "report.html")
        before = self.browser.evaluate("[document.querySelector('.clock').textContent, document.querySelector('#plot-bar-stress canvas').toDataURL()]")
        self.browser.evaluate("(() => { const s = document.querySelector('.time input'); s.value = 3; s.dispatchEvent(new Event('input')); })()")
        self.settle()
        after = self.browser.evaluate("[document.querySelector('.clock').textContent, document.querySelector('#plot-bar-stress canvas').toDataURL()]")
        self.assertNotEqual(before[0], after[0])
        self.assertNotEqual(before[1], after[1])

    def test_run_in_progress(self):
        """A run without run.json is shown as running, with all that has been saved."""
        partial = self.folder / "partial"
        subprocess.run(["cp", "-r", self.finished, partial], check=True)
        (partial / "run.json").unlink()
        subprocess.run([self.program, "report", str(partial)], check=True, capture_output=True)
        self.fresh(partial / "report.html")
        self.assertEqual(self.browser.evaluate("document.querySelector('.status').textContent"), "running")
        self.assertGreater(self.browser.evaluate(COLOURS % ".stage canvas"), 50)
        self.shot("running")

    def test_run_without_frames(self):
        """A run that has only begun has a page that says what is still missing."""
        early = self.folder / "early"
        early.mkdir()
        lines = (self.finished / "history.csv").read_text().splitlines(keepends=True)
        (early / "history.csv").write_text(lines[0])
        subprocess.run([self.program, "report", str(early)], check=True, capture_output=True)
        self.fresh(early / "report.html")
        self.assertIn("No frame has been saved yet", self.browser.evaluate("document.body.textContent"))

    def test_comparison(self):
        """Two runs over each other: both plots and the table of differences."""
        out = self.folder / "both.html"
        subprocess.run([self.program, "compare", str(self.finished), str(self.finished), "-o", str(out)], check=True, capture_output=True)
        self.fresh(out)
        for plot in ("plot-pair", "plot-time"):
            self.assertGreater(self.browser.evaluate(COLOURS % f"#{plot} canvas"), 20)
        self.assertGreater(self.browser.evaluate("document.querySelectorAll('tbody tr').length"), 3)
        self.shot("comparison")

    def test_markup_in_names_does_nothing(self):
        """Markup in title, reason, names, units, log and deck is shown as text: no element comes of it, and no script in it runs."""
        hostile = self.folder / "hostile"
        subprocess.run(["cp", "-r", self.finished, hostile], check=True)
        put_markup(hostile, "bottom")
        for words in (["report", hostile, "-o", self.folder / "hostile.html"], ["compare", hostile, hostile, "-o", self.folder / "hostile.html"]):
            subprocess.run([self.program, *map(str, words)], check=words[0] == "report", capture_output=True)
            self.fresh(self.folder / "hostile.html")
            self.assertNotEqual(self.browser.evaluate("document.title"), "owned")
            self.assertEqual(self.browser.evaluate("document.querySelectorAll('h6, img, #page script').length"), 0)
            self.assertIn("<h6>owned</h6>", self.browser.evaluate("document.body.textContent"))

    def test_prints(self):
        """The page prints: a PDF of some pages."""
        self.fresh(self.finished / "report.html")
        out = self.folder / "page.pdf"
        self.browser.pdf(out)
        self.assertTrue(out.read_bytes().startswith(b"%PDF"))
        self.assertGreater(out.stat().st_size, 50000)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program")
    parser.add_argument("--shots", help="folder for screenshots")
    arguments, rest = parser.parse_known_args()
    Page.program, Page.shots = str(Path(arguments.program).resolve()), arguments.shots
    if not find_browser():
        print("skipped: no Chromium here (apt: chromium)")
        sys.exit(77)
    with tempfile.TemporaryDirectory() as scratch:
        said = subprocess.run([Page.program, "report", scratch], capture_output=True, text=True).stderr
    if "built without the report page" in said:
        print("skipped: the program was built without the report page (apt: nodejs npm)")
        sys.exit(77)
    unittest.main(argv=[sys.argv[0], *rest])


if __name__ == "__main__":
    main()
