#!/usr/bin/python3
"""Draws the cracks of a run: the deformed body in light grey, the cracks in it coloured by their opening and the bars
by their stress, from the side and obliquely, as a PNG.

    picture.py runs/demo -o crack.png --time last --warp 20
    picture.py runs/shattered -o pieces.png --fragments      the pieces instead, each in its colour, single tets brown

The body is drawn as if it were translucent: cracks and bars inside it are seen. Triangles are projected orthographically
and painted from back to front.
"""
import argparse
import math
import sys
from dataclasses import dataclass, field
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
matplotlib.rcParams["text.parse_math"] = False  # a dollar in a title is a dollar
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.cm import ScalarMappable
from matplotlib.collections import LineCollection, PolyCollection
from matplotlib.colors import LinearSegmentedColormap, LogNorm, Normalize
from matplotlib.ticker import NullLocator

sys.path.insert(0, str(Path(__file__).resolve().parent))
import fissura_io as io

# The pale end of the map is left out: a hairline crack must stand out from the grey body.
CRACKS = LinearSegmentedColormap.from_list("cracks", plt.get_cmap("inferno_r")(np.linspace(0.25, 1, 256)))
BARS = plt.get_cmap("viridis")
LEAST_COLOUR = 0.01  # [mm]: the opening that the logarithmic scale begins with, as in the report page
HAIRLINE = 0.02      # [mm]: narrower cracks hide those that matter where the widest is ten times as wide
# What may colour the cracks: factor to the unit shown, and its name.
FIELDS = {"opening": (1e3, "crack opening [mm]"), "sliding": (1e3, "sliding of the crack faces [mm]"), "damage": (1.0, "damage [-]")}
PIECES = 0.45 + 0.55 * plt.get_cmap("tab10")(np.arange(10))[[7, 0, 1, 2, 4, 6, 8, 9, 3], :3]
CRUMBS = np.array([0.80, 0.70, 0.55])
# Corners of the face opposite to corner 0, 1, 2, 3 of a tet; normals point outwards.
FACES = np.array([[1, 2, 3], [0, 3, 2], [0, 1, 3], [0, 2, 1]])


@dataclass
class Scene:
    """Deformed shapes in metres, ready to be projected."""
    body: np.ndarray          # triangles x 3 corners x 3
    body_group: np.ndarray
    cracks: np.ndarray
    value: np.ndarray         # of the cracks, in the unit of `crack_label`
    bars: np.ndarray          # lines x 2 ends x 3
    stress: np.ndarray        # [MPa]
    warp: float
    body_colour: np.ndarray | None = None  # of the fragments, or grey
    crack_label: str = FIELDS["opening"][1]
    planes: np.ndarray = field(default_factory=lambda: np.zeros((0, 3, 3)))
    impactors: np.ndarray = field(default_factory=lambda: np.zeros((0, 3, 3)))


def identical_points(points):
    """Numbers the distinct positions: tets own their corners, so copies of a corner agree to the last bit."""
    rows = np.ascontiguousarray(points + 0.0).view(np.dtype((np.void, points.dtype.itemsize * 3))).ravel()
    return np.unique(rows, return_inverse=True)[1]


def outer_faces(grid):
    """Faces that one tet alone has, as rows of three point numbers, and the tet (cell) of each."""
    tets, cells = grid.cells(io.TETRAHEDRON)
    faces = tets[:, FACES].reshape(-1, 3)
    keys = np.sort(identical_points(grid.points)[faces], axis=1)
    _, first, count = np.unique(keys, axis=0, return_index=True, return_counts=True)
    single = np.sort(first[count == 1])
    return faces[single], cells[single // 4]


def fragment_faces(grid):
    """Faces that a tet shares with no tet of its own fragment, the tet (cell) of each, and a colour."""
    tets, cells = grid.cells(io.TETRAHEDRON)
    faces = tets[:, FACES].reshape(-1, 3)
    fragment = grid.cell_data["fragment"][cells]
    keys = np.column_stack([np.sort(identical_points(grid.points)[faces], axis=1), np.repeat(fragment, 4)])
    _, first, count = np.unique(keys, axis=0, return_index=True, return_counts=True)
    single = np.sort(first[count == 1])
    tets_of = np.bincount(fragment)
    colours = PIECES[fragment % len(PIECES)]
    colours[tets_of[fragment] == 1] = CRUMBS
    return faces[single], cells[single // 4], colours[single // 4]


def round_factor(value):
    """The next lower 1, 2 or 5 times a power of ten; a body is never drawn stiffer than it is."""
    if not value > 1:
        return 1.0
    power = 10.0 ** math.floor(math.log10(value))
    return max(m * power for m in (1, 2, 5) if m * power <= value)


def natural_warp(sizes, length):
    """Factor that shows the body's displacements as 5 % of its length, and fragments in flight within a quarter of it."""
    usual, largest = np.percentile(sizes, 99), sizes.max()
    return round_factor(min(0.05 * length / usual, 0.25 * length / largest)) if usual > 0 else 1.0


def is_gap(corners, drawn, opening):
    """Room between pieces, not a crack: faces that have parted by more than half the mean edge of their triangle, or whose
    triangle, halfway between two pieces that turn, would be drawn half as large again."""
    def edge(triangles):
        return np.linalg.norm(triangles - np.roll(triangles, 1, axis=1), axis=2).mean(axis=1)
    return (opening > 0.5 * edge(corners)) | (edge(drawn) > 1.5 * edge(corners))


def displacement_at(grid, fields, by_position):
    """Displacement of a grid's points: its own, or that of the body's corners at the same place."""
    if "displacement" in grid.point_data:
        return grid.point_data["displacement"]
    nothing = np.zeros(3)
    return np.array([by_position.get(p.tobytes(), nothing) for p in grid.points + 0.0]).reshape(-1, 3)


def crack_scale(values, label):
    """Colour scale of the cracks: logarithmic for openings, which run from hairlines to gaps; linear else."""
    largest = max(np.percentile(values, 99) if values.size else 1, 1e-9)
    if label != FIELDS["opening"][1]:
        return Normalize(0, largest)
    return LogNorm(LEAST_COLOUR, max(largest, 10 * LEAST_COLOUR), clip=True)


def wide_enough(opening, least):
    """Which cracks are drawn; openings and `least` in mm, or "auto": no hairlines where there are wide cracks."""
    if least == "auto":
        least = HAIRLINE if opening.max(initial=0) > 10 * HAIRLINE else -np.inf
    return opening >= float(least)


def make_scene(run, time, warp, minimum_damage, fragments=False, colour_by="opening", least="auto"):
    factor, crack_label = FIELDS[colour_by]
    moment, files = run.frame("fields", time)
    if not files:
        raise io.BadFile(f"{run.folder}: no frame in fields.pvd")
    fields = io.read_frame(files[0])
    moved = fields.point_data.get("displacement", np.zeros_like(fields.points))
    extent = np.ptp(fields.points, axis=0)
    natural = natural_warp(np.linalg.norm(moved, axis=1), extent.max())
    warp = natural if warp == "auto" else float(warp)
    at = {p.tobytes(): u for p, u in zip(fields.points + 0.0, moved)}

    def deformed(grid, factor=warp):
        return grid.points + factor * displacement_at(grid, fields, at)

    faces, cells, colours = fragment_faces(fields) if fragments else (*outer_faces(fields), None)
    groups = fields.cell_data.get("group", np.zeros(fields.types.size, int))
    scene = Scene((fields.points + warp * moved)[faces], groups[cells], np.zeros((0, 3, 3)), np.zeros(0),
                  np.zeros((0, 2, 3)), np.zeros(0), warp, colours, crack_label)

    for part in [] if fragments else run.frame("cracks", moment)[1]:
        grid = io.read_frame(part)
        triangles, which = grid.cells(io.TRIANGLE)
        damage = grid.cell_data.get("damage", np.ones(grid.types.size))[which]
        opening = grid.cell_data["opening"][which]
        usual = deformed(grid, min(warp, natural))[triangles]  # larger factors stretch everything
        shown = (damage >= minimum_damage) & wide_enough(1e3 * opening, least) & ~is_gap(grid.points[triangles], usual, opening)
        scene.cracks = np.concatenate([scene.cracks, deformed(grid)[triangles[shown]]])
        scene.value = np.append(scene.value, factor * grid.cell_data[colour_by][which][shown])
    for part in run.frame("bars", moment)[1]:
        grid = io.read_frame(part)
        ends, _ = grid.bar_elements()
        if len(ends):
            scene.bars = np.concatenate([scene.bars, deformed(grid)[ends]])
            scene.stress = np.append(scene.stress, 1e-6 * grid.point_data["stress"][ends[:, 0]])
    add_rigid_bodies(run, moment, scene)
    return moment, scene


def add_rigid_bodies(run, moment, scene):
    """Planes never move; impactors move with the body's warp, so that they stay where they touch it."""
    for part in run.frame("rigid", moment)[1]:
        grid = io.read_frame(part)
        triangles, which = grid.cells(io.TRIANGLE)
        moves = grid.cell_data["impactor"][which] > 0
        surface = (grid.points + scene.warp * grid.point_data["displacement"])[triangles]
        scene.planes, scene.impactors = surface[~moves], surface[moves]


def side_camera(points, up):
    """Rows: to the right, upwards, towards the eye; the eye looks along the thinner of the two level axes."""
    level = [a for a in range(3) if a != up]
    extent = np.ptp(points.reshape(-1, 3), axis=0)
    along = level[int(np.argmin(extent[level]))]
    right = level[0] if along == level[1] else level[1]
    basis = np.eye(3)
    towards = np.cross(basis[right], basis[up])
    return np.array([basis[right], basis[up], towards])


def oblique_camera(side, turn=math.radians(32), raise_=math.radians(24)):
    right, up, towards = side
    eye = math.cos(turn) * towards + math.sin(turn) * right
    right = np.cross(up, eye)
    eye = math.cos(raise_) * eye + math.sin(raise_) * up
    return np.array([right, np.cross(eye, right), eye])


def greys(triangles, group, eye):
    """Flat shading: light from over the eye's shoulder; each further group a little darker."""
    normals = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
    normals /= np.maximum(np.linalg.norm(normals, axis=1), 1e-300)[:, None]
    light = eye[2] + 0.5 * eye[1] + 0.25 * eye[0]
    brightness = 0.74 + 0.2 * np.clip(normals @ light / np.linalg.norm(light), 0, 1)
    return np.repeat((brightness * 0.9 ** np.minimum(group, 3))[:, None], 3, axis=1)


def paint(axes, scene, camera, crack_norm, bar_norm, widest_last):
    seen = np.cross(scene.body[:, 1] - scene.body[:, 0], scene.body[:, 2] - scene.body[:, 0]) @ camera[2] > 0
    body, group = scene.body[seen], scene.body_group[seen]
    order = np.argsort((body @ camera[2]).mean(axis=1))
    colours = greys(body, group, camera)
    if scene.body_colour is not None:
        colours = np.clip(1.15 * colours * scene.body_colour[seen], 0, 1)
    axes.add_collection(PolyCollection((body @ camera[:2].T)[order], facecolors=colours[order],
                                       edgecolors="face", linewidths=0.2, rasterized=True))
    if scene.planes.size and abs(np.cross(*(scene.planes[0, 1:] - scene.planes[0, 0]) @ camera[:2].T)) > 0:
        axes.add_collection(PolyCollection(scene.planes @ camera[:2].T, facecolors="#efe9dd", edgecolors="face", zorder=0))
    if scene.stress.size:
        order = np.argsort((scene.bars @ camera[2]).mean(axis=1))
        axes.add_collection(LineCollection((scene.bars @ camera[:2].T)[order], array=scene.stress[order], cmap=BARS,
                                           norm=bar_norm, linewidths=1.1, capstyle="round"))
    if scene.value.size:
        depth = (scene.cracks @ camera[2]).mean(axis=1)
        order = np.argsort(scene.value if widest_last else depth, kind="stable")
        # A crack seen edge-on has no area: its outline shows it.
        axes.add_collection(PolyCollection((scene.cracks @ camera[:2].T)[order], array=scene.value[order],
                                           cmap=CRACKS, norm=crack_norm, edgecolors="face", linewidths=0.7))
    if scene.impactors.size:
        faces = np.cross(scene.impactors[:, 1] - scene.impactors[:, 0], scene.impactors[:, 2] - scene.impactors[:, 0]) @ camera[2] > 0
        axes.add_collection(PolyCollection(scene.impactors[faces] @ camera[:2].T, facecolors="#3b6ea5", edgecolors="face",
                                           linewidths=0.2, alpha=0.55))
    corners = np.concatenate([scene.body.reshape(-1, 3), scene.impactors.reshape(-1, 3)]) @ camera[:2].T
    low, high = corners.min(axis=0), corners.max(axis=0)
    margin = 0.02 * (high - low).max()
    axes.set_xlim(low[0] - margin, high[0] + margin)
    axes.set_ylim(low[1] - margin, high[1] + margin)
    axes.set_aspect("equal")
    axes.axis("off")
    return (high - low) + 2 * margin


def colour_key(figure, norm, colours, place, text):
    """A horizontal key; a logarithmic one has plain numbers."""
    key = figure.colorbar(ScalarMappable(norm, colours), cax=place, orientation="horizontal", label=text)
    if isinstance(norm, LogNorm):
        ticks = [m * 10.0 ** p for p in range(-2, 4) for m in (1, 2, 5)]
        key.set_ticks([t for t in ticks if norm.vmin <= t <= norm.vmax * 1.001])
        key.ax.xaxis.set_major_formatter(lambda value, _: f"{value:g}")
        key.ax.xaxis.set_minor_locator(NullLocator())


def size_of(scene, camera):
    shown = np.concatenate([scene.body.reshape(-1, 3), scene.impactors.reshape(-1, 3)])
    return np.maximum(np.ptp(shown @ camera[:2].T, axis=0), 1e-12)


def draw(scene, moment, title, up, out):
    side = side_camera(scene.body, up)
    cameras = [side, oblique_camera(side)]
    width = 10.0
    heights = [min(7.0, max(1.2, width * s[1] / s[0])) for s in (size_of(scene, c) for c in cameras)]
    bars_below = [b for b in (scene.value.size, scene.stress.size) if b]
    figure = plt.figure(figsize=(width, sum(heights) + 0.6 + (0.9 if bars_below else 0)), dpi=140)
    total = figure.get_figheight()
    crack_norm = crack_scale(scene.value, scene.crack_label)
    bar_norm = Normalize(min(0.0, scene.stress.min()), max(scene.stress.max(), 1e-9)) if scene.stress.size else None

    top = total - 0.5
    for camera, height, widest_last in zip(cameras, heights, (True, False)):
        top -= height
        axes = figure.add_axes([0.01, top / total, 0.98, height / total])
        paint(axes, scene, camera, crack_norm, bar_norm, widest_last)
    keys = []
    if scene.value.size:
        keys.append((crack_norm, CRACKS, scene.crack_label))
    if scene.stress.size:
        keys.append((bar_norm, BARS, "bar stress [MPa]"))
    for i, (norm, colours, text) in enumerate(keys):
        place = figure.add_axes([0.06 + 0.5 * i, 0.5 / total, 0.38, 0.14 / total])
        colour_key(figure, norm, colours, place, text)
    figure.text(0.5, 1 - 0.3 / total, f"{io.printable(title)[:120]}   t = {moment:.4g} s   displacements x {scene.warp:g}", ha="center")
    figure.savefig(out)


def is_number(text):
    try:
        return math.isfinite(float(text))
    except ValueError:
        return False


def main():
    parser = argparse.ArgumentParser(description="Draws the cracks of a run as a PNG.")
    parser.add_argument("run", help="run folder")
    parser.add_argument("--field", default="opening", choices=list(FIELDS), help="what colours the cracks")
    parser.add_argument("--time", default="last", help="seconds (the nearest frame), or last")
    parser.add_argument("--warp", default="auto", help="factor on the displacements, or auto")
    parser.add_argument("--up", default="z", choices="xyz", help="axis that points up in the picture")
    parser.add_argument("--min-damage", type=float, default=0.2, help="joints with less damage are not drawn")
    parser.add_argument("--fragments", action="store_true", help="draw the pieces instead of the cracks")
    parser.add_argument("--from", dest="least", default="auto", metavar="MM",
                        help="cracks narrower than this are not drawn; auto: 0.02 mm where the widest is above 0.2 mm")
    parser.add_argument("--title", help="default: that of the case")
    parser.add_argument("-o", "--out", required=True, help="PNG to write")
    arguments = parser.parse_args()
    for option, word in (("time", "last"), ("warp", "auto"), ("from", "auto")):
        given = getattr(arguments, "least" if option == "from" else option)
        if not is_number(given) and given != word:
            io.refuse("picture", f"--{option} is a number or `{word}`, not `{given}`")
    run = io.Run(arguments.run)
    moment, scene = make_scene(run, arguments.time, arguments.warp, arguments.min_damage, arguments.fragments, arguments.field,
                               arguments.least)
    draw(scene, moment, arguments.title or run.title, "xyz".index(arguments.up), arguments.out)
    print(io.printable(f"picture: {arguments.out}"))


if __name__ == "__main__":
    io.run_tool("picture", main)
