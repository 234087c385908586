#!/usr/bin/python3
"""Numbers in the pages that come from runs: compares them with runs, or writes them anew.

    check_numbers.py --program build/fissura                  compare those of short runs; exits with 1 if one is no longer true
    check_numbers.py --program build/fissura --only demo      those of one run
    check_numbers.py --program build/fissura --long           also those of long runs
    check_numbers.py --program build/fissura --write [--long] write what the runs give, with as many digits as stand there

A number of a run stands in its page between two comments that no reader sees:

    the bars yield at <!--demo: yield-->46.7<!--/--> kN

The first names a run (verify_runs.py) and one of its quantities: a key of run.json or a name in numbers_of_runs.py; or a case and a row of the
verification (verify_checks.py), as in <!--four_point: load at first yield [kN]-->. A block of output is compared line by line
with what the program says now if `<!--output of: check examples/...-->` stands before it.

The expected.csv of an example whose run is made is compared, or written, along with them (pictures: examples.py --update).

In the pages of COMPLETE every number is accounted for: it is marked so, or stands in a deck beside the page, or in a
comment `<!-- given: 12 s, 6.5 -->` with those that are no result of a run. A quantity that ends in "(at most)" or
"(at least)" is a bound: true as long as the run keeps it, and never written anew.
"""
import argparse
import re
import subprocess
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
import examples
import numbers_of_runs as numbers
import verify_checks
from fissura_io import BadFile
from verify_runs import ROOT, RunFailed, Runs

PAGES = ("README.md", "docs/tutorials/*.md", "docs/theory/*.md", "docs/performance.md", "examples/*/README.md")
# Pages in which every number is accounted for.
COMPLETE = ("README.md", *(f"docs/tutorials/{page}.md" for page in ("first_beam", "mesh", "python")),
            *(f"examples/{name}/README.md" for name in ("00_demo_beam", "01_tension_prism", "02_self_weight_beam", "03_elastic_tie", "04_tie_to_failure",
                                                        "07_compression_prism", "12_notched_beam", "16_colliding_blocks")))
MARK = re.compile(r"<!--(?P<of>\w+): (?P<what>[^>]*?)-->(?P<text>[^<]*)<!--/-->")
OUTPUT = re.compile(r"<!--output of: (?P<words>[^>]*?)-->\n+```\w*\n(?P<text>.*?)```", re.S)
NUMBER = re.compile(r"(?<![\w.])[-+]?(?:\d{1,3}(?:,\d{3})+|\d+)(?:\.\d+)?(?:e[-+]?\d+)?")


class Untrue(Exception):
    """A number that a run does not give, or that nobody can look up."""


# ---- one number --------------------------------------------------------------------------------------

def unit_of_last_digit(text):
    """What one in the last digit stands for: 0.1 for 57.5, 1e-5 for 1.02e-3, 1000 for 183,000."""
    mantissa, _, power = text.replace(",", "").lower().partition("e")
    digits = mantissa.partition(".")[2]
    zeros = len(mantissa) - len(mantissa.rstrip("0")) if "." not in mantissa else 0
    return 10.0 ** ((zeros if zeros >= 3 else -len(digits)) + int(power or 0))


def rounded(value, text):
    """A value as the text is written: as many digits, thousands parted, a sign where there was one."""
    unit, sign = unit_of_last_digit(text), "+" if text.startswith("+") else ""
    if "e" in text.lower():
        digits = len(text.lower().partition("e")[0].partition(".")[2])
        mantissa, power = f"{value:{sign}.{digits}e}".split("e")
        return f"{mantissa}e{int(power)}"
    digits = len(text.partition(".")[2])
    value = round(value / unit) * unit
    return f"{value:{sign}{',' if ',' in text or abs(value) >= 1e4 else ''}.{digits}f}"


AT_MOST, AT_LEAST = " (at most)", " (at least)"


def is_true(value, text, scatter):
    """Whether the text is the value, rounded; `scatter`: by what share of itself it may differ between machines."""
    printed = float(text.replace(",", ""))
    return abs(value - printed) <= 0.5 * unit_of_last_digit(text) * (1 + 1e-9) + scatter * abs(value)


# ---- where it comes from -------------------------------------------------------------------------------

class Source:
    """What the marks name: runs and their quantities, and rows of the verification."""

    def __init__(self, runs):
        self.runs = runs
        self.rows = {(c.case, c.quantity): c for c in verify_checks.all_checks()}
        self.rows |= {(c.case, c.quantity): c for c in numbers.of_rows(list(self.rows.values()))}

    def needs(self, of, what):
        """Names of the runs that a number is read from."""
        what = what.removesuffix(AT_MOST).removesuffix(AT_LEAST)
        if (of, what) in self.rows:
            return self.rows[of, what].runs
        if of in self.runs.specs and (what in numbers.SUMMARY or what in numbers.of_run(of)):
            return (of,)
        raise Untrue(f"`{of}: {what}` names no quantity of a run and no row of the verification")

    def value(self, of, what):
        what = what.removesuffix(AT_MOST).removesuffix(AT_LEAST)
        runs = [self.runs.get(name) for name in self.needs(of, what)]
        if (of, what) in self.rows:
            return float(self.rows[of, what].measure(*runs))
        if what in numbers.SUMMARY:
            return float(numbers.SUMMARY[what](runs[0].summary))
        return float(numbers.of_run(of)[what](runs[0]))

    def is_true(self, value, of, what, text):
        if what.endswith(AT_MOST):
            return value <= float(text.replace(",", ""))
        if what.endswith(AT_LEAST):
            return value >= float(text.replace(",", ""))
        return is_true(value, text, self.scatter(of, what))

    def scatter(self, of, what):
        return max(numbers.scatter_of(name, what) for name in self.needs(of, what))


# ---- pages --------------------------------------------------------------------------------------------

def pages():
    return sorted(p for pattern in PAGES for p in ROOT.glob(pattern))


def line_of(text, at):
    return text.count("\n", 0, at) + 1


def marked(path):
    """(place, run or case, quantity, number as text, span of the text) of each mark of a page."""
    text = path.read_text(encoding="utf-8")
    for m in MARK.finditer(text):
        yield f"{path.relative_to(ROOT)}:{line_of(text, m.start())}", m["of"], m["what"], m["text"], m.span("text")


def compare_output(path, program, write):
    """Lines of blocks of output that the program does not say (any more); with `write` they are replaced where their first word is found."""
    text = path.read_text(encoding="utf-8")
    wrong, new = [], text
    for block in OUTPUT.finditer(text):
        done = subprocess.run([str(program), *block["words"].split()], capture_output=True, text=True, cwd=ROOT)
        said = (done.stdout + done.stderr).splitlines()
        for line in block["text"].splitlines():
            if line.strip() in ("...", "") or line in said:
                continue
            label = re.split(r"\s{2,}", line)[0]
            now = [s for s in said if re.split(r"\s{2,}", s)[0] == label]
            if write and now:
                new = new.replace(line, now[0])
            else:
                wrong.append(f"{path.relative_to(ROOT)}:{line_of(text, block.start())}: the program does not say: {line}")
    if new != text:
        path.write_text(new, encoding="utf-8")
    return wrong


def prose(text):
    """The page without what is no prose: code, links' targets, comments, marked numbers."""
    text = MARK.sub(" ", text)
    for pattern in (r"```.*?```", r"<!--.*?-->", r"`[^`\n]*`", r"\]\([^)]*\)", r"https?://\S+", r"[Ee]xample \d+"):
        text = re.sub(pattern, lambda m: "\n" * m[0].count("\n"), text, flags=re.S)
    return text


def given(path):
    """Numbers that need no run: of the decks beside the page, and those its comment says are given."""
    known = set()
    decks = [*path.parent.glob("*.toml"), *path.parent.glob("*.geo")]
    if "tutorials" in str(path):
        decks = [ROOT / m for m in re.findall(r"examples/\w+/\w+\.toml", path.read_text(encoding="utf-8"))]
    for deck in decks:
        known |= {float(n) for n in re.findall(r"\d+(?:\.\d+)?(?:e[-+]?\d+)?", deck.read_text(encoding="utf-8"))}
    for comment in re.findall(r"<!-- given:(.*?)-->", path.read_text(encoding="utf-8"), flags=re.S):
        known |= {abs(float(n.replace(",", ""))) for n in NUMBER.findall(comment)}
    return known


def unaccounted(path):
    """(line, number) for each number in the prose that is neither marked nor given."""
    known, text = given(path), prose(path.read_text(encoding="utf-8"))
    for m in NUMBER.finditer(text):
        if abs(float(m[0].replace(",", "").rstrip("."))) not in known:
            yield line_of(text, m.start()), m[0]


# ---- the tool -----------------------------------------------------------------------------------------

def write_numbers(path, values):
    """Puts the values of all marks of a page that have one: {(run, quantity): value}."""
    text = path.read_text(encoding="utf-8")
    for _, of, what, printed, (begin, end) in reversed(list(marked(path))):
        if (of, what) in values and not what.endswith((AT_MOST, AT_LEAST)):
            text = text[:begin] + rounded(values[of, what], printed) + text[end:]
    path.write_text(text, encoding="utf-8")


def compare_examples(runs, made, write):
    """Curves that have left the expected.csv of the examples whose run has been made; with `write` they are written."""
    wrong = []
    for name, example in examples.EXAMPLE.items():
        if example.run not in made or example.run in runs.failed:
            continue
        expected = examples.EXAMPLES / name / "expected.csv"
        if write:
            examples.write_expected(example, runs.get(example.run), expected)
            continue
        wrong += [f"examples/{name}/expected.csv: {c} differs by {d:.2g} of its range" for c, d in examples.differences(example, runs.get(example.run), expected)]
    return wrong


def check(arguments, runs):
    source, wrong, marks = Source(runs), [], []
    for path in pages():
        for place, of, what, text, _ in marked(path):
            try:
                needed = source.needs(of, what)
                if NUMBER.fullmatch(text) is None:
                    raise Untrue(f"`{text}` is no number")
            except Untrue as error:
                wrong.append(f"{place}: {error}")
                continue
            chosen = all(name in arguments.only for name in needed) if arguments.only else \
                arguments.long or not any(runs.specs[name].long for name in needed)
            if chosen and not (arguments.cached and not all(runs.is_cached(name) for name in needed)):
                marks.append((path, place, of, what, text))
    made = list(dict.fromkeys(name for _, _, of, what, _ in marks for name in source.needs(of, what)))
    runs.make(made)
    wrong += compare_examples(runs, made, arguments.write)
    values = {}
    for path, place, of, what, text in marks:
        try:
            values[of, what] = value = source.value(of, what)
            if not (arguments.write and not what.endswith((AT_MOST, AT_LEAST))) and not source.is_true(value, of, what, text):
                wrong.append(f"{place}: {of}: {what} is {value:.6g}, the page says {text}")
        except (RunFailed, BadFile, OSError) as error:
            wrong.append(f"{place}: {error}")
        except (KeyError, IndexError, TypeError, ValueError) as error:
            wrong.append(f"{place}: the run does not show it ({type(error).__name__}: {error})")
    for path in pages():
        if arguments.write:
            write_numbers(path, values)
        wrong += compare_output(path, arguments.program, arguments.write)
    for page in COMPLETE:
        wrong += [f"{page}:{line}: {number} is neither marked as a number of a run nor given" for line, number in unaccounted(ROOT / page)]
    return len(marks), wrong


def main():
    parser = argparse.ArgumentParser(description="Compares the numbers in the pages with runs, or writes them.")
    parser.add_argument("--program", default=str(ROOT / "build" / "fissura"))
    parser.add_argument("--runs", default=str(ROOT / "build" / "verify"), help="folder of the runs, as of verify.py: those that are there are used again")
    parser.add_argument("--write", action="store_true", help="write what the runs give")
    parser.add_argument("--only", action="append", metavar="RUN", help="numbers of these runs only")
    parser.add_argument("--long", action="store_true", help="also those of long runs")
    parser.add_argument("--cached", action="store_true", help="make no runs; leave out numbers whose runs are not there")
    parser.add_argument("--jobs", type=int, default=0)
    parser.add_argument("--unaccounted", metavar="PAGE", help="list the numbers of a page that are neither marked nor given, and end")
    arguments = parser.parse_args()
    if arguments.unaccounted:
        for line, number in unaccounted(Path(arguments.unaccounted).resolve()):
            print(f"{line}: {number}")
        return
    count, wrong = check(arguments, Runs(arguments.program, arguments.runs, arguments.jobs, arguments.cached))
    print("\n".join(wrong) or f"{count} numbers {'written' if arguments.write else 'are what the runs give'}")
    sys.exit(1 if wrong else 0)


if __name__ == "__main__":
    main()
