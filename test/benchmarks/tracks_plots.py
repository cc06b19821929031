"""Draws what the tracker of perception makes of the laser scans in a bag."""
import os

import matplotlib
matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

from benchmarks import benchmark

ARROW_EVERY_S = 0.5


def tracks_of(scans):
    """id -> rows (time, x, y, vx, vy, radius, seen)."""
    tracks = {}
    for scan in scans:
        for thing in scan["things"]:
            tracks.setdefault(int(thing[0]), []).append([scan["time_s"], *thing[1:]])
    return {number: np.array(track) for number, track in tracks.items()}


def draw_place(axes, result, tracks):
    walls = np.array(result["walls"]).reshape(-1, 2)
    axes.plot(*walls.T, "s", color="0.25", ms=1.8, zorder=1)
    hits = np.array(result["hits"]).reshape(-1, 3)
    dots = axes.scatter(hits[:, 1], hits[:, 2], c=hits[:, 0], s=1.5, cmap="viridis", zorder=2)
    axes.figure.colorbar(dots, ax=axes, label="hits on moving things, time [s]", shrink=0.8)
    for number, track in tracks.items():
        line, = axes.plot(track[:, 1], track[:, 2], lw=1.4, zorder=4)
        shown = track[np.unique((track[:, 0] / ARROW_EVERY_S).astype(int), return_index=True)[1]]
        axes.quiver(*shown[:, 1:5].T, color=line.get_color(), angles="xy", scale_units="xy", scale=2.0, width=0.0025, zorder=5)
        axes.annotate(str(number), track[0, 1:3], color=line.get_color(), weight="bold", zorder=6)
    labels = np.array([label for scan in result["scans"] for label in scan["labels"]]).reshape(-1, 5)
    axes.plot(labels[:, 1], labels[:, 2], "rx", ms=5, zorder=3)
    axes.set(aspect="equal", xlabel="x [m]", ylabel="y [m]", title="map, moving things, velocities (0.5 s long), labelled people (red)")


def draw_speeds(axes, tracks):
    for number, track in tracks.items():
        axes.plot(track[:, 0], np.hypot(track[:, 3], track[:, 4]), lw=1.4)
        axes.annotate(str(number), (track[-1, 0], np.hypot(*track[-1, 3:5])), weight="bold")
    axes.set(xlabel="time [s]", ylabel="speed [m/s]", ylim=(0.0, None), title="speeds of the tracks")
    axes.grid(alpha=0.3)


def draw(result, path):
    """Of what benchmark_tracks printed."""
    tracks = tracks_of(result["scans"])
    figure, (place, speeds) = plt.subplots(2, 1, figsize=(12, 14), gridspec_kw={"height_ratios": (3, 1)})
    draw_place(place, result, tracks)
    draw_speeds(speeds, tracks)
    figure.savefig(path, dpi=110, bbox_inches="tight")
    plt.close(figure)


def draw_tracks(bag, map_frame, mounts, out):
    draw(benchmark.run("tracks", os.path.abspath(bag), map_frame, *mounts), os.path.join(out, "tracks.png"))
