"""What the figures share: axes, the theory's line, small files, pictures of cracks below each other."""
import sys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.cm import ScalarMappable
from matplotlib.colors import Normalize
from PIL import Image

sys.path.insert(0, str(Path(__file__).resolve().parent))
import picture

THEORY = {"color": "black", "lw": 1.0, "ls": "--"}


def axes_of(xlabel, ylabel, size=(7, 4.5), rows=(1,)):
    """A figure and its axes; with several rows of these relative heights, all of them, the first one labelled."""
    figure, axes = plt.subplots(len(rows), 1, figsize=size, dpi=130, height_ratios=rows, squeeze=False)
    for one in axes[:, 0]:
        one.grid(alpha=0.3)
    axes[0, 0].set_xlabel(xlabel)
    axes[0, 0].set_ylabel(ylabel)
    return figure, axes[0, 0] if len(rows) == 1 else axes[:, 0]


def shrink(out):
    """A palette of 256 colours instead of 16 million: these files are kept in the repository."""
    with Image.open(out) as image:
        small = image.convert("RGB").quantize(256, dither=Image.Dither.NONE)
    small.save(out, optimize=True)


def save(figure, axes, title, out):
    axes.set_title(title, fontsize=11)
    axes.legend(fontsize=8)
    figure.tight_layout()
    figure.savefig(out)
    plt.close(figure)
    shrink(out)


def crack_pictures(scenes, titles, heading, out):
    """Side views one below the other with one scale of colours."""
    crack_norm = picture.crack_scale(np.concatenate([s.value for s in scenes]), scenes[0].crack_label)
    stress = np.concatenate([s.stress for s in scenes])
    bar_norm = Normalize(min(0.0, stress.min()), stress.max()) if stress.size else None
    camera = picture.side_camera(scenes[0].body, 2)
    width = 10.0
    heights = [width * s[1] / s[0] + 0.35 for s in (picture.size_of(scene, camera) for scene in scenes)]
    total = sum(heights) + 1.3
    figure = plt.figure(figsize=(width, total), dpi=110)
    top = total - 0.45
    for scene, title, height in zip(scenes, titles, heights):
        top -= height
        axes = figure.add_axes([0.01, top / total, 0.98, (height - 0.3) / total])
        picture.paint(axes, scene, camera, crack_norm, bar_norm, True)
        figure.text(0.02, (top + height - 0.22) / total, title, fontsize=9)
    for i, (norm, colours, text) in enumerate([(crack_norm, picture.CRACKS, scenes[0].crack_label),
                                               (bar_norm, picture.BARS, "bar stress [MPa]")]):
        if norm is not None:
            place = figure.add_axes([0.06 + 0.5 * i, 0.5 / total, 0.38, 0.14 / total])
            picture.colour_key(figure, norm, colours, place, text)
    figure.text(0.5, 1 - 0.28 / total, heading, ha="center")
    figure.savefig(out)
    plt.close(figure)
    shrink(out)


def wide(scene, least):
    """Only the cracks that are open by at least so many millimetres: the hairline ones along the bar hide the others."""
    shown = scene.value >= least
    scene.cracks, scene.value = scene.cracks[shown], scene.value[shown]
    return scene
