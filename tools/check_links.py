#!/usr/bin/python3
"""Checks that every relative link in the repository's Markdown files leads to a file that exists. Prints the broken
ones as file:line and exits with 1."""
import re
import sys
from pathlib import Path
from urllib.parse import unquote

LINK = re.compile(r"\]\(([^)\s]+)[^)]*\)")
SKIPPED = {".git", "runs", "node_modules"}


def markdown_files(root):
    for path in sorted(root.rglob("*.md")):
        parts = path.relative_to(root).parts
        if not any(p in SKIPPED or p.startswith("build") for p in parts[:-1]):
            yield path


def broken_links(root):
    for path in markdown_files(root):
        in_code = False
        for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
            if line.lstrip().startswith("```"):
                in_code = not in_code
            if in_code:
                continue
            for target in LINK.findall(re.sub(r"`[^`]*`", "", line)):
                if re.match(r"[a-z]+:|#", target):
                    continue
                if not (path.parent / unquote(target.split("#")[0])).exists():
                    yield f"{path.relative_to(root)}:{number}: {target}"


def main():
    root = Path(sys.argv[1]) if len(sys.argv) > 1 else Path(__file__).resolve().parent.parent
    broken = list(broken_links(root))
    print("\n".join(broken) if broken else "all links lead somewhere")
    sys.exit(1 if broken else 0)


if __name__ == "__main__":
    main()
