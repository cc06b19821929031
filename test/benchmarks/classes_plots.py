"""Draws the paths of all classes in a world or on a saved map, with their costs."""
import os

import matplotlib
matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

from benchmarks import benchmark
from mocha_scripts import worlds
from mocha_scripts.complaint import Complaint
from mocha_scripts.world_plot import COLORS, draw_world


def draw_map(axes, path, description):
    image = plt.imread(os.path.join(os.path.dirname(path), description["image"]))
    cell_m = description["resolution"]
    x, y = description["origin"][:2]
    extent = (x, x + cell_m * image.shape[1], y, y + cell_m * image.shape[0])
    axes.imshow(image, cmap="gray", extent=extent)


def label_place(paths, own):
    """Where a path is farthest from all others."""
    path = paths[own]
    others = [other for i, other in enumerate(paths) if i != own]
    if not others:
        return path[len(path) // 2]
    apart = [min(np.hypot(*(other - point).T).min() for other in others) for point in path]
    return path[int(np.argmax(apart))]


def describe(candidate):
    if candidate["solved"]:
        return f"{candidate['cost']:.1f}"
    return f"at least {candidate['cost']:.1f}" if candidate["cannot_win"] else "not certified"


def draw_candidates(axes, candidates):
    paths = [np.array(candidate["path"]) for candidate in candidates]
    for i, candidate in enumerate(candidates):
        color = COLORS[i % len(COLORS)]
        axes.plot(*paths[i].T, color=color, lw=3.0 if candidate["selected"] else 1.6, ls="-" if candidate["solved"] else ":",
                  label=describe(candidate) + (", driven" if candidate["selected"] else ""), zorder=4 if candidate["selected"] else 3)
        axes.annotate(describe(candidate), label_place(paths, i), color=color, weight="bold", zorder=6,
                      bbox={"boxstyle": "round,pad=0.15", "fc": "w", "ec": color, "alpha": 0.85})


def draw_classes(path, classes, drive, out):
    path = os.path.abspath(path)
    description = worlds.read_yaml(path)
    if "image" not in description and "bounds" not in description:
        raise Complaint(f"{path}: is neither a world file nor the map.yaml of a saved map; save_map writes those of a name that ends on .yaml")
    if "image" in description and not drive:
        raise Complaint(f"{path}: is a map: say from where to where, with --drive X0 Y0 X1 Y1")
    result = benchmark.run("classes", os.path.join(benchmark.ROOT, "config"), classes, path, *(drive or []))
    figure, axes = plt.subplots(figsize=(11, 8))
    if "image" in description:
        draw_map(axes, path, description)
    else:
        draw_world(axes, description)
    draw_candidates(axes, result["candidates"])
    for candidate in result["straight"]:
        axes.plot(*np.array(candidate["path"]).T, "k--", lw=1.2, zorder=5, label=f"from the straight line: {describe(candidate)}")
    axes.plot(*result["start"], "o", color="w", ms=9, mec="k", zorder=7)
    axes.plot(*result["goal"], "*", color="w", ms=15, mec="k", zorder=7)
    axes.set(aspect="equal", xlabel="x [m]", ylabel="y [m]", title="paths of different classes and what they cost")
    axes.legend(loc="upper left", bbox_to_anchor=(1.0, 1.0), title="cost J")
    figure.savefig(os.path.join(out, "classes.png"), dpi=110, bbox_inches="tight")
