#!/usr/bin/python3
"""The mistakes of new users, and what the program says to them: writes docs/reference/mistakes.md from real output.

    tools/mistakes.py PROGRAM --update     writes the page
    tools/mistakes.py PROGRAM              checks that the page is what the program says today

Each mistake changes one place of a sound deck; `fissura check` must answer with an error or a warning that holds the
given words.
"""
import re
import subprocess
import sys
import tempfile
from pathlib import Path

PAGE = Path(__file__).resolve().parent.parent / "docs/reference/mistakes.md"

SOUND = """title = "a beam"
[[mesh.box]]
from = ["0 m", "0 m", "0 m"]
to = ["1.2 m", "120 mm", "160 mm"]
cells = [16, 4, 5]
[[concrete]]
name = "C30"
E = "33 GPa"
f_t = "2.9 MPa"
f_c = "38 MPa"
[[steel]]
name = "B500"
f_y = "500 MPa"
f_u = "550 MPa"
[[cage]]
name = "cage"
steel = "B500"
from = ["0 m", "0 m", "0 m"]
to = ["1.2 m", "120 mm", "160 mm"]
cover = "20 mm"
bottom = "2 x 10 mm"
[[bar]]
name = "top"
steel = "B500"
diameter = "8 mm"
points = [["20 mm", "42 mm", "135 mm"], ["1.18 m", "42 mm", "135 mm"]]
count = 2
spacing = ["0 mm", "36 mm", "0 mm"]
[[support]]
name = "left"
where = {line = [["75 mm", "0 m", "0 m"], ["75 mm", "120 mm", "0 m"]]}
fix = ["x", "y", "z"]
[[support]]
name = "right"
where = {line = [["1.125 m", "0 m", "0 m"], ["1.125 m", "120 mm", "0 m"]]}
fix = ["z"]
[[motion]]
name = "jack"
where = {line = [["600 mm", "0 m", "160 mm"], ["600 mm", "120 mm", "160 mm"]]}
axis = "z"
velocity = {value = "-0.1 m/s", over = "10 ms"}
[run]
end_time = "50 ms"
mass_damping = "100 1/s"
[[gauge]]
name = "load"
kind = "reaction"
of = ["left", "right"]
axis = "z"
"""

# title, what stands in the sound deck, what the user wrote, "error" or "warning", words of the answer
MISTAKES = [
    ("A number without its unit", 'E = "33 GPa"', "E = 33e9", "error", "needs a unit"),
    ("The wrong prefix: mega for giga", 'E = "33 GPa"', 'E = "33 MPa"', "warning", "is the unit right?"),
    ("A strength in N/m2 taken for N/mm2", 'f_c = "38 MPa"', 'f_c = "38 N/m2"', "error", "is larger than"),
    ("A unit misspelt", 'f_t = "2.9 MPa"', 'f_t = "2.9 Mpa"', "error", "did you mean `MPa`?"),
    ("Steel in GPa", 'f_y = "500 MPa"\nf_u = "550 MPa"', 'f_y = "500 GPa"\nf_u = "550 GPa"\neps_sh = 5', "error", "eps_sh"),
    ("Metres and millimetres mixed up", 'to = ["1.2 m", "120 mm", "160 mm"]\ncells', 'to = ["1200 m", "120 m", "160 m"]\ncells',
     "error", "is the unit of length right?"),
    ("A key misspelt", 'diameter = "8 mm"', 'diamter = "8 mm"', "error", "did you mean `diameter`?"),
    ("Axes swapped", 'where = {line = [["600 mm", "0 m", "160 mm"], ["600 mm", "120 mm", "160 mm"]]}',
     'where = {plane = "x", at = "160 mm"}', "error", "are the axes swapped?"),
    ("A bar outside the concrete", '["1.18 m", "42 mm", "135 mm"]', '["1.28 m", "42 mm", "135 mm"]', "error",
     "every point of a bar must lie in the mesh"),
    ("A cover that leaves no room: cm for mm", 'cover = "20 mm"', 'cover = "20 cm"', "error", "leaves no room"),
    ("More bars than a layer holds", 'bottom = "2 x 10 mm"', 'bottom = "5 x 10 mm"', "error", "use more layers"),
    ("A load on nothing", '["600 mm", "0 m", "160 mm"], ["600 mm", "120 mm", "160 mm"]',
     '["600 mm", "0 m", "250 mm"], ["600 mm", "120 mm", "250 mm"]', "error", "the model reaches from"),
    ("A support forgotten", 'fix = ["x", "y", "z"]', 'fix = ["y", "z"]', "warning", 'fix = ["x"]'),
    ("A body that can turn", 'where = {line = [["75 mm", "0 m", "0 m"], ["75 mm", "120 mm", "0 m"]]}',
     'where = {point = ["75 mm", "0 m", "0 m"]}', "warning", "turning about an axis"),
    ("No load at all", '[[motion]]\nname = "jack"\nwhere = {line = [["600 mm", "0 m", "160 mm"], ["600 mm", "120 mm", "160 '
     'mm"]]}\naxis = "z"\nvelocity = {value = "-0.1 m/s", over = "10 ms"}\n', "", "warning", "nothing loads the body"),
    ("A load that comes as a jump", 'velocity = {value = "-0.1 m/s", over = "10 ms"}', 'velocity = "-0.1 m/s"', "warning",
     "let it grow"),
    ("Loading too fast", 'value = "-0.1 m/s", over = "10 ms"', 'value = "-10 m/s", over = "10 ms"', "warning",
     "load more slowly"),
    ("Too much damping", 'mass_damping = "100 1/s"', 'mass_damping = "50000 1/s"', "warning", "outweighs inertia"),
    ("A run that is far too short", 'end_time = "50 ms"', 'end_time = "50 us"', "warning", "is the unit of `end_time` right?"),
    ("A mesh too coarse over the depth", "cells = [16, 4, 5]", "cells = [16, 2, 2]", "warning", "poorly resolved"),
    ("Elements too large for the bars", 'diameter = "8 mm"', 'diameter = "2 mm"', "warning", "use a finer mesh"),
    ("A gauge of a support that has another name", 'of = ["left", "right"]', 'of = ["left", "rigth"]', "error",
     "did you mean `right`?"),
    ("A bar as thick as a pipe", 'diameter = "8 mm"', 'diameter = "8 cm"', "warning", "is the unit right?"),
]

# The same of meshes from files: title, name and text of the file, what the user wrote, and the answer.
BLOCKS = """SetFactory("OpenCASCADE");
Box(1) = {0, 0, 0, 200, 80, 80};
Box(2) = {200, 0, 0, 200, 80, 80};
Coherence;
Mesh.MeshSizeMin = 40; Mesh.MeshSizeMax = 40;
"""
PIN = """SetFactory("OpenCASCADE");
Box(1) = {0, 0, 0, 200, 200, 60};
Cylinder(2) = {100, 100, 0, 0, 0, 60, 40};
Cylinder(3) = {100, 100, 0, 0, 0, 60, 40};
BooleanDifference(4) = { Volume{1}; Delete; }{ Volume{2}; Delete; };
MeshSize{ PointsOf{ Volume{4}; } } = 25;
MeshSize{ PointsOf{ Volume{3}; } } = 14;
"""
TETS = """*NODE
1, 0, 0, 0
2, 100, 0, 0
3, 0, 100, 0
4, 0, 0, 100
*ELEMENT, TYPE=C3D4, ELSET=concrete
1, 1, 2, 3, 4
"""
MESH_DECK = """mesh = {{file = "{file}", length_unit = "mm", separate = {separate}}}
concrete = [{{E = "33 GPa", f_t = "2.9 MPa", f_c = "38 MPa"}}]
support = [{{{where}, fix = ["x", "y", "z"]}}]
gravity = {{acceleration = {{value = "9.81 m/s2", over = "1 ms"}}}}
run = {{end_time = "10 ms"}}
"""
AT_THE_LEFT = 'where = {plane = "x", at = "0 m"}'
MESH_MISTAKES = [
    ("One number for a surface and a volume", "beam.geo", BLOCKS, "Physical Surface(1) = {1};\nPhysical Volume(1) = {1};\nPhysical Volume(2) = {2};",
     'where = {group = "1"}', "error", 'write "volume:1" or "surface:1"'),
    ("A volume forgotten in the groups", "beam.geo", BLOCKS, 'Physical Volume("concrete") = {1};', AT_THE_LEFT, "warning",
     "left out, as gmsh does when it saves"),
    ("A volume in two groups", "beam.geo", BLOCKS, 'Physical Volume("concrete") = {1, 2};\nPhysical Volume("left") = {1};',
     AT_THE_LEFT, "error", "physical volumes must not overlap"),
    ("A pin and its hole, meshed apart", "pin.geo", PIN, 'Physical Volume("block") = {4};\nPhysical Volume("pin") = {3};',
     AT_THE_LEFT, "error", "the sagitta"),
    ("Bodies tied in an Abaqus deck", "beam.inp", TETS, "*TIE, NAME=glue\nslave, master", AT_THE_LEFT, "warning", "*TIE is not obeyed"),
    ("Second-order tetrahedra", "beam.inp", TETS, "*ELEMENT, TYPE=C3D10\n2, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10", AT_THE_LEFT, "error",
     "linear tetrahedra"),
]

HEAD = """# Mistakes, and what the program says

<!-- Written by tools/mistakes.py from the program's own output; a test checks that it is current. -->

`fissura check CASE.toml` answers every one of these before anything is computed. Errors name file, line and column, and a run does not start;
warnings are printed by check, by the run, and into its log. Each row changes one place of a sound deck.
"""


def answers(program, deck, files=None):
    """The findings of `fissura check`, one per line."""
    with tempfile.TemporaryDirectory() as folder:
        for name, text in {"beam.toml": deck, **(files or {})}.items():
            (Path(folder) / name).write_text(text, encoding="utf-8")
        done = subprocess.run([program, "check", "beam.toml"], cwd=folder, capture_output=True, text=True, check=False)
    lines = done.stderr.splitlines() if done.returncode else done.stdout.splitlines()
    kind = "error" if done.returncode else "warning"
    told = [line for line in lines if (": error: " in line if kind == "error" else line.startswith("warning"))]
    return kind, [re.sub(r"^warning\s+", "warning: ", line).replace(f"{Path(folder).resolve()}/", "") for line in told]


def main():
    program, update = str(Path(sys.argv[1]).resolve()), "--update" in sys.argv
    text, faults = [HEAD], []
    kind, told = answers(program, SOUND)
    told = [line for line in told if "over the height" not in line]  # it has five elements there, to be quick
    if kind == "error" or told:
        faults.append(f"the sound deck is not: {told}")
    for title, old, new, wanted, words in MISTAKES:
        if SOUND.count(old) != 1:
            faults.append(f"{title}: `{old}` stands {SOUND.count(old)} times in the sound deck")
            continue
        kind, told = answers(program, SOUND.replace(old, new))
        fitting = [line for line in told if words in line]
        if kind != wanted or not fitting:
            faults.append(f"{title}: expected a {wanted} with \"{words}\", got {kind}: {told}")
            continue
        shown = new.removesuffix("\ncells") if new else "(left out)"  # that word only tells one place of the deck from another
        text.append(f"\n## {title}\n\n```toml\n{shown}\n```\n\n```\n{fitting[0]}\n```\n")
    for title, name, before, lines, where, wanted, words in MESH_MISTAKES:
        deck = MESH_DECK.format(file=name, where=where, separate="true" if name == "pin.geo" else "false")
        kind, told = answers(program, deck, {name: f"{before}{lines}\n"})
        fitting = [line for line in told if words in line]
        if kind != wanted or not fitting:
            faults.append(f"{title}: expected a {wanted} with \"{words}\", got {kind}: {told}")
            continue
        case = "" if where == AT_THE_LEFT else f"\n\n```toml\n{where}\n```"
        text.append(f"\n## {title}\n\nIn `{name}`:\n\n```\n{lines}\n```{case}\n\n```\n{fitting[0]}\n```\n")
    page = "".join(text)
    if update and not faults:
        PAGE.write_text(page, encoding="utf-8")
    elif not faults and PAGE.read_text(encoding="utf-8") != page:
        faults.append(f"{PAGE} is not what the program says: run tools/mistakes.py PROGRAM --update")
    print("\n".join(faults) if faults else f"{len(MISTAKES) + len(MESH_MISTAKES)} mistakes are answered")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
