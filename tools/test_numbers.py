#!/usr/bin/python3
"""Tests of check_numbers.py: each states its requirement. Run: python3 tools/test_numbers.py"""
import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
import check_numbers as tool
from verify_runs import ROOT, Runs


class Text(unittest.TestCase):
    def test_a_number_is_true_if_it_is_the_value_rounded(self):
        """A printed number stands for all values that round to it; thousands with zeros behind are rounded to them."""
        for text, good, bad in (("57.5", (57.46, 57.54), (57.44, 57.56)), ("183,000", (182_600, 183_400), (182_400, 183_600)),
                                ("1.02e-3", (1.0151e-3,), (1.014e-3, 1.03e-3)), ("-0.7", (-0.74,), (-0.76, 0.7)), ("30", (29.6, 30.4), (29.4, 30.6))):
            self.assertTrue(all(tool.is_true(v, text, 0) for v in good), text)
            self.assertFalse(any(tool.is_true(v, text, 0) for v in bad), text)

    def test_scatter_widens_what_cracks(self):
        """A number that cracking changes in its last digits may differ by the scatter of its run, and no further."""
        self.assertTrue(tool.is_true(58, "57.5", 0.02))
        self.assertFalse(tool.is_true(59, "57.5", 0.02))

    def test_bounds(self):
        """"At most" and "at least" are true as long as the run keeps them."""
        source = tool.Source(Runs("no program", ROOT / "build" / "none"))
        for what, good, bad in (("energy residual [%] (at most)", 0.019, 0.021), ("quiet readings [%] (at least)", 0.021, 0.019)):
            self.assertEqual(source.needs("demo", what), ("demo",))
            self.assertTrue(source.is_true(good, "demo", what, "0.02"))
            self.assertFalse(source.is_true(bad, "demo", what, "0.02"))

    def test_a_value_is_written_as_the_text_was(self):
        """As many digits as before, thousands parted, powers without a leading zero."""
        for value, text, written in ((57.4712, "60.0", "57.5"), (182_731, "285,000", "183,000"), (1.0234e-3, "1.1e-3", "1.0e-3"), (7.0, "12", "7"),
                                     (4608, "1440", "4608"), (0.0123, "0.011", "0.012")):
            self.assertEqual(tool.rounded(value, text), written)

    def test_finds_what_nobody_accounts_for(self):
        """A number in the prose that is neither marked, nor of the deck, nor given is found with its line; code and links are no prose."""
        with tempfile.TemporaryDirectory() as folder:
            page = Path(folder) / "README.md"
            (Path(folder) / "case.toml").write_text('diameter = "8 mm"\n')
            page.write_text("Bars of 8 mm, `0.3`, [x](a5.md), 12 s\n<!-- given: 12 s -->\nyield at <!--demo: load at first yield [kN]-->46<!--/--> kN\nand 47 kN\n")
            self.assertEqual(list(tool.unaccounted(page)), [(4, "47")])


class Pages(unittest.TestCase):
    def test_every_mark_names_a_quantity(self):
        """Every mark in the pages names a run and a quantity of it, or a row of the verification, and holds a number."""
        source = tool.Source(Runs("no program", ROOT / "build" / "none"))
        marks = [m for page in tool.pages() for m in tool.marked(page)]
        self.assertGreater(len(marks), 20)
        for place, of, what, text, _ in marks:
            source.needs(of, what)
            self.assertRegex(text, tool.NUMBER, place)

    def test_every_opening_mark_is_closed(self):
        """A mark that is not closed, or not read, is a mistake in writing it."""
        for page in tool.pages():
            text = page.read_text(encoding="utf-8")
            self.assertEqual(text.count("<!--/-->"), len(list(tool.marked(page))), page)

    def test_every_number_of_the_first_pages_is_accounted_for(self):
        """In the pages that a guest reads first every number is marked as one of a run, of the deck, or given."""
        for page in tool.COMPLETE:
            self.assertEqual(list(tool.unaccounted(ROOT / page)), [], page)


if __name__ == "__main__":
    unittest.main()
