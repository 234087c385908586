#!/usr/bin/python3
"""Checks the arrows between modules: src/fissura/CMakeLists.txt lists them from the ground up, each with the modules it
NEEDS, and

- a module needs only modules above its own line;
- a file includes only headers of its own module and of those its module needs, and only headers that exist;
- every folder of src/fissura has its line there, and its row in docs/architecture.md.

Prints every wrong arrow and exits with 1, or with 0 and one line if there is none.
"""
import re
import sys
from pathlib import Path

INCLUDE = re.compile(r'^\s*#\s*include\s+[<"]fissura/((\w+)/[^">]+)[">]')


def modules_of(text):
    """Name -> the modules it needs, in the order of the file."""
    found = {}
    for name, rest in re.findall(r"^\s*fissura_module\(\s*(\w+)([^)]*)\)", text, re.MULTILINE):
        words = rest.split()
        needs = words[words.index("NEEDS") + 1:] if "NEEDS" in words else []
        found[name] = needs[:needs.index("LIBRARIES")] if "LIBRARIES" in needs else needs
    return found


def wrong_needs(modules):
    order = list(modules)
    for name, needs in modules.items():
        for other in needs:
            if other not in modules:
                yield f"CMakeLists.txt: {name} needs {other}, which is no module"
            elif order.index(other) >= order.index(name):
                yield f"CMakeLists.txt: {name} needs {other}, which does not lie above it"


def wrong_includes(source, modules):
    for path in sorted(p for p in source.glob("*/**/*") if p.suffix in (".hpp", ".cpp")):
        name = path.relative_to(source).parts[0]
        for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
            match = INCLUDE.match(line)
            if not match:
                continue
            header, other = match.groups()
            place = f"{path.relative_to(source)}:{number}"
            if other != name and other not in modules.get(name, []):
                yield f"{place}: {name} -> {other} ({header}), but {name} does not need {other}"
            elif not (source / header).exists():
                yield f"{place}: there is no fissura/{header}"


def without_line(source, modules, architecture):
    text = architecture.read_text(encoding="utf-8") if architecture.exists() else ""
    for folder in sorted(p.name for p in source.iterdir() if p.is_dir() and any(p.iterdir())):
        if folder not in modules:
            yield f"{folder}/: no fissura_module({folder} ...) in CMakeLists.txt"
        elif not re.search(rf"^\| `{folder}` \|", text, re.MULTILINE):
            yield f"{folder}/: no row in docs/architecture.md"


def check(root):
    source = root / "src" / "fissura"
    modules = modules_of((source / "CMakeLists.txt").read_text(encoding="utf-8"))
    return [*wrong_needs(modules), *wrong_includes(source, modules),
            *without_line(source, modules, root / "docs" / "architecture.md")]


def main():
    root = Path(sys.argv[1]) if len(sys.argv) > 1 else Path(__file__).resolve().parent.parent
    wrong = check(root)
    print("\n".join(wrong) if wrong else "no wrong arrow between modules")
    sys.exit(1 if wrong else 0)


if __name__ == "__main__":
    main()
