#!/usr/bin/python3
"""Checks every command printed in the repository's Markdown files against the program's own --help.

Looked at are the lines of ```sh blocks, lines after `$ ` and code in the running text that begins with `fissura`, `make` or
`tools/`: the subcommand and its options exist, an option with a fixed choice gets one of it, templates exist, decks under
examples/ are there, columns that `plot` draws are gauges of the deck that was run into that folder, targets of `make` and options
of tools are in their source. And the other way round: the page of the command line names every option of the program.
Prints what is untrue as file:line and exits with 1. With --decks `fissura check` also reads every deck under examples/ that a page
runs, with the changes that stand there: half a minute.

    tools/check_commands.py build/fissura [ROOT] [--decks]
"""
import argparse
import re
import shlex
import subprocess
import sys
import tomllib
from pathlib import Path

from check_links import markdown_files

PROGRAMS = {"fissura", "build/fissura"}
# Columns of every history.csv beside the gauges and reactions (docs/reference/outputs.md).
COMMON = re.compile(r"time|load_time|pace|energy_\w+|reaction_\w+|joints_\w+|bar_joints_\w+|bars_broken|fragments")
PAGE = "docs/reference/cli.md"


class Help:
    """What the program says about itself."""

    def __init__(self, program):
        self.program = program
        self.subcommands = set(re.findall(r"^  (\w+)  ", self.ask().split("Subcommands:")[1], re.M))
        self.text = {s: self.ask(s) for s in self.subcommands}
        self.options = {s: self.options_of(t) for s, t in self.text.items()}
        self.options[""] = self.options_of(self.ask())
        self.templates = set(re.search(r"One of: (.*)", self.text["new"])[1].split(", "))

    def ask(self, *words):
        return subprocess.run([self.program, *words, "--help"], capture_output=True, text=True, check=True).stdout

    @staticmethod
    def options_of(text):
        """Option -> its fixed choice, an empty set where anything goes, or None where it takes no value."""
        found = {}
        for names, value in re.findall(r"^  ((?:-\w,)?--?[\w-]+)(.*)", text, re.M):
            choice = re.match(r" TEXT:\{([^}]*)\}", value)
            takes = re.match(r" (TEXT|INT|FLOAT|UINT)", value)
            for name in names.split(","):
                found[name] = set(choice[1].split(",")) if choice else set() if takes else None
        return found


def commands_in(text):
    """(line number, command) of a Markdown text."""
    block, going_on, begin = None, "", 0
    for number, line in enumerate(text.splitlines(), 1):
        fence = re.match(r"\s*```(\w*)", line)
        if fence:
            block = None if block is not None else fence[1]
            continue
        if block is None:
            for code in re.findall(r"`((?:build/)?fissura [a-z][^`\\]*|make [a-z][^`]*|tools/\w+\.(?:py|sh)[^`]*)`", line):
                yield number, code
        elif block == "sh" or line.startswith(("$ ", "fissura ", "build/fissura ")):
            begin = begin if going_on else number
            going_on += line.removeprefix("$ ")
            if going_on.endswith("\\"):
                going_on = going_on[:-1]
                continue
            yield begin, going_on
            going_on = ""


def words_of(command):
    """The words of a command; brackets and dots of a usage line are left out, and of `a|b` the first stands for both."""
    usage = re.sub(r"\[(-[^\]]*)\](\.\.\.)?", r"\1", command).replace("...", "")
    return shlex.split(usage, comments=True)


class Checker:
    def __init__(self, program, root, decks=False):
        self.help = Help(program)
        self.reads_decks = decks
        self.root = root
        self.targets = set(re.findall(r"^([a-z-]+):", (root / "Makefile").read_text(encoding="utf-8"), re.M))
        self.decks = {}  # run folder -> deck that was run into it, on the present page
        self.seen = 0

    def page(self, text):
        """(line number, what is untrue) of a page."""
        self.decks = {}
        for number, command in commands_in(text):
            try:
                words = words_of(command)
            except ValueError as error:
                yield number, f"{command}: {error}"
                continue
            self.seen += 1
            for problem in self.command(words):
                yield number, f"{command.strip()}: {problem}"

    def command(self, words):
        while words and re.fullmatch(r"[A-Z_]+=\S*", words[0]):  # variables of the environment
            words = words[1:]
        if not words:
            return
        if words[0] in PROGRAMS:
            yield from self.fissura(words[1:])
        elif words[0] == "make":
            yield from (f"the Makefile has no target {w}" for w in words[1:] if "=" not in w and w not in self.targets)
        elif words[0].startswith("tools/"):
            yield from self.tool(words)

    def tool(self, words):
        path = self.root / words[0]
        if not path.exists():
            yield f"{words[0]} does not exist"
            return
        source = path.read_text(encoding="utf-8")
        yield from (f"{words[0]} has no option {w}" for w in words[1:] if w.startswith("--") and w not in source)

    def fissura(self, words):
        sub = words[0] if words and not words[0].startswith("-") else ""
        if sub and sub not in self.help.subcommands:
            yield f"there is no subcommand {sub}"
            return
        options, known, places = [], self.help.options[sub], []
        rest = iter(words[1:] if sub else words)
        for word in rest:
            if not word.startswith("-"):
                places.append(word)
                continue
            if word not in known:
                yield f"{sub or 'fissura'} has no option {word}"
            elif known[word] is not None:
                value = next(rest, None)
                options.append((word, value))
                yield from self.value(word, value, known[word])
        if sub == "new" and len(places) > 1 and places[0].islower() and places[0] not in self.help.templates:
            yield f"there is no template {places[0]}"
        yield from self.places(sub, places, options)

    @staticmethod
    def value(option, value, choice):
        if value and choice:
            yield from (f"{option} takes {', '.join(sorted(choice))}, not {v}" for v in value.split("|") if v not in choice)

    def places(self, sub, places, options):
        for place in places:
            if place.startswith("examples/") and not (self.root / place).exists():
                yield f"{place} does not exist"
        if sub == "run" and places and "--out" in dict(options):
            self.decks[dict(options)["--out"]] = self.root / places[0]
        if self.reads_decks and sub in ("run", "check") and places and (self.root / places[0]).is_relative_to(self.root / "examples"):
            yield from self.deck(places[0], [word for o, v in options if o == "--set" for word in (o, v)])
        if sub == "plot" and places:
            yield from self.columns(places[0], [v for o, v in options if o in ("--x", "--y")])

    def deck(self, place, changes):
        done = subprocess.run([self.help.program, "check", place, *changes], cwd=self.root, capture_output=True, text=True)
        if done.returncode:
            yield (done.stderr or done.stdout).strip().splitlines()[0]

    def columns(self, folder, names):
        deck = self.decks.get(folder)
        if deck is None or not deck.exists():
            return
        gauges = {g["name"] for g in tomllib.loads(deck.read_text(encoding="utf-8")).get("gauge", [])}
        yield from (f"{deck.parent.name} has no gauge {n}" for n in names if n not in gauges and not COMMON.fullmatch(n))

    def missing_on_the_page(self):
        """Options and subcommands of the program that the page of the command line does not name."""
        text = (self.root / PAGE).read_text(encoding="utf-8")
        usage = {c.split()[1]: c for _, c in commands_in(text) if c.startswith("fissura ") and len(c.split()) > 1}
        for sub in sorted(self.help.subcommands):
            if sub not in usage:
                yield 1, f"`fissura {sub}` is missing"
                continue
            for option in self.help.options[sub]:
                if option.startswith("--") and option != "--help" and option not in text.replace("-o FILE", "--out -o"):
                    yield 1, f"`fissura {sub} {option}` is missing"


def untrue(checker, root):
    for path in markdown_files(root):
        for number, problem in checker.page(path.read_text(encoding="utf-8")):
            yield f"{path.relative_to(root)}:{number}: {problem}"
    for number, problem in checker.missing_on_the_page():
        yield f"{PAGE}:{number}: {problem}"


def main():
    parser = argparse.ArgumentParser(description="Checks every command printed in the Markdown files.")
    parser.add_argument("program")
    parser.add_argument("root", nargs="?", default=str(Path(__file__).resolve().parent.parent))
    parser.add_argument("--decks", action="store_true", help="also read the decks that pages run, with the changes that stand there")
    arguments = parser.parse_args()
    root = Path(arguments.root)
    checker = Checker(str(Path(arguments.program).resolve()), root, arguments.decks)
    found = list(untrue(checker, root))
    print("\n".join(found) if found else f"{checker.seen} commands on the pages, all of which the program, make and the tools know")
    sys.exit(1 if found else 0)


if __name__ == "__main__":
    main()
