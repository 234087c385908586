#!/usr/bin/python3
"""Builds the documentation as a web site, with mkdocs, in BUILD/docs; a warning of mkdocs is an error, and so is a page
that asks for something outside the site.

    tools/docs_site.py [BUILD]

The pages link to each other and to examples as files of the repository do, so what the site shows is first gathered in
BUILD/docs-source with the folders as they are. Five books: tutorials, theory, reference, verification, gallery; a page
takes its title from its first heading and its place from its folder.
"""
import json
import re
import shutil
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
SHOWN = ["README.md", "CHANGELOG.md", "CONTRIBUTING.md", "SECURITY.md", "CITATION.cff", "LICENSE", "docs", "examples",
         "bench"]
BOOKS = {  # which pages come first; the others of the folder follow by name
    "Tutorials": ("docs/tutorials", ["first_beam", "cyclic_column", "impact", "mesh", "python"]),
    "Theory": ("docs/theory", ["limits", "errata", "tets", "joint_geometry", "cohesive", "softening",
                               "rate_factor", "bars", "bar_joint", "bond_slip", "dowel", "time_step", "energy"]),
    "Reference": ("docs/reference", ["deck", "cages", "materials", "cli", "outputs", "mistakes", "glossary"]),
    "Verification": ("docs/verification", ["index"]),
    "Gallery": ("docs/gallery", ["index"]),
    "Design": ("docs/decisions", ["README"]),
}
NO_DOCS = 77  # ctest: skipped


def tracked():
    """The files shown, as git knows them; all files where there is no git."""
    try:
        listed = subprocess.run(["git", "ls-files", "--cached", "--others", "--exclude-standard", "-z", "--", *SHOWN],
                                cwd=ROOT, check=True, capture_output=True, text=True).stdout
        return [ROOT / name for name in listed.split("\0") if name]
    except (OSError, subprocess.CalledProcessError):
        return [f for top in SHOWN for f in ([ROOT / top] if (ROOT / top).is_file() else (ROOT / top).rglob("*"))]


def gather(source):
    shutil.rmtree(source, ignore_errors=True)
    for file in tracked():
        if file.is_file():
            target = source / file.relative_to(ROOT)
            target.parent.mkdir(parents=True, exist_ok=True)
            shutil.copyfile(file, target)


def pages(source, folder, first):
    found = sorted((source / folder).glob("*.md"))
    order = {name: i for i, name in enumerate(first)}
    found.sort(key=lambda page: (order.get(page.stem, len(order)), page.stem))
    return [str(page.relative_to(source)) for page in found]


def navigation(source):
    nav = [{"Fissura": "README.md"}]
    for title, (folder, first) in BOOKS.items():
        book = pages(source, folder, first)
        if title == "Gallery":
            book += [str(p.relative_to(source)) for p in sorted((source / "examples").glob("*/README.md"))]
        if title == "Design":
            book = ["docs/architecture.md", "docs/performance.md", *book]
        if book:
            nav.append({title: book})
    return nav


def mend(site):
    """The theme as Debian packs it names scripts by versions that it does not ship. Scripts that are there under another
    version get the name asked for; those that are not there at all are not asked for."""
    for page in site.rglob("*.html"):
        text = page.read_text(encoding="utf-8")

        def script(tag, page=page):
            target = page.parent / tag[1]
            if "://" in tag[1] or target.exists():
                return tag[0]
            other = sorted(target.parent.glob(re.sub(r"-[\d.]+\.min", "-*.min", target.name)))
            if not other:
                return ""
            shutil.copyfile(other[-1], target)
            return tag[0]

        page.write_text(re.sub(r'<script src="([^"]+)"[^>]*></script>', script, text), encoding="utf-8")


def reaches_out(site):
    """What pages ask for that is not in the site: scripts, styles and pictures, as page: address."""
    for page in sorted(site.rglob("*.html")):
        if page.name == "404.html":  # for servers: its addresses begin at their root
            continue
        for tag in re.findall(r"<(?:script|link|img)\b[^>]*>", page.read_text(encoding="utf-8")):
            address = re.search(r'(?:src|href)="([^"]+)"', tag)
            if address and 'rel="canonical"' not in tag and ("://" in address[1] or not (page.parent / address[1].split("?")[0]).exists()):
                yield f"{page.relative_to(site)}: {address[1]}"


def main():
    build = (Path(sys.argv[1]) if len(sys.argv) > 1 else ROOT / "build").resolve()
    if shutil.which("mkdocs") is None:
        print("mkdocs is not installed: the site is not built")
        return NO_DOCS
    source = build / "docs-source"
    gather(source)
    settings = (ROOT / "mkdocs.yml").read_text(encoding="utf-8")
    settings += f"docs_dir: {json.dumps(str(source))}\nsite_dir: {json.dumps(str(build / 'docs'))}\n"
    settings += f"nav: {json.dumps(navigation(source))}\n"  # JSON is YAML
    config = build / "mkdocs.yml"
    config.write_text(settings, encoding="utf-8")
    done = subprocess.run(["mkdocs", "build", "--quiet", "--strict", "-f", str(config)], check=False)
    if done.returncode != 0:
        return done.returncode
    mend(build / "docs")
    missing = list(reaches_out(build / "docs"))
    print("\n".join(missing) or build / "docs/index.html")
    return 1 if missing else 0


if __name__ == "__main__":
    sys.exit(main())
