"""Draws the paper's Figs. 6 and 7 with our own data: trajectories of MINCO and of motion camouflage in one world of the plane and one
of space, at 1 m and at 8 m between knots; then their speed and acceleration over time against the limits."""
import os

import matplotlib
matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.patches import Circle, Rectangle
from mpl_toolkits.mplot3d.art3d import Poly3DCollection

from benchmarks import benchmark

# Nearly the same drive by either method: so MINCO pale and wide, camouflage dark and thin on top of it.
STYLES = {("minco", 1): {"color": "#9ecae1", "lw": 4.0}, ("camouflage", 1): {"color": "#08519c", "lw": 1.3},
          ("minco", 8): {"color": "#fdae6b", "lw": 4.0}, ("camouflage", 8): {"color": "#b30000", "lw": 1.3}}
NAMES = {"minco": "MINCO", "camouflage": "camouflage"}
RAYS_SPACING_M = 8  # at 1 m they would cover the world
AZIMUTH_DEG, ELEVATION_DEG = -45, 30  # across the way from corner to corner
SIDES = 10  # of the half of a trunk that the camera sees
CLOSER_M = 30


class Drive:
    """One trajectory of the program's JSON."""

    def __init__(self, trajectory, dim):
        samples = np.array(trajectory["samples"]).T
        self.time, self.place, self.speed, self.acceleration = samples[0], samples[1:1 + dim], samples[-2], samples[-1]
        self.knots = np.array(trajectory["knots"])
        self.references = np.array(trajectory.get("references", []))
        key = (trajectory["method"], trajectory["spacing_m"])
        self.has_rays = key == ("camouflage", RAYS_SPACING_M)
        proof = "" if trajectory["feasible"] else ", not certified"
        self.style = {**STYLES[key], "label": f"{NAMES[key[0]]}, knots {key[1]:g} m apart{proof}", "solid_capstyle": "round"}


def draw_plane(axes, scene, drives):
    for x, y, radius in scene["obstacles"]:
        axes.add_patch(Circle((x, y), radius, fc="#d9d9d9", ec="#969696", lw=0.6))
    draw_ways(axes, scene, drives)
    for drive in filter(lambda drive: drive.has_rays, drives):
        colour, name = drive.style["color"], f"camouflage, {RAYS_SPACING_M} m"
        for reference, knot in zip(drive.references, drive.knots):
            axes.plot(*zip(reference, knot), color=colour, lw=0.6, ls=(0, (4, 4)), zorder=1)
        axes.plot(*drive.knots.T, "o", color=colour, ms=4, label=f"knots on their rays: {name}")
        axes.plot(*np.unique(drive.references, axis=0).T, "^", color=colour, ms=10, mec="k",
                  label=f"reference points $p_{{ref}}$: {name}")
    axes.set(aspect="equal", adjustable="datalim", xlabel="x [m]", ylabel="y [m]", title=f"(a) plane, world {scene['world']}")


def draw_closer(axes, scene, drives, overview):
    """The square in which the first and the last trajectory are farthest apart, and its frame in the overview."""
    gaps = np.linalg.norm(drives[0].place[:, :, None] - drives[-1].place[:, None, :], axis=0).min(axis=1)
    centre = drives[0].place[:, gaps.argmax()]
    draw_plane(axes, scene, drives)
    low, high = centre - CLOSER_M / 2, centre + CLOSER_M / 2
    axes.set(xlim=(low[0], high[0]), ylim=(low[1], high[1]), title="(a) closer: the square on the left")
    overview.add_patch(Rectangle(low, CLOSER_M, CLOSER_M, fill=False, lw=1.2, zorder=6))


def draw_ways(axes, scene, drives):
    """What all panels show."""
    way = np.array(scene["front_end"]).T
    axes.plot(*way, color="#525252", lw=0.8, zorder=3, label="front-end path")
    axes.plot(*way[:, :1], "o", color="#2ca02c", ms=9, mec="k", ls="", zorder=4, label="start")
    axes.plot(*way[:, -1:], "*", color="#2ca02c", ms=15, mec="k", ls="", zorder=4, label="goal")
    for drive in drives:
        axes.plot(*drive.place, **drive.style)


def draw_trunks(axes, trunks, height_m, zorder):
    """Upright cylinders from the ground to the height: what the camera sees of them."""
    turns = np.radians(AZIMUTH_DEG) + np.linspace(-np.pi, np.pi, 2 * SIDES + 1)
    around = np.column_stack((np.cos(turns), np.sin(turns)))
    seen = range(SIDES // 2, SIDES // 2 + SIDES)
    faces, shades = [], []
    for x, y, radius in trunks:
        foot = np.column_stack((around * radius + (x, y), np.zeros(len(turns))))
        head = foot + (0, 0, height_m)
        faces += [np.array((foot[i], foot[i + 1], head[i + 1], head[i])) for i in seen] + [head]
        shades += [0.65 + 0.15 * around[i, 0] for i in seen] + [0.85]
    colours = [(shade, shade * 0.9, shade * 0.75, 0.6) for shade in shades]
    axes.add_collection3d(Poly3DCollection(faces, facecolors=colours, zorder=zorder))


def draw_space(axes, scene, drives):
    way, trunks = np.array(scene["front_end"]), np.array(scene["obstacles"])
    height_m = way[:, 2].max() + 2
    # matplotlib orders whole lines, not their points: so first the trunks behind the path, then those before it.
    azimuth = np.radians(AZIMUTH_DEG)
    to_right, to_camera = (-np.sin(azimuth), np.cos(azimuth)), (np.cos(azimuth), np.sin(azimuth))
    before = trunks[:, :2] @ to_camera > np.interp(trunks[:, :2] @ to_right, way[:, :2] @ to_right, way[:, :2] @ to_camera)
    draw_trunks(axes, trunks[~before], height_m, zorder=1)
    draw_ways(axes, scene, drives)
    draw_trunks(axes, trunks[before], height_m, zorder=5)
    axes.view_init(ELEVATION_DEG, AZIMUTH_DEG)
    side_m = way[-1, 0]
    axes.set(xlim=(0, side_m), ylim=(0, side_m), zlim=(0, height_m), zticks=(0, 5, 10), xlabel="x [m]", ylabel="y [m]",
             zlabel="z [m]", facecolor="none")
    axes.set_title(f"(b) space, world {scene['world']}\n(trunks drawn up to {height_m:g} m, heights twice as large)", x=0.2, y=0.74)
    axes.xaxis.labelpad = axes.yaxis.labelpad = 12
    axes.set_box_aspect((side_m, side_m, 2 * height_m), zoom=0.78)


def draw_trajectories(scenes, path):
    figure = plt.figure(figsize=(13.5, 14.5))
    plane = figure.add_axes((0.05, 0.57, 0.43, 0.40))
    closer = figure.add_axes((0.55, 0.57, 0.43, 0.40))
    # matplotlib makes it a square and cuts off what is beyond: so as wide as the figure, and behind the panels above.
    space = figure.add_axes((0.0, -0.17, 1.0, 0.93), projection="3d", proj_type="ortho", computed_zorder=False, zorder=-1)
    draw_plane(plane, *scenes["plane"])
    draw_closer(closer, *scenes["plane"], overview=plane)
    draw_space(space, *scenes["space"])
    figure.legend(*plane.get_legend_handles_labels(), loc="lower center", ncol=4)
    figure.savefig(path, dpi=110)
    plt.close(figure)


def draw_dynamics(scenes, limits, path):
    rows = [("speed", "max_speed", "$v_{max}$", "m/s"), ("acceleration", "max_acceleration", "$a_{max}$", "m/s²")]
    figure, all_axes = plt.subplots(2, 2, figsize=(14, 7.5), sharex="col", sharey="row")
    for row, (quantity, limit, symbol, unit) in zip(all_axes, rows):
        for axes, (_, drives) in zip(row, scenes.values()):
            for drive in drives:
                axes.plot(drive.time, getattr(drive, quantity), **drive.style)
            axes.axhline(limits[limit], color="k", ls="--", lw=1)
            axes.text(0.01, limits[limit], f" {symbol} = {limits[limit]:g} {unit}", va="bottom", transform=axes.get_yaxis_transform())
            axes.set(xlim=(0, None), ylim=(0, 1.12 * limits[limit]))
            axes.grid(alpha=0.3)
        row[0].set_ylabel(f"{quantity} [{unit}]")
    for axes, letter, (name, (scene, _)) in zip(all_axes[0], "ab", scenes.items()):
        axes.set_title(f"({letter}) {name}, world {scene['world']}")
    for axes in all_axes[1]:
        axes.set_xlabel("time [s]")
    figure.tight_layout(rect=(0, 0.06, 1, 1))
    figure.legend(*all_axes[0, 0].get_legend_handles_labels(), loc="lower center", ncol=4)
    figure.savefig(path, dpi=110)
    plt.close(figure)


def draw_table1(world, out):
    """Writes fig6.png and fig7.png of the worlds with that seed to the directory `out`."""
    result = benchmark.run("table1_curves", world)
    scenes = {}
    for name in ("plane", "space"):
        scene = result[name]
        scenes[name] = scene, [Drive(trajectory, scene["dim"]) for trajectory in scene["trajectories"]]
    draw_trajectories(scenes, os.path.join(out, "fig6.png"))
    draw_dynamics(scenes, result, os.path.join(out, "fig7.png"))
