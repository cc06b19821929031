"""Draws a scene of scripts/bench table3 as the paper's Figs. 12 and 13: distances of all pairs over time, and the paths."""
import itertools
import os

import matplotlib
matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.patches import Circle

from benchmarks import benchmark

SAFETY_DISTANCE_M = 0.8
MOMENTS_S = 4.0  # between the places at which agents are drawn


def draw_distances(trace, places, path):
    figure, axes = plt.subplots(figsize=(11, 5), layout="constrained")
    times = trace["sample_s"] * np.arange(1, len(places[0]) + 1)
    for a, b in itertools.combinations(range(len(places)), 2):
        apart = np.hypot(*(places[a] - places[b]).T)
        axes.plot(times, apart, lw=1.3, label=f"{a + 1} and {b + 1}: at least {apart.min():.2f} m")
    axes.axhline(SAFETY_DISTANCE_M, color="#c00000", ls="--", lw=1.4)
    axes.text(0.01, SAFETY_DISTANCE_M, f"safety distance {SAFETY_DISTANCE_M} m", va="top", color="#c00000",
              transform=axes.get_yaxis_transform())
    axes.set(xlim=(0, times[-1]), ylim=(0, None), xlabel="time [s]", ylabel="distance of two agents, centre to centre [m]")
    axes.grid(alpha=0.3)
    axes.legend(loc="upper left", bbox_to_anchor=(1.01, 1.0), fontsize=8, title="agents")
    figure.savefig(path, dpi=110)
    plt.close(figure)


def draw_agent(axes, number, agent, track, trace, color):
    axes.plot(*track.T, color=color, lw=1.8, zorder=3, label=f"agent {number}")
    for place in track[::int(round(MOMENTS_S / trace["sample_s"]))]:
        axes.add_patch(Circle(place, trace["radius_m"], fc=color, ec="k", lw=0.5, alpha=0.45, zorder=4))
    axes.plot(*track[0], "o", color=color, mec="k", ms=6, zorder=5)
    axes.plot(*agent["goal"], "*", color=color, mec="k", ms=14, zorder=5)


def draw_paths(trace, places, path):
    figure, axes = plt.subplots(figsize=(9, 9), layout="constrained")
    for x, y, radius in trace["circles"]:
        axes.add_patch(Circle((x, y), radius, fc="#bdbdbd", ec="#969696", lw=0.6))
    for number, (agent, track) in enumerate(zip(trace["agents"], places)):
        draw_agent(axes, number + 1, agent, track, trace, f"C{number}")
    arrived = sum(agent["reached"] for agent in trace["agents"])
    axes.set(aspect="equal", xlim=(-2, 22), ylim=(-2, 22), xlabel="x [m]", ylabel="y [m]",
             title=f"scene {trace['seed']}: {arrived} of {len(places)} agents reach their goals; drawn every {MOMENTS_S:g} s")
    axes.legend(loc="upper left")
    figure.savefig(path, dpi=110)
    plt.close(figure)


def draw_table3(seed, out):
    """Writes fig12.png and fig13.png of the scene with that seed to the directory `out`."""
    trace = benchmark.run("table3", "--trace", seed)
    places = [np.array(agent["places"]) for agent in trace["agents"]]
    draw_distances(trace, places, os.path.join(out, "fig12.png"))
    draw_paths(trace, places, os.path.join(out, "fig13.png"))
