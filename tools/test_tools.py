#!/usr/bin/python3
"""Tests of the tools: each states its requirement. Run: python3 tools/test_tools.py"""
import json
import struct
import subprocess
import sys
import tempfile
import unittest
import zlib
from pathlib import Path

import numpy as np

TOOLS = Path(__file__).resolve().parent
sys.path.insert(0, str(TOOLS))
import check_arrows
import check_commands
import check_links
import fissura_io as io
import figure_parts
import picture

VTK_NAME = {np.dtype("f4"): "Float32", np.dtype("f8"): "Float64", np.dtype("u1"): "UInt8", np.dtype("i4"): "Int32",
            np.dtype("i8"): "Int64"}


def packed(values, block=64):
    raw = np.ascontiguousarray(values).tobytes()
    blocks = [zlib.compress(raw[i:i + block]) for i in range(0, len(raw), block)]
    sizes = [len(b) for b in blocks]
    return struct.pack(f"<{3 + len(sizes)}Q", len(sizes), block, len(raw) % block, *sizes) + b"".join(blocks)


def write_frame(path, points, cells, cell_type, point_data=None, cell_data=None):
    """Cells of one type, polylines as poly data; data: name -> (values, unit)."""
    poly = cell_type == io.POLY_LINE
    cells = np.atleast_2d(np.asarray(cells, dtype="i8")) if poly else np.asarray(cells, dtype="i8").reshape(-1, io.CORNERS[cell_type])
    data, body = b"", ""
    kind, part, count = ("PolyData", "Lines", "NumberOfLines") if poly else ("UnstructuredGrid", "Cells", "NumberOfCells")
    sections = {
        "PointData": point_data or {},
        "CellData": cell_data or {},
        "Points": {"Points": (np.asarray(points, dtype="f8").reshape(-1, 3), "")},
        part: {"connectivity": (cells.ravel(), ""), "offsets": (np.arange(1, len(cells) + 1, dtype="i8") * cells.shape[1], "")},
    }
    if not poly:
        sections[part]["types"] = (np.full(len(cells), cell_type, dtype="u1"), "")
    for section, arrays in sections.items():
        body += f"<{section}>"
        for name, (values, unit) in arrays.items():
            key = f'<InformationKey name="UNITS_LABEL" location="vtkDataArray">{unit}</InformationKey>' if unit else ""
            components = values.shape[1] if values.ndim > 1 else 1
            body += (f'<DataArray type="{VTK_NAME[values.dtype]}" Name="{name}" NumberOfComponents="{components}" '
                     f'format="appended" offset="{len(data)}">{key}</DataArray>')
            data += packed(values)
        body += f"</{section}>"
    header = (f'<?xml version="1.0"?><VTKFile type="{kind}" version="1.0" byte_order="LittleEndian" '
              f'header_type="UInt64" compressor="vtkZLibDataCompressor"><{kind}>'
              f'<Piece NumberOfPoints="{len(points)}" {count}="{len(cells)}">{body}</Piece></{kind}>'
              '<AppendedData encoding="raw">_')
    Path(path).write_bytes(header.encode() + data + b"</AppendedData></VTKFile>")


def write_pvd(path, entries):
    rows = "".join(f'<DataSet timestep="{t}" part="{p}" file="{f}"/>' for t, p, f in entries)
    Path(path).write_text(f'<VTKFile type="Collection"><Collection>{rows}</Collection></VTKFile>')


def box_of_tets(cells, size):
    """Kuhn tets of a box, each with its own four points."""
    corner = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1]])
    kuhn = np.array([[0, 1, 2, 6], [0, 2, 3, 6], [0, 3, 7, 6], [0, 7, 4, 6], [0, 4, 5, 6], [0, 5, 1, 6]])
    origins = np.stack(np.meshgrid(*map(range, cells), indexing="ij"), -1).reshape(-1, 3)
    nodes = (origins[:, None, None, :] + corner[kuhn][None]).reshape(-1, 3)
    return nodes * (np.array(size) / np.array(cells)), np.arange(len(nodes)).reshape(-1, 4)


def make_run(folder, cells=(12, 2, 3)):
    """A bent, cracked beam of 3.0 x 0.15 x 0.25 m with one bar, written as a run folder."""
    folder = Path(folder)
    size = (3.0, 0.15, 0.25)
    points, tets = box_of_tets(cells, size)

    def bend(p):
        u = np.zeros_like(p)
        u[:, 2] = -0.02 * np.sin(np.pi * p[:, 0] / size[0])
        return u

    write_frame(folder / "fields_0.vtu", points, tets, io.TETRAHEDRON, {"displacement": (bend(points), "m")},
              {"group": (np.zeros(len(tets), "i4"), "")})
    vertical = np.array([[[x, 0, 0], [x, 0.15, 0], [x, 0, 0.17]] for x in (1.0, 1.25, 1.5, 1.75)])
    opening = np.array([2e-4, 6e-4, 9e-4, 1e-4])
    write_frame(folder / "cracks_0.vtu", vertical.reshape(-1, 3), np.arange(12).reshape(-1, 3), io.TRIANGLE,
              {"displacement": (bend(vertical.reshape(-1, 3)), "m")},
              {"opening": (opening, "m"), "damage": (np.array([1, 1, 1, 0.01]), "")})
    ends = np.repeat(np.linspace(0, 3, 13), 2)[1:-1]  # of 12 bar elements, two to each
    bar = np.stack([ends, np.full(24, 0.075), np.full(24, 0.04)], axis=1)
    stress = 4e8 * np.sin(np.pi * ((np.arange(12) + 0.5) / 12))
    write_frame(folder / "bars_0.vtp", bar, np.arange(24), io.POLY_LINE,
                {"displacement": (bend(bar), "m"), "stress": (np.repeat(stress, 2), "Pa")}, {"bar": (np.zeros(1, "i4"), "")})
    for kind, end in (("fields", "vtu"), ("cracks", "vtu"), ("bars", "vtp")):
        write_pvd(folder / f"{kind}.pvd", [(0.5, 0, f"{kind}_0.{end}")])
    (folder / "history.csv").write_text('time [s],deflection [m],load [N],"strain, mean [-]"\n0,0,0,0\n'
                                        "0.1,0.002,50000,0.001\n0.2,0.02,64300.5,0.004\n0.3,0.03,3e4,0.005\n0.4,0.0")
    (folder / "run.json").write_text(json.dumps({"status": "complete"}))
    return points, tets, stress


class WithFolder(unittest.TestCase):
    def setUp(self):
        self.temporary = tempfile.TemporaryDirectory()
        self.addCleanup(self.temporary.cleanup)
        self.folder = Path(self.temporary.name)


class FissuraIo(WithFolder):
    def test_vtu_reads_back(self):
        """Requirement: points, cells, fields and units of a VTU file come back exactly, over several blocks."""
        points, tets, stress = make_run(self.folder)
        grid = io.read_frame(self.folder / "fields_0.vtu")
        np.testing.assert_array_equal(grid.points, points)
        np.testing.assert_array_equal(grid.cells(io.TETRAHEDRON)[0], tets)
        self.assertEqual(grid.cells(io.LINE)[0].shape, (0, 2))
        bars = io.read_frame(self.folder / "bars_0.vtp")
        ends, line = bars.bar_elements()
        np.testing.assert_array_equal(bars.point_data["stress"][ends[:, 0]], stress)
        np.testing.assert_array_equal(line, np.zeros(12))
        self.assertEqual(bars.units["stress"], "Pa")

    def test_empty_grid(self):
        """Requirement: a frame without cells (no crack yet) is read as empty arrays."""
        write_frame(self.folder / "e.vtu", np.zeros((0, 3)), [], io.TRIANGLE, None, {"opening": (np.zeros(0), "m")})
        self.assertEqual(io.read_frame(self.folder / "e.vtu").cell_data["opening"].size, 0)

    def test_damaged_file_is_refused(self):
        """Requirement: a file of another kind is refused by name."""
        (self.folder / "x.vtu").write_text("<VTKFile/>")
        with self.assertRaisesRegex(io.BadFile, "x.vtu"):
            io.read_frame(self.folder / "x.vtu")

    def test_history_has_units_and_ignores_the_unfinished_line(self):
        """Requirement: columns are found with and without unit, and a row that is still being written is left out."""
        make_run(self.folder)
        history = io.Run(self.folder).history
        self.assertEqual(history["load"].unit, "N")
        np.testing.assert_array_equal(history["load [N]"].values, [0, 50000, 64300.5, 30000])
        self.assertEqual(history["strain, mean"].unit, "-")
        with self.assertRaisesRegex(io.BadFile, "there are: time, deflection, load"):
            history["lod"]

    def test_frames(self):
        """Requirement: the last frame and the frame nearest to a time are found, with their parts in order."""
        write_pvd(self.folder / "bars.pvd", [(0, 0, "a"), (1, 1, "c"), (1, 0, "b")])
        run = io.Run(self.folder)
        self.assertEqual(run.frame("bars"), (1.0, [self.folder / "b", self.folder / "c"]))
        self.assertEqual(run.frame("bars", 0.4), (0.0, [self.folder / "a"]))
        self.assertEqual(run.frame("cracks"), (None, []))


class Picture(WithFolder):
    def test_outer_faces_of_a_box(self):
        """Requirement: the surface of a box is closed, points outwards and has the box's area."""
        points, _, _ = make_run(self.folder)
        faces, _ = picture.outer_faces(io.read_frame(self.folder / "fields_0.vtu"))
        corners = points[faces]
        areas = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]) / 2
        self.assertAlmostEqual(np.linalg.norm(areas, axis=1).sum(), 2 * (3 * 0.15 + 3 * 0.25 + 0.15 * 0.25), places=12)
        np.testing.assert_allclose(areas.sum(axis=0), 0, atol=1e-14)
        volume = (corners.mean(axis=1) * areas).sum() / 3
        self.assertAlmostEqual(volume, 3 * 0.15 * 0.25, places=12)

    def test_scene_shows_damaged_joints_only(self):
        """Requirement: joints below the damage limit are left out; openings are in mm and stresses in MPa."""
        make_run(self.folder)
        moment, scene = picture.make_scene(io.Run(self.folder), "last", "10", 0.2)
        self.assertEqual(moment, 0.5)
        np.testing.assert_allclose(scene.value, [0.2, 0.6, 0.9])
        self.assertLess(scene.stress.max(), 400)
        self.assertAlmostEqual(scene.cracks[2, 0, 2], -0.2, places=12)

    def test_hairlines_are_left_out_beside_wide_cracks(self):
        """Requirement: below 0.02 mm nothing is drawn where the widest crack is above 0.2 mm, unless all are asked for."""
        fine, coarse = np.array([0.005, 0.019, 0.1]), np.array([0.005, 0.019, 0.021, 0.3])
        np.testing.assert_array_equal(picture.wide_enough(fine, "auto"), [True, True, True])
        np.testing.assert_array_equal(picture.wide_enough(coarse, "auto"), [False, False, True, True])
        np.testing.assert_array_equal(picture.wide_enough(coarse, "0"), [True, True, True, True])

    def test_pieces_in_flight(self):
        """Requirement: fragments in flight do not shrink the factor of the displacements unless they would leave the picture; the
        room between them is not drawn as a crack."""
        sizes = np.full(1000, 0.001)
        self.assertEqual(picture.natural_warp(sizes, 1.0), 50)
        sizes[0] = 0.05
        self.assertEqual(picture.natural_warp(sizes, 1.0), 5)
        self.assertEqual(picture.natural_warp(np.zeros(3), 1.0), 1)
        triangle = np.array([[[0.0, 0, 0], [0.1, 0, 0], [0, 0.1, 0]]])
        for drawn, opening, gap in ((triangle, 0.01, False), (triangle, 0.1, True), (2 * triangle, 0.01, True)):
            self.assertEqual(picture.is_gap(triangle, drawn, np.array([opening]))[0], gap)

    def test_several_scenes_in_one_picture(self):
        """Requirement: the figures' pictures of cracks, one below the other, are drawn from the scenes that a run gives."""
        make_run(self.folder)
        scenes = [picture.make_scene(io.Run(self.folder), "last", "10", 0.2)[1] for _ in range(2)]
        out = self.folder / "both.png"
        figure_parts.crack_pictures([figure_parts.wide(scenes[0], 0.5), scenes[1]], ["wide", "all"], "two", out)
        np.testing.assert_allclose(scenes[0].value, [0.6, 0.9])
        self.assertEqual(out.read_bytes()[:4], b"\x89PNG")

    def test_title_is_that_of_the_case(self):
        """Requirement: pictures are headed by the title of the case, or by the folder's name where there is none."""
        make_run(self.folder)
        self.assertEqual(io.Run(self.folder).title, self.folder.resolve().name)
        (self.folder / "run.json").write_text('{"title": "a beam"}')
        self.assertEqual(io.Run(self.folder).title, "a beam")

    def test_side_view_of_a_beam(self):
        """Requirement: from the side, the long axis runs to the right and the up axis upwards, never mirrored."""
        points, _ = box_of_tets((4, 1, 1), (3.0, 0.15, 0.25))
        camera = picture.side_camera(points, up=2)
        np.testing.assert_array_equal(camera, [[1, 0, 0], [0, 0, 1], [0, -1, 0]])
        for basis in (camera, picture.oblique_camera(camera)):
            np.testing.assert_allclose(basis @ basis.T, np.eye(3), atol=1e-12)
            self.assertAlmostEqual(np.linalg.det(basis), 1)

    def test_writes_a_picture(self):
        """Requirement: the command writes a PNG in which the colours of the cracks occur, and says where."""
        make_run(self.folder)
        out = self.folder / "crack.png"
        said = subprocess.run([sys.executable, TOOLS / "picture.py", self.folder, "-o", out], check=True,
                              capture_output=True, text=True).stdout
        self.assertIn(str(out), said)
        import matplotlib.pyplot as plt
        pixels = plt.imread(out)[:, :, :3]
        colourful = np.ptp(pixels, axis=2) > 0.3
        self.assertGreater(colourful[: pixels.shape[0] * 3 // 4].sum(), 200)

    def test_missing_run(self):
        """Requirement: a folder that is no run gives one line and exit code 2, not a traceback."""
        done = subprocess.run([sys.executable, TOOLS / "picture.py", self.folder / "no", "-o", "x.png"],
                              capture_output=True, text=True)
        self.assertEqual(done.returncode, 2)
        self.assertRegex(done.stderr, r"^picture: .*no such run folder\n$")


class PlotHistory(WithFolder):
    def test_peak_and_curve(self):
        """Requirement: the command writes the curve and prints the peak with engineering units and its place."""
        make_run(self.folder)
        out = self.folder / "curve.png"
        said = subprocess.run([sys.executable, TOOLS / "plot_history.py", self.folder, "--x", "deflection", "--y",
                               "load", "--peak", "-o", out], check=True, capture_output=True, text=True).stdout
        self.assertIn("peak load: 64.3 kN at deflection 20 mm", said)
        self.assertEqual(out.read_bytes()[:4], b"\x89PNG")


class CheckArrows(WithFolder):
    LINES = "fissura_module(core LIBRARIES fmt::fmt)\nfissura_module(mesh NEEDS core LIBRARIES gmsh)\n" \
            "fissura_module(laws NEEDS core)\n"

    def house(self, lines=LINES, mesh='#include "fissura/core/vec3.hpp"\n', rows=("core", "mesh", "laws")):
        source = self.folder / "src" / "fissura"
        for name in ("core", "mesh", "laws"):
            (source / name).mkdir(parents=True, exist_ok=True)
        (source / "CMakeLists.txt").write_text(lines)
        (source / "core" / "vec3.hpp").write_text("")
        (source / "laws" / "law.hpp").write_text("")
        (source / "mesh" / "mesh.cpp").write_text(mesh)
        (self.folder / "docs").mkdir(exist_ok=True)
        (self.folder / "docs" / "architecture.md").write_text("".join(f"| `{r}` | x |\n" for r in rows))
        return check_arrows.check(self.folder)

    def test_accepts_a_sound_house(self):
        """Requirement: includes along the declared arrows are accepted."""
        self.assertEqual(self.house(), [])

    def test_finds_wrong_includes(self):
        """Requirement: an include against the arrows, or of a header that is not there, is named by file and line."""
        wrong = self.house(mesh='\n#include "fissura/laws/law.hpp"\n#include "fissura/core/no.hpp"\n')
        self.assertEqual(wrong, ["mesh/mesh.cpp:2: mesh -> laws (laws/law.hpp), but mesh does not need laws",
                                 "mesh/mesh.cpp:3: there is no fissura/core/no.hpp"])

    def test_finds_needs_against_the_order(self):
        """Requirement: a module that needs one below its own line, or none at all, is named."""
        wrong = self.house(lines=self.LINES.replace("mesh NEEDS core", "mesh NEEDS core laws nothing"))
        self.assertEqual(wrong, ["CMakeLists.txt: mesh needs laws, which does not lie above it",
                                 "CMakeLists.txt: mesh needs nothing, which is no module"])

    def test_every_module_is_explained(self):
        """Requirement: a module without a row in the architecture page is named."""
        self.assertEqual(self.house(rows=("core", "mesh")), ["laws/: no row in docs/architecture.md"])


class CheckLinks(WithFolder):
    def test_finds_broken_links(self):
        """Requirement: a relative link to a missing file is named by file and line; code and the web are left alone."""
        (self.folder / "a.md").write_text("[b](b.md#x) [web](https://example.org)\n`[c](c.md)`\n[d](d.md)\n"
                                          "```\n[e](e.md)\n```\n")
        (self.folder / "b.md").write_text("")
        self.assertEqual(list(check_links.broken_links(self.folder)), ["a.md:3: d.md"])


class CheckCommands(WithFolder):
    # A program that answers --help as CLI11 does, and nothing else.
    PROGRAM = """#!/bin/sh
case "$1" in
  run) printf '  -h,--help   Help\\n  --out TEXT  Folder\\n  --force  Overwrite\\n';;
  plot) printf '  --y TEXT ... REQUIRED  Column\\n  --field TEXT:{opening,damage}\\n     Colour\\n  -o,--out TEXT  File\\n';;
  new) printf '  template TEXT REQUIRED  One of: beam, tie\\n\\nOptions:\\n  -h,--help  Help\\n';;
  check) echo "$2:1:1: error: $4" >&2; exit 2;;
  *) printf '  --version  Version\\n\\nSubcommands:\\n  run   Run\\n  plot  Draw\\n  new   Write\\n';;
esac
"""
    USAGE = "```\nfissura run CASE [--out DIR] [--force]\nfissura plot RUN --y COLUMN... [--field opening|damage] [-o FILE]\nfissura new NAME\n```\n"

    def untrue(self, page, usage=USAGE):
        program = self.folder / "fissura"
        program.write_text(self.PROGRAM)
        program.chmod(0o755)
        (self.folder / "Makefile").write_text("demo: build\n\tbuild/fissura\n")
        (self.folder / "examples" / "a").mkdir(parents=True, exist_ok=True)
        (self.folder / "examples" / "a" / "case.toml").write_text('gauge = [{name = "load"}]\n')
        (self.folder / "docs" / "reference").mkdir(parents=True, exist_ok=True)
        (self.folder / "docs" / "reference" / "cli.md").write_text(usage)
        (self.folder / "page.md").write_text(page)
        checker = check_commands.Checker(str(program), self.folder)
        return [u.split(": ", 1)[1] if u.startswith("page.md") else u for u in check_commands.untrue(checker, self.folder)]

    def test_true_commands_pass(self):
        """Requirement: commands that the program knows pass, with variables before and comments after them, over two lines, in the text."""
        self.assertEqual(self.untrue("```sh\nA=1 build/fissura run examples/a/case.toml --out runs/a \\\n  --force  # over it\n"
                                     "build/fissura plot runs/a --y load --y energy_kinetic -o x.png\n```\n`fissura new tie d`, `make demo`\n"), [])

    def test_untrue_commands_are_named(self):
        """Requirement: an unknown subcommand, option, choice, template, target, deck, column or tool is named."""
        for command, what in (("fissura fly", "there is no subcommand fly"), ("fissura run c.toml --fast", "run has no option --fast"),
                              ("fissura plot r --y a --field rust", "--field takes damage, opening, not rust"),
                              ("fissura new bridge d", "there is no template bridge"), ("make tea", "the Makefile has no target tea"),
                              ("fissura run examples/b/case.toml", "examples/b/case.toml does not exist"),
                              ("tools/x.py --fast", "tools/x.py does not exist")):
            self.assertEqual(self.untrue(f"Type `{command}`.\n"), [f"{command}: {what}"])
        self.assertEqual(self.untrue("```sh\nfissura run examples/a/case.toml --out r\nfissura plot r --y lod\n```\n"),
                         ["fissura plot r --y lod: a has no gauge lod"])

    def test_decks_are_read_with_the_changes_that_stand_there(self):
        """Requirement: with --decks a deck that `fissura check` refuses with the changes of the page is named."""
        self.untrue("")
        checker = check_commands.Checker(str(self.folder / "fissura"), self.folder, decks=True)
        checker.help.options["run"]["--set"] = set()
        self.assertEqual(list(checker.page("Type `fissura run examples/a/case.toml --set x=1`.")),
                         [(1, "fissura run examples/a/case.toml --set x=1: examples/a/case.toml:1:1: error: x=1")])

    def test_the_page_names_every_option(self):
        """Requirement: an option of the program that the page of the command line leaves out is named."""
        self.assertEqual(self.untrue("", self.USAGE.replace(" [--force]", "")), ["docs/reference/cli.md:1: `fissura run --force` is missing"])


if __name__ == "__main__":
    unittest.main()
