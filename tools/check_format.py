#!/usr/bin/python3
"""Every C++ file is as clang-format writes it (.clang-format). `make format` formats them. Exit code 77 (skipped) without clang-format."""
import shutil
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
FOLDERS = ("apps", "bench", "python", "src", "tests", "tools")


def sources():
    """What git knows, or where there is no git all of the folders with sources."""
    listed = subprocess.run(["git", "ls-files", "--cached", "--others", "--exclude-standard", "*.cpp", "*.hpp"], capture_output=True, text=True, cwd=ROOT)
    if listed.returncode == 0 and listed.stdout:
        return sorted(p for p in listed.stdout.splitlines() if (ROOT / p).is_file())
    return sorted(str(p.relative_to(ROOT)) for f in FOLDERS for e in ("*.cpp", "*.hpp") for p in (ROOT / f).rglob(e))


def main():
    program = shutil.which("clang-format")
    if not program:
        print("skipped: no clang-format here (apt: clang-format)")
        sys.exit(77)
    wrong = []
    for path in sources():
        text = (ROOT / path).read_bytes()
        if subprocess.run([program, f"--assume-filename={ROOT / path}"], input=text, capture_output=True, check=True).stdout != text:
            wrong.append(path)
    print("\n".join(f"{p}: not formatted; `make format` does it" for p in wrong) or f"{len(sources())} files are formatted")
    sys.exit(1 if wrong else 0)


if __name__ == "__main__":
    main()
