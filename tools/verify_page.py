"""Writes the verification page from the rows of verification.csv."""
from pathlib import Path

from verify_checks import CASES

TOP = """# Verification

<!-- Written by tools/verify.py --page: change it there. -->

The founding paper's examples and what must hold beside them, computed by this program. `make verify` runs the short
cases (minutes), `make validate` all of them; both write the rows below as CSV. A row passes if the computed value is
within the tolerance of the reference; the reference is theory or the paper, the tolerances were fixed before the runs.
Two readings were chosen after a first look at the curves: the mean strain of 3.4 (elongation over the length that the
bar joints stand for) and the loads of 4.2 (means over 10 ms); the rougher readings stand beside them as information.
Rows without tolerance are information. The misprints of the paper are in [the errata](../theory/errata.md); dimensions that the paper's lost figures held
are reconstructed, and each [example](../../examples) says which.
"""
OLDER = " °"  # behind a computed value
EARLIER = "*Computed by an earlier build.*"


def figure_file(name):
    """fig13.png for the paper's figure 13, l_panel.png for one of our own."""
    return f"fig{name}.png" if str(name)[0].isdigit() else f"{name}.png"


def figure_title(name):
    title = str(name).replace("_", ", " if str(name)[0].isdigit() else " ")
    return f"Figure {title}" if title[0].isdigit() else title.capitalize()


def shown(text):
    return "" if text in ("nan", "inf") else text


def rounded(text):
    """A computed value to four digits: the CSV has more, and means no more."""
    if text in ("nan", "inf"):
        return ""
    value = float(text)
    return "0" if value == 0 else f"{value:.4g}" if 1e-4 <= abs(value) < 1e5 else f"{value:.1e}".replace("e-0", "e-")


def older_rows(path, checks):
    """What the page at `path` holds for these checks, judged by their references and tolerances of today: {check: row}."""
    values, title = {}, ""
    for line in Path(path).read_text(encoding="utf-8").splitlines() if Path(path).exists() else []:
        cells = [c.strip() for c in line.split("|")]
        if line.startswith("## "):
            title = line[3:]
        elif len(cells) == 8:
            values[title, cells[1]] = cells[4].removesuffix(OLDER)
    found = {}
    for check in checks:
        computed = values.get((CASES[check.case].title, check.quantity))
        if computed:
            good = abs(float(computed) - check.reference) <= check.tolerance or check.tolerance == float("inf")
            found[check] = [check.case, check.quantity, f"{check.reference:.6g}", computed, f"{check.tolerance:.6g}", str(good).lower()]
    return found


def age(rows, older, adopted=()):
    build = f"two builds (the runs {', '.join(adopted)} by one, all others by the other)" if adopted else "one build"
    if not older:
        return f"All rows were computed by {build}.\n"
    return (f"{len(rows) - len(older)} rows were computed by {build}; {len(older)} are older (whole sections that say so, and rows marked{OLDER}): earlier "
            "builds computed them, and they stand until their case is run again.\n")


def write_page(path, rows, checks, older=(), adopted=()):
    """`older`: which of the checks have rows of earlier builds; `adopted`: names of runs that were made by hand."""
    lines = [TOP, age(rows, older, adopted)]
    failed = [r for r in rows if r[5] != "true"]
    lines.append(f"{len(rows)} rows, {len(failed)} outside their tolerance" + (" (marked **no**)." if failed else ".") + "\n")
    for name, case in CASES.items():
        of_case = [(r, c) for r, c in zip(rows, checks) if r[0] == name]
        if not of_case:
            continue
        all_older = all(c in older for _, c in of_case)
        lines += [f"## {case.title}", "", case.about, *(["", EARLIER] if all_older else []), "", "| quantity | paper | reference | computed | tolerance | within |",
                  "|---|---|---:|---:|---:|---|"]
        for row, check in of_case:
            mark = OLDER if check in older and not all_older else ""
            within = "" if row[4] == "inf" else "yes" if row[5] == "true" else "**no**"
            lines.append(f"| {row[1]} | {check.paper} | {shown(row[2])} | {rounded(row[3])}{mark} | {shown(row[4])} | {within} |")
        lines.append("")
        for number in case.figures:
            if (Path(path).parent / "figures" / figure_file(number)).exists():
                lines += [f"![{figure_title(number)}](figures/{figure_file(number)})", ""]
    Path(path).parent.mkdir(parents=True, exist_ok=True)
    Path(path).write_text("\n".join(lines), encoding="utf-8")
