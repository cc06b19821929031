"""Draws a scene of scripts/bench replan as the paper's Figs. 10 and 11: the drive around what moves, and its clearance over time."""
import os

import matplotlib
matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.cm import ScalarMappable
from matplotlib.colors import Normalize
from matplotlib.patches import Circle, Polygon

from benchmarks import benchmark

MOVER, PLAN, LOCAL = "#f28e2b", "#1f77b4", "#c00000"
MOMENTS = 9  # at which robot and movers are drawn
DEEPEST_M = 3.0  # clearances beyond are cut off


def draw_obstacles(axes, trace):
    for x, y, radius in trace["circles"]:
        axes.add_patch(Circle((x, y), radius, fc="#bdbdbd", ec="#969696", lw=0.6))
    for corners in trace["polygons"]:
        axes.add_patch(Polygon(corners, fc="#bdbdbd", ec="#969696", lw=0.6))


def far_apart(places, moments, least_m):
    """Of the moments those at which it is somewhere else than at the one before."""
    kept = []
    for moment in moments:
        if not kept or np.hypot(*(places[moment] - places[kept[-1]])) > least_m:
            kept.append(moment)
    return kept


def draw_movers(axes, trace, moments):
    """Darker the later."""
    for number, mover in enumerate(trace["movers"]):
        places = np.array(mover["places"])
        axes.plot(*places.T, color=MOVER, lw=0.8, ls=":", zorder=2, label=None if number else "movers, with the time [s]")
        for moment in far_apart(places, moments, 0.6 * mover["radius"]):
            alpha = 0.15 + 0.7 * moment / moments[-1]
            axes.add_patch(Circle(places[moment], mover["radius"], fc=MOVER, ec="#8a4b08", lw=0.6, alpha=alpha, zorder=2))
            axes.text(*places[moment], f"{trace['run'][moment][0]:.0f}", ha="center", va="center", fontsize=7, zorder=3, clip_on=True)


def draw_robot(axes, trace, moments, colors):
    run = np.array(trace["run"])
    axes.scatter(run[:, 1], run[:, 2], c=run[:, 0], cmap=colors.cmap, norm=colors.norm, s=4, zorder=5)
    for moment in far_apart(run[:, 1:3], moments, trace["robot_radius"]):
        t, x, y = run[moment, :3]
        axes.add_patch(Circle((x, y), trace["robot_radius"], fc=colors.to_rgba(t), ec="k", lw=0.6, alpha=0.75, zorder=4))
        axes.text(x, y, f"{t:.0f}", ha="center", va="center", fontsize=7, color="w" if colors.norm(t) < 0.6 else "k", zorder=6)


def draw_local(axes, trace):
    """Each local trajectory up to its rejoin point; of the first one also the paths of the front end."""
    for k, replan in enumerate(trace["replans"]):
        first = k == 0
        axes.plot(*np.array(replan["path"]).T, color=LOCAL, lw=5.0 if first else 0.8, alpha=0.5, zorder=3,
                  label="local trajectories" if first else None)
        axes.plot(*replan["rejoin_point"], "s", color=LOCAL, ms=8 if first else 4, alpha=1.0 if first else 0.4, mec="k" if first else "none",
                  ls="", zorder=6, label="rejoin points" if first else None)
    for way in trace["replans"][0]["paths"] if trace["replans"] else []:
        axes.plot(*np.array(way["path"]).T, color=LOCAL, lw=0.8, ls="--", zorder=3)


def draw_scene(axes, trace, moments, colors):
    plan = np.array(trace["undisturbed"])
    draw_obstacles(axes, trace)
    axes.plot(plan[:, 1], plan[:, 2], color=PLAN, ls="--", lw=1.6, zorder=3, label="global plan, driven alone")
    draw_movers(axes, trace, moments)
    draw_local(axes, trace)
    draw_robot(axes, trace, moments, colors)
    axes.plot(*trace["goal"], "*", color="w", ms=15, mec="k", ls="", zorder=7, label="goal")
    run = np.array(trace["run"])
    reach = np.vstack([plan[:, 1:3], run[:, 1:3]])
    low, high = np.minimum(reach.min(axis=0) - 1.5, (0, -3.2)), np.maximum(reach.max(axis=0) + 1.5, (0, 3.2))
    axes.set(aspect="equal", xlim=(low[0], high[0]), ylim=(low[1], high[1]), xlabel="x [m]", ylabel="y [m]")
    end = "contact" if trace["contact"] else "reached" if trace["reached"] else "not reached"
    axes.set_title(f"scene {trace['scene']}: {trace['kind'].replace('_', ' ')}, {trace['group'].replace('_', ' ')}, {end} after"
                   f" {run[-1, 0]:.1f} s (alone: {plan[-1, 0]:.1f} s)")
    axes.legend(loc="upper left", ncol=5, fontsize=8)


def draw_clearance(axes, trace):
    run = np.array(trace["run"])
    for column, color, label in ((4, "#7f7f7f", "to static obstacles"), (5, MOVER, "to the nearest mover")):
        axes.plot(run[:, 0], run[:, column], color=color, lw=1.0, label=label)
    axes.plot(run[:, 0], run[:, 4:6].min(axis=1), color="k", lw=1.8, label="to the nearest of all")
    for replan in trace["replans"]:
        axes.axvline(replan["t"], color=LOCAL, lw=0.5, alpha=0.3, zorder=1)
    for key, color, what, side in (("required_m", MOVER, "movers", "right"), ("wall_margin_m", "#7f7f7f", "static obstacles", "left")):
        axes.axhline(trace[key], color=color, ls="--", lw=1.2)
        axes.text(0.99 if side == "right" else 0.01, trace[key], f"plans keep {trace[key]:.2f} m from {what}", va="bottom", ha=side, color=color,
                  transform=axes.get_yaxis_transform())
    axes.axhline(0.0, color="k", lw=0.8)
    axes.set(xlim=(0, run[-1, 0]), ylim=(-0.2, DEEPEST_M), xlabel="time [s]", ylabel="clearance of the footprint [m]")
    axes.grid(alpha=0.3)
    axes.legend(loc="upper right")


def draw_replan(scene, out):
    """Writes replan.png of the scene with that number to the directory `out`."""
    trace = benchmark.run("replan", "--trace", scene)
    moments = np.linspace(0, len(trace["run"]) - 1, MOMENTS).astype(int)
    colors = ScalarMappable(Normalize(0, trace["run"][-1][0]), "viridis")
    figure, (above, below) = plt.subplots(2, 1, figsize=(13, 9), height_ratios=(3, 2), layout="constrained")
    draw_scene(above, trace, moments, colors)
    figure.colorbar(colors, ax=above, label="time [s]", pad=0.01, aspect=30)
    draw_clearance(below, trace)
    figure.savefig(os.path.join(out, "replan.png"), dpi=110)
    plt.close(figure)
