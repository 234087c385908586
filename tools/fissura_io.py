"""Reads what a run leaves behind: frames (VTU, VTP), their lists (PVD), history.csv and run.json. Needs numpy only, no VTK.

    run = Run("runs/demo")
    run.history["load"].values, run.history["load"].unit
    time, files = run.frame("cracks", time="last")
    frame = read_frame(files[0])
    frame.cell_data["opening"], frame.units["opening"]

Files come from anywhere: what is damaged in one is told as BadFile with its name, and text from one reaches a terminal or a
picture only through printable().
"""
import csv
import io
import json
import math
import re
import sys
import unicodedata
import warnings
import xml.etree.ElementTree as ElementTree
import zlib
from collections import namedtuple
from dataclasses import dataclass, field
from pathlib import Path, PurePosixPath

import numpy as np

TYPES = {"Float32": "f4", "Float64": "f8", "UInt8": "u1", "Int32": "i4", "Int64": "i8"}
VERTEX, LINE, POLY_LINE, TRIANGLE, TETRAHEDRON = 1, 3, 4, 5, 10
CORNERS = {VERTEX: 1, LINE: 2, TRIANGLE: 3, TETRAHEDRON: 4}
LARGEST_BLOCK = 1 << 26  # a block holds at most 128 KiB as written

Column = namedtuple("Column", "name unit values")


class BadFile(Exception):
    """A file that is not what its name says; the text names the file."""


def printable(text):
    """One line without what a terminal would obey instead of show: control characters, marks that turn the direction of writing."""
    def shown(sign):
        code = ord(sign)
        if sign != " " and unicodedata.category(sign) in ("Cc", "Cf", "Cs", "Zl", "Zp"):
            return f"\\x{code:02x}" if code < 256 else f"\\u{code:04x}"
        return sign
    return "".join(map(shown, str(text)))


def refuse(tool, error):
    """Ends a tool as the program ends: with 2 for bad input, 3 where files cannot be read or written."""
    print(f"{tool}: {printable(error)}", file=sys.stderr)
    sys.exit(3 if isinstance(error, OSError) else 2)


def run_tool(tool, main):
    """Whatever is wrong with somebody's files is one line on the terminal, never a traceback."""
    warnings.simplefilter("ignore")  # of numpy and matplotlib, about numbers and letters that the files hold
    try:
        main()
    except (BadFile, OSError) as error:
        refuse(tool, error)
    except Exception as error:
        refuse(tool, f"what lies in the run folder cannot be drawn ({type(error).__name__}: {error})"[:300])


def read_bytes(path):
    """The whole file; a pipe or a device would never end."""
    path = Path(path)
    if path.exists() and not path.is_file():
        raise BadFile(f"{path}: it is no file")
    return path.read_bytes()


@dataclass
class Grid:
    points: np.ndarray
    connectivity: np.ndarray
    offsets: np.ndarray
    types: np.ndarray
    point_data: dict = field(default_factory=dict)
    cell_data: dict = field(default_factory=dict)
    units: dict = field(default_factory=dict)
    time: float | None = None                  # [s]
    names: dict = field(default_factory=dict)  # what numbers stand for: names["bar_names"][bar]
    path: str = ""

    def cells(self, cell_type):
        """Corner indices of all cells of one type, one row each, and the rows' numbers among all cells."""
        which = np.flatnonzero(self.types == cell_type)
        corners = CORNERS[cell_type]
        begin = self.offsets[which] - corners
        return self.connectivity[begin[:, None] + np.arange(corners)], which

    def bar_elements(self):
        """Of a frame of bars: the two points of each bar element, one row each, and the rows' polylines."""
        lengths = np.diff(self.offsets, prepend=0)
        if (self.types != POLY_LINE).any() or (lengths % 2).any():
            raise BadFile(f"{self.path}: its bars are no polylines of bar elements; earlier versions of Fissura wrote others")
        return self.connectivity.reshape(-1, 2), np.repeat(np.arange(lengths.size), lengths // 2)


def _inflate(data, begin, most):
    """One array: block count, block size, size of a last partial block, packed sizes, blocks (all UInt64)."""
    blocks, full, last = (int(n) for n in np.frombuffer(data, "<u8", 3, begin))
    if blocks > len(data) or full > LARGEST_BLOCK:
        raise ValueError("an array has no valid header")
    if blocks and (blocks - 1) * full + (last or full) > most:
        raise ValueError("an array holds more than the header says")
    packed = np.frombuffer(data, "<u8", blocks, begin + 24)
    at = begin + 8 * (3 + blocks)
    parts = []
    for i, size in enumerate(int(n) for n in packed):
        wanted = last if i == blocks - 1 and last else full
        parts.append(zlib.decompressobj().decompress(data[at:at + size], wanted + 1))
        if len(parts[-1]) != wanted:
            raise ValueError("a block has the wrong length")
        at += size
    return b"".join(parts)


def _words(text):
    """Names as VTK writes them: the number of each byte, a zero after each name."""
    whole = bytes(int(n) for n in (text or "").split())
    return [word.decode("utf-8", "replace") for word in whole.split(b"\0")[:-1]]


class _Frame:
    """The arrays of one file, by section."""

    def __init__(self, data):
        mark = re.search(rb'<AppendedData encoding="raw">\s*_', data)
        if not mark:
            raise ValueError("no frame with raw appended data")
        self.data, self.begin = data, mark.end()
        root = ElementTree.fromstring(data[:mark.end() - 1] + b"</AppendedData></VTKFile>")
        if root.get("compressor") != "vtkZLibDataCompressor" or root.get("header_type") != "UInt64":
            raise ValueError("only zlib blocks with UInt64 headers are read")
        self.body = root.find(root.get("type", ""))
        self.piece = None if self.body is None else self.body.find("Piece")
        if self.piece is None:
            raise ValueError("it has no piece")
        self.points = int(self.piece.get("NumberOfPoints"))
        self.count = sum(int(self.piece.get(f"NumberOf{kind}", "0")) for kind in ("Cells", "Verts", "Lines", "Strips", "Polys"))
        self.units = {}

    def array(self, node):
        components = int(node.get("NumberOfComponents", "1"))
        # No type has more than eight bytes, and no cell that is written more points than four or than there are.
        raw = _inflate(self.data, self.begin + int(node.get("offset")), 8 * components * (self.points + 4 * self.count + 1))
        values = np.frombuffer(raw, "<" + TYPES[node.get("type")])
        label = node.find("InformationKey[@name='UNITS_LABEL']")
        if label is not None:
            self.units[node.get("Name")] = label.text
        return values.reshape(-1, components) if components > 1 else values

    def arrays(self, section, count=None):
        node = self.piece.find(section)
        found = {a.get("Name"): self.array(a) for a in ([] if node is None else node.findall("DataArray"))}
        for name, values in found.items():
            if count is not None and len(values) != count:
                raise ValueError(f"array '{name}' has {len(values)} rows instead of {count}")
        return found

    def cells(self):
        """Connectivity, offsets and types, of either kind of file."""
        if self.body.tag == "UnstructuredGrid":
            cells = self.arrays("Cells")
            return cells["connectivity"], cells["offsets"], cells["types"]
        connectivity, offsets, types = [np.zeros(0, "i8")], [np.zeros(0, "i8")], [np.zeros(0, "u1")]
        for section, kind in (("Verts", VERTEX), ("Lines", POLY_LINE), ("Polys", TRIANGLE)):
            part = self.arrays(section)
            if not part:
                continue
            offsets.append(part["offsets"] + sum(map(len, connectivity)))
            connectivity.append(part["connectivity"])
            types.append(np.full(len(part["offsets"]), kind, "u1"))
        return np.concatenate(connectivity), np.concatenate(offsets), np.concatenate(types)

    def grid(self):
        points = self.arrays("Points")["Points"]
        connectivity, offsets, types = self.cells()
        if self.points != len(points) or self.count != len(types):
            raise ValueError("it has other numbers of points or cells than its header says")
        ends = np.concatenate([[0], offsets])
        if len(types) != len(offsets) or (np.diff(ends) < 0).any() or ends[-1] != len(connectivity):
            raise ValueError("the offsets of its cells do not fit")
        if connectivity.size and (connectivity.min() < 0 or connectivity.max() >= len(points)):
            raise ValueError("a cell names a point that is not there")
        for kind, corners in CORNERS.items():
            if (np.diff(ends)[types == kind] != corners).any():
                raise ValueError("a cell has the wrong number of points")
        grid = Grid(points.reshape(-1, 3), connectivity, offsets, types, self.arrays("PointData", len(points)),
                    self.arrays("CellData", len(types)), self.units)
        self.add_frame_data(grid)
        return grid

    def add_frame_data(self, grid):
        for node in self.body.findall("FieldData/*"):
            if node.get("Name") == "TimeValue":
                grid.time = float(self.array(node)[0])
            elif node.get("type") == "String":
                grid.names[node.get("Name")] = _words(node.text)


def read_frame(path):
    """Reads a frame as Fissura writes it: an unstructured grid (.vtu) or poly data (.vtp), appended raw data in zlib blocks."""
    data = read_bytes(path)
    try:
        grid = _Frame(data).grid()
        grid.path = str(path)
        return grid
    except (ValueError, KeyError, TypeError, IndexError, OverflowError, zlib.error, ElementTree.ParseError) as error:
        raise BadFile(f"{path}: a damaged frame ({error})") from None


def read_pvd(path):
    """The frames of a list: [(time, [files of its parts])], in time order, files as paths."""
    frames = {}
    try:
        for entry in ElementTree.fromstring(read_bytes(path)).iter("DataSet"):
            time, file = float(entry.get("timestep")), entry.get("file")
            if not math.isfinite(time):
                raise ValueError("a frame has no time")
            if not file or PurePosixPath(file).is_absolute() or ".." in PurePosixPath(file).parts:
                raise ValueError(f"it names '{file}', which does not lie in the run folder")
            frames.setdefault(time, {})[int(entry.get("part", "0"))] = Path(path).parent / file
    except (ValueError, TypeError, ElementTree.ParseError) as error:
        raise BadFile(f"{path}: no list of frames ({error})") from None
    return [(time, [parts[p] for p in sorted(parts)]) for time, parts in sorted(frames.items())]


def _name_and_unit(title):
    """"load [N]" -> name and unit."""
    begin = title.rfind(" [")
    return (title[:begin], title[begin + 2:-1] or "-") if begin >= 0 and title.endswith("]") else (title, "-")


class History:
    """history.csv: columns by name, without the unit."""

    def __init__(self, path):
        self.path = path
        self.columns = {}
        try:
            self._read(read_bytes(path).decode("utf-8"))
        except (ValueError, csv.Error) as error:
            raise BadFile(f"{path}: {error}") from None

    def _read(self, text):
        rows = list(csv.reader(io.StringIO(text[:text.rfind("\n") + 1], newline="")))  # a last line without its end is being written
        if not rows:
            raise ValueError("empty")
        for number, row in enumerate(rows[1:], 2):
            if len(row) != len(rows[0]):
                raise ValueError(f"line {number} has {len(row)} values for {len(rows[0])} columns")
        values = np.array(rows[1:], dtype=float).reshape(len(rows) - 1, len(rows[0]))
        for i, title in enumerate(rows[0]):
            name, unit = _name_and_unit(title)
            self.columns[name] = Column(name, unit, values[:, i])
        if "time" not in self.columns:
            raise ValueError("its first column is not `time`")

    def __getitem__(self, name):
        bare = name if name in self.columns else _name_and_unit(name)[0]
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
        path = self.folder / "run.json"
        try:
            summary = json.loads(read_bytes(path))
        except (ValueError, RecursionError) as error:
            raise BadFile(f"{path}: no JSON object ({error})") from None
        if not isinstance(summary, dict):
            raise BadFile(f"{path}: no JSON object")
        return summary

    @property
    def title(self):
        """That of the case; the folder's name where there is none, or while the run goes on and has none yet."""
        try:
            title = self.summary.get("title")
        except (OSError, BadFile):
            title = None
        return title if title and isinstance(title, str) else self.folder.resolve().name

    def frame(self, kind, time="last"):
        """Time and files of the frame of fields, cracks or bars at `time` ("last", or the nearest to a number)."""
        path = self.folder / f"{kind}.pvd"
        frames = read_pvd(path) if path.exists() else []
        if not frames:
            return None, []
        if time == "last":
            return frames[-1]
        return min(frames, key=lambda f: abs(f[0] - float(time)))
