"""Reads what a run leaves behind: VTU frames, PVD lists, history.csv and run.json. Needs numpy only, no VTK.

    run = Run("runs/demo")
    run.history["load"].values, run.history["load"].unit
    frame = read_vtu(run.frame("cracks", time="last")[0])
    frame.cell_data["opening"], frame.units["opening"]
"""
import csv
import json
import re
import sys
import xml.etree.ElementTree as ElementTree
import zlib
from collections import namedtuple
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

TYPES = {"Float32": "f4", "Float64": "f8", "UInt8": "u1", "Int32": "i4", "Int64": "i8"}
VERTEX, LINE, TRIANGLE, TETRAHEDRON = 1, 3, 5, 10
CORNERS = {VERTEX: 1, LINE: 2, TRIANGLE: 3, TETRAHEDRON: 4}

Column = namedtuple("Column", "name unit values")


def refuse(tool, error):
    """Ends a tool as the program ends: with 2 for bad input, 3 where files cannot be read or written."""
    print(f"{tool}: {error}", file=sys.stderr)
    sys.exit(3 if isinstance(error, OSError) else 2)


class BadFile(Exception):
    """A file that is not what its name says; the text names the file."""


@dataclass
class Grid:
    points: np.ndarray
    connectivity: np.ndarray
    offsets: np.ndarray
    types: np.ndarray
    point_data: dict = field(default_factory=dict)
    cell_data: dict = field(default_factory=dict)
    units: dict = field(default_factory=dict)

    def cells(self, cell_type):
        """Corner indices of all cells of one type, one row each, and the rows' numbers among all cells."""
        which = np.flatnonzero(self.types == cell_type)
        corners = CORNERS[cell_type]
        begin = self.offsets[which] - corners
        return self.connectivity[begin[:, None] + np.arange(corners)], which


def _inflate(data, begin, path):
    """One array: block count, block size, size of a last partial block, packed sizes, blocks (all UInt64)."""
    blocks, full, last = (int(n) for n in np.frombuffer(data, "<u8", 3, begin))
    packed = np.frombuffer(data, "<u8", blocks, begin + 24)
    at = begin + 8 * (3 + blocks)
    parts = []
    for i, size in enumerate(packed):
        parts.append(zlib.decompress(data[at:at + int(size)]))
        if len(parts[-1]) != (last if i == blocks - 1 and last else full):
            raise BadFile(f"{path}: a block has the wrong length")
        at += int(size)
    return b"".join(parts)


def read_vtu(path):
    """Reads an unstructured grid with appended raw data in zlib blocks, as Fissura writes it."""
    data = Path(path).read_bytes()
    mark = re.search(rb'<AppendedData encoding="raw">\s*_', data)
    if not mark:
        raise BadFile(f"{path}: not a VTU file with raw appended data")
    root = ElementTree.fromstring(data[:mark.end() - 1] + b"</AppendedData></VTKFile>")
    if root.get("compressor") != "vtkZLibDataCompressor" or root.get("header_type") != "UInt64":
        raise BadFile(f"{path}: only zlib blocks with UInt64 headers are read")
    units = {}

    def arrays(section):
        found = {}
        node = root.find(f".//Piece/{section}")
        for a in [] if node is None else node.findall("DataArray"):
            raw = _inflate(data, mark.end() + int(a.get("offset")), path)
            values = np.frombuffer(raw, "<" + TYPES[a.get("type")])
            components = int(a.get("NumberOfComponents", "1"))
            found[a.get("Name")] = values.reshape(-1, components) if components > 1 else values
            label = a.find("InformationKey[@name='UNITS_LABEL']")
            if label is not None:
                units[a.get("Name")] = label.text
        return found

    cells = arrays("Cells")
    return Grid(arrays("Points")["Points"], cells["connectivity"], cells["offsets"], cells["types"],
                arrays("PointData"), arrays("CellData"), units)


def read_pvd(path):
    """The frames of a list: [(time, [files of its parts])], in time order, files as paths."""
    frames = {}
    for entry in ElementTree.parse(path).getroot().iter("DataSet"):
        parts = frames.setdefault(float(entry.get("timestep")), {})
        parts[int(entry.get("part", "0"))] = Path(path).parent / entry.get("file")
    return [(time, [parts[p] for p in sorted(parts)]) for time, parts in sorted(frames.items())]


class History:
    """history.csv: columns by name, without the unit."""

    def __init__(self, path):
        with open(path, newline="", encoding="utf-8") as file:
            rows = list(csv.reader(file))
        if not rows:
            raise BadFile(f"{path}: empty")
        # A run that is still writing may leave a last line without its end.
        complete = [r for r in rows[1:] if len(r) == len(rows[0])]
        values = np.array(complete, dtype=float).reshape(len(complete), len(rows[0]))
        self.path = path
        self.columns = {}
        for i, title in enumerate(rows[0]):
            name, unit = re.fullmatch(r"(.*?)(?: \[([^\]]*)\])?", title, re.DOTALL).groups()
            self.columns[name] = Column(name, unit or "-", values[:, i])

    def __getitem__(self, name):
        bare = re.sub(r" \[[^\]]*\]$", "", name)
        if bare not in self.columns:
            raise BadFile(f"{self.path}: no column '{name}'; there are: {', '.join(self.columns)}")
        return self.columns[bare]


class Run:
    """A run folder."""

    def __init__(self, folder):
        self.folder = Path(folder)
        if not self.folder.is_dir():
            raise BadFile(f"{folder}: no such run folder")

    @property
    def history(self):
        return History(self.folder / "history.csv")

    @property
    def summary(self):
        return json.loads((self.folder / "run.json").read_text(encoding="utf-8"))

    @property
    def title(self):
        """That of the case; the folder's name where there is none, or while the run goes on and has none yet."""
        try:
            title = self.summary.get("title")
        except (OSError, ValueError):
            title = None
        return title or self.folder.resolve().name

    def frame(self, kind, time="last"):
        """Time and files of the frame of fields, cracks or bars at `time` ("last", or the nearest to a number)."""
        path = self.folder / f"{kind}.pvd"
        frames = read_pvd(path) if path.exists() else []
        if not frames:
            return None, []
        if time == "last":
            return frames[-1]
        return min(frames, key=lambda f: abs(f[0] - float(time)))
