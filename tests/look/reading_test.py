#!/usr/bin/python3
"""What a run leaves behind, read by others: VTK (what ParaView reads with) and meshio. Each test states its requirement.

    reading_test.py build/fissura
"""
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "tools"), str(Path(__file__).resolve().parent)]
import fissura_io as io
from small_run import make_run

try:
    import meshio
except ImportError:
    meshio = None
try:
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkCommonCore import vtkFileOutputWindow, vtkOutputWindow
    from vtkmodules.vtkFiltersCore import vtkTubeFilter
    from vtkmodules.vtkIOXML import vtkXMLPolyDataReader, vtkXMLUnstructuredGridReader
except ImportError:
    vtkTubeFilter = None

PROGRAM = str(Path(sys.argv.pop(1)).resolve()) if len(sys.argv) > 1 else str(ROOT / "build/fissura")


class Frames(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.scratch = tempfile.TemporaryDirectory()
        cls.folder = Path(cls.scratch.name)
        cls.run_folder = make_run(PROGRAM, cls.folder)
        cls.summary = io.Run(cls.run_folder).summary
        assert cls.summary["joints_cracked"] > 0

    @classmethod
    def tearDownClass(cls):
        cls.scratch.cleanup()

    def moments(self, kind):
        """(time, file) of every frame of a list."""
        return [(time, files[0]) for time, files in io.read_pvd(self.run_folder / f"{kind}.pvd")]

    def vtk(self, file):
        """The frame as VTK reads it, which must have nothing to complain of."""
        said = self.folder / "vtk.txt"
        window = vtkFileOutputWindow()
        window.SetFileName(str(said))
        vtkOutputWindow.SetInstance(window)
        reader = vtkXMLPolyDataReader() if file.suffix == ".vtp" else vtkXMLUnstructuredGridReader()
        reader.SetFileName(str(file))
        reader.Update()
        self.complaints = lambda: said.read_text() if said.exists() else ""
        self.assertEqual(self.complaints(), "", file)
        return reader.GetOutput()

    def test_every_list_names_frames(self):
        """A run has lists of its body, cracks, bars, surface and rigid bodies, of as many frames each, and no file beside them."""
        kinds = {"fields": ".vtu", "cracks": ".vtu", "bars": ".vtp", "surface": ".vtp", "rigid": ".vtu"}
        files = set()
        for kind, end in kinds.items():
            moments = self.moments(kind)
            self.assertEqual(len(moments), len(self.moments("fields")), kind)
            self.assertEqual({file.suffix for _, file in moments}, {end})
            files |= {file for _, file in moments}
        self.assertEqual(files, set((self.run_folder / "frames").iterdir()))

    @unittest.skipIf(meshio is None, "no meshio here (apt: python3-meshio)")
    def test_meshio_reads_every_frame(self):
        """meshio reads every frame of tets, cracks and rigid bodies, the first one without cracks too, with the same numbers and
        the time."""
        for kind in ("fields", "cracks", "rigid"):
            for time, file in self.moments(kind):
                read, own = meshio.read(file), io.read_frame(file)
                np.testing.assert_array_equal(read.points, own.points)
                self.assertEqual(sum(len(block.data) for block in read.cells), len(own.types), file)
                for name, values in own.cell_data.items():
                    np.testing.assert_array_equal(np.squeeze(read.cell_data[name][0]), np.squeeze(values), name)
                for name, values in own.point_data.items():
                    np.testing.assert_array_equal(read.point_data[name], values, name)
                self.assertEqual(float(np.squeeze(read.field_data["TimeValue"])), time)

    @unittest.skipIf(vtkTubeFilter is None, "no VTK here (apt: python3-vtk9)")
    def test_vtk_reads_every_frame(self):
        """VTK reads every frame without a word, with the same numbers, units and the time of the list."""
        for kind in ("fields", "cracks", "bars", "surface", "rigid"):
            for time, file in self.moments(kind):
                read, own = self.vtk(file), io.read_frame(file)
                np.testing.assert_array_equal(vtk_to_numpy(read.GetPoints().GetData()), own.points)
                self.assertEqual(read.GetNumberOfCells(), len(own.types))
                for data, arrays in ((read.GetPointData(), own.point_data), (read.GetCellData(), own.cell_data)):
                    self.assertEqual({data.GetArrayName(i) for i in range(data.GetNumberOfArrays())}, set(arrays))
                    for name, values in arrays.items():
                        np.testing.assert_array_equal(vtk_to_numpy(data.GetArray(name)), values, name)
                self.assertEqual(read.GetFieldData().GetArray("TimeValue").GetValue(0), time)
                self.assertEqual(own.time, time)

    @unittest.skipIf(vtkTubeFilter is None, "no VTK here (apt: python3-vtk9)")
    def test_bars_are_tubes_at_once(self):
        """The Tube filter makes one tube of each bar, of the bar's own thickness, without a word; names of bars and steels are there."""
        for _, file in self.moments("bars"):
            bars = self.vtk(file)
            self.assertEqual(bars.GetNumberOfLines(), 3)  # two copies and one
            self.assertEqual(bars.GetNumberOfVerts(), 0)
            bars.GetPointData().SetActiveScalars("radius")
            tube = vtkTubeFilter()
            tube.SetInputData(bars)
            tube.SetNumberOfSides(8)
            tube.SetVaryRadiusToVaryRadiusByAbsoluteScalar()
            tube.Update()
            self.assertEqual(self.complaints(), "")
            made = tube.GetOutput()
            points = vtk_to_numpy(made.GetPoints().GetData())
            for (y, z), radius in (((0.04, 0.03), 6e-3), ((0.065, 0.03), 6e-3), ((0.05, 0.07), 4e-3)):
                away = np.hypot(points[:, 1] - y, points[:, 2] - z)
                own = points[np.abs(away - radius) < 1e-6]
                self.assertAlmostEqual(np.ptp(own[:, 0]), 0.4, places=6)
            self.assertEqual(set(vtk_to_numpy(made.GetCellData().GetArray("bar"))), {0, 1})
            names = bars.GetFieldData().GetAbstractArray("bar_names")
            self.assertEqual([names.GetValue(i) for i in range(names.GetNumberOfValues())], ["lower \u00e9", "upper"])
            self.assertEqual(io.read_frame(file).names["steel_names"], ["B500", "B500"])

    def test_bars_hold_elements_and_joints(self):
        """Bars have two points to a bar element with its stress at both, and the bar joint between two elements at the two points
        beside it, at one place; cells say diameter, bar and copy."""
        grid = io.read_frame(self.moments("bars")[-1][1])
        ends, line = grid.bar_elements()
        self.assertEqual(len(ends), self.summary["bar_elements"])
        np.testing.assert_array_equal(grid.point_data["stress"][ends[:, 0]], grid.point_data["stress"][ends[:, 1]])
        joint = grid.point_data["joint"]
        numbers, first, count = np.unique(joint[joint >= 0], return_index=True, return_counts=True)
        np.testing.assert_array_equal(numbers, np.arange(self.summary["bar_joints"]))
        np.testing.assert_array_equal(count, 2)
        for number in numbers:
            a, b = np.flatnonzero(joint == number)
            self.assertEqual(b, a + 1)
            np.testing.assert_array_equal(grid.points[a], grid.points[b])
        self.assertGreater(np.abs(grid.point_data["slip"]).max(), 0)
        np.testing.assert_array_equal(grid.cell_data["bar"], [0, 0, 1])
        np.testing.assert_array_equal(grid.cell_data["copy"], [0, 1, 0])
        np.testing.assert_allclose(grid.cell_data["diameter"], [0.012, 0.012, 0.008], rtol=1e-6)

    def test_surface_is_the_body_from_outside_and_its_cracks(self):
        """The surface is closed with the outer area of the body; cracked joints add two faces each, which look away from each other."""
        for (_, file), (_, cracks) in zip(self.moments("surface"), self.moments("cracks")):
            grid = io.read_frame(file)
            triangles, which = grid.cells(io.TRIANGLE)
            corners = grid.points[triangles]
            areas = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]) / 2
            crack = grid.cell_data["crack"][which] > 0
            self.assertAlmostEqual(np.linalg.norm(areas[~crack], axis=1).sum(), 2 * (0.1 * 0.1 + 2 * 0.4 * 0.1), places=9)
            self.assertAlmostEqual((corners[~crack].mean(axis=1) * areas[~crack]).sum() / 3, 0.4 * 0.1 * 0.1, places=9)
            np.testing.assert_allclose(areas[crack][0::2], -areas[crack][1::2], atol=1e-15)
            self.assertFalse((grid.cell_data["damage"][which][~crack] > 0).any())
        self.assertEqual(crack.sum(), 2 * self.summary["joints_cracked"])
        own = io.read_frame(cracks)
        self.assertAlmostEqual(grid.cell_data["opening"].max(), own.cell_data["opening"].max())
        # Both faces move with their own tets: apart by the opening of the joint.
        widest = np.flatnonzero(crack)[np.argmax(grid.cell_data["opening"][which][crack])] // 1
        pair = widest - (np.flatnonzero(crack).tolist().index(widest) % 2)
        moved = grid.points + grid.point_data["displacement"]
        jump = moved[triangles[pair + 1]].mean(axis=0) - moved[triangles[pair]].mean(axis=0)
        normal = areas[pair] / np.linalg.norm(areas[pair])
        self.assertAlmostEqual(jump @ normal, grid.cell_data["opening"][which][pair], delta=2e-7)

    def test_surface_can_be_left_out(self):
        """`[output] surface = false` writes no surface."""
        done = subprocess.run([PROGRAM, "run", str(self.folder / "tie.toml"), "--quiet", "--no-report", "--until", "1e-5", "--out",
                               str(self.folder / "plain"), "--set", "output.surface=false"], capture_output=True, text=True, timeout=300)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertFalse((self.folder / "plain/surface.pvd").exists())
        self.assertFalse(any(f.name.startswith("surface") for f in (self.folder / "plain/frames").iterdir()))

    def test_reference_names_every_field(self):
        """docs/reference/outputs.md names every array of every frame, on points or cells, with its unit, and no other."""
        text = (ROOT / "docs/reference/outputs.md").read_text()
        for kind in ("fields", "cracks", "bars", "surface", "rigid"):
            table = re.search(rf"^`{kind}`:.*?\n\n(\|.*?)\n\n", text, re.DOTALL | re.MULTILINE)[1]
            written = {}
            for row in table.split("\n")[2:]:
                names, place, units = (cell.strip() for cell in row.split("|")[1:4])
                names = re.findall(r"`(\w+)`", names)
                units = [unit.strip() for unit in units.split(",")]
                for i, name in enumerate(names):
                    written[place, name] = units[i if len(units) > 1 else 0]
            grid = io.read_frame(self.moments(kind)[-1][1])
            found = {(place, name): grid.units.get(name, "-") for place, data in (("points", grid.point_data), ("cells", grid.cell_data))
                     for name in data}
            self.assertEqual(found, written, kind)


if __name__ == "__main__":
    unittest.main()
