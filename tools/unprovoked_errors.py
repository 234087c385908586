#!/usr/bin/python3
"""Lists the error messages that no test has provoked, from the counters of `make coverage`.

    tools/unprovoked_errors.py build-coverage/coverage/counts.json

A message is a statement that throws, or calls one of the functions that report what is wrong (refuse, fail, reader.error ...). Its
own counter is looked at, not that of its line: `if (bad) throw` runs its line without throwing. Prints their place and text, and
their number. Exits with 1 if there are any, or if the counters cannot be read.
"""
import json
import re
import sys
from bisect import bisect_right
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
SAYS = re.compile(
    r"\bthrow\s+(\w+::)*(Error|InputError|RunFailure)\b|\b(\w+[.>-]+)*(refuse|refuse_at|fail|error_at|throw_io_error|add_error)\("
    r"|\b(reader_?|r)\.error\(|\bfindings\.add\(|\bwrong\.push_back\(")


def is_definition(line):
    return "[[noreturn]]" in line or re.search(
        r"\b(void|auto( const)?&?) +(\w+::)*(refuse|fail|throw_io_error|add_error|error_at)\b", line)


def statements(text):
    """(line, column) of every statement that reports something wrong, from 1 -> its text."""
    lines, found = text.split("\n"), {}
    for number, line in enumerate(lines, 1):
        code = line.split("//")[0]
        says = SAYS.search(code)
        if says and not is_definition(code):
            whole, at = code.strip(), number
            while ";" not in lines[at - 1] and at < min(len(lines), number + 8):
                whole += " " + lines[at].strip()
                at += 1
            found[number, says.start() + 1] = whole
    return found


def counter_at(segments, place):
    """How often the code at (line, column) ran; None if it was never compiled. Segments: [line, column, count, counted ...]."""
    at = bisect_right([(s[0], s[1]) for s in segments], place) - 1
    return segments[at][2] if at >= 0 and segments[at][3] else None


def report(files):
    """Lines of text: every message without a test, then their number; and whether there is none."""
    total, silent = 0, []
    for file in files:
        path = Path(file["filename"])
        for place, whole in statements(path.read_text()).items():
            count = counter_at(file["segments"], place)
            if count is None:
                continue  # a template that nobody instantiates
            total += 1
            if count == 0:
                silent.append((str(path.relative_to(ROOT)), place[0], whole))
    text = [f"{name}:{number}: {whole[:150]}" for name, number, whole in sorted(silent)]
    return text + [f"{total - len(silent)} of {total} error messages are provoked by a test, {len(silent)} are not"], not silent


def main():
    try:
        files = json.loads(Path(sys.argv[1]).read_text())["data"][0]["files"]
    except (OSError, ValueError, KeyError, IndexError) as error:
        sys.exit(f"cannot read the counts: {error!r}")
    text, good = report(files)
    print("\n".join(text))
    sys.exit(not good)


if __name__ == "__main__":
    main()
