#!/usr/bin/python3
"""Lists the error messages that no test has provoked, from the line counts of `make coverage`.

    tools/unprovoked_errors.py build-coverage/coverage/lines.json

A message is a statement that throws, or calls one of the functions that do nothing else (refuse, fail, add_error ...): its first
line was compiled and never run. Prints their number, place and text. Exits with 1 only if the counts cannot be read.
"""
import json
import re
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
SAYS = re.compile(r"\bthrow\s+(core::)?(Error|InputError|RunFailure)\b|\b(\w+[.>-]+)?(refuse|refuse_at|fail|error_at|throw_io_error|add_error)\(")


def is_definition(line):
    return "[[noreturn]]" in line or re.search(r"\b(void|auto( const)?&?)\s+(refuse|fail|throw_io_error|add_error|error_at)\b", line)


def statements(text):
    """First line number of every statement that throws -> its lines as one text."""
    lines, found = text.split("\n"), {}
    for number, line in enumerate(lines, 1):
        code = line.split("//")[0]
        if SAYS.search(code) and not is_definition(code):
            whole, at = code.strip(), number
            while ";" not in lines[at - 1] and at < min(len(lines), number + 8):
                whole += " " + lines[at].strip()
                at += 1
            found[number] = (at, whole)
    return found


def main():
    try:
        files = json.loads(Path(sys.argv[1]).read_text())["files"]
    except (OSError, ValueError, KeyError, IndexError) as error:
        sys.exit(f"cannot read the counts: {error!r}")
    total, silent = 0, []
    for file in files:
        count = {}
        for line in file["lines"]:
            count[line["line_number"]] = max(count.get(line["line_number"], 0), line["count"])
        path = ROOT / file["file"]
        if path.suffix not in (".cpp", ".hpp") or not path.exists():
            continue
        for number, (last, whole) in statements(path.read_text()).items():
            counts = [count[n] for n in range(number, last + 1) if n in count]
            if not counts:
                continue  # a template that nobody instantiates, or a declaration
            total += 1
            if max(counts) == 0:
                silent.append((file["file"], number, whole))
    for name, number, whole in sorted(silent):
        print(f"{name}:{number}: {whole[:150]}")
    print(f"{total - len(silent)} of {total} error messages are provoked by a test, {len(silent)} are not")


if __name__ == "__main__":
    main()
