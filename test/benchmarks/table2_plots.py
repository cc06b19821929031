"""Draws the paper's Figs. 8 and 9 with our own data: drives of this package's planner, SST and BIT* to three targets in one world, and
their speed and acceleration over time against the limits."""
import os

import matplotlib
matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.patches import Circle

from benchmarks import benchmark

# The last is drawn on top.
STYLES = {"sst_first": {"color": "#fdae6b", "lw": 1.4, "label": "SST, first solution"},
          "sst_1.5s": {"color": "#b30000", "lw": 1.4, "label": "SST, 1.5 s"},
          "bitstar_0.1s": {"color": "#2ca02c", "lw": 1.4, "label": "BIT*, 0.1 s, simplified (a path without timing)"},
          "candidate": {"color": "#08519c", "lw": 1.2, "ls": (0, (5, 3)), "label": "mocha, candidates of all classes"},
          "mocha": {"color": "#08519c", "lw": 2.8, "label": "mocha, selected"}}
SHORT = {"sst_first": "SST first", "sst_1.5s": "SST 1.5 s", "bitstar_0.1s": "BIT*", "mocha": "mocha"}
UNTIMED = ("candidate", "bitstar_0.1s")


class Drive:
    """One trajectory of the program's JSON."""

    def __init__(self, trajectory):
        self.time, *self.place, self.speed, self.acceleration = np.array(trajectory["samples"]).T
        self.method = trajectory["method"]
        self.style = {**STYLES[self.method], "zorder": 2 + list(STYLES).index(self.method), "solid_capstyle": "round"}
        if self.method not in UNTIMED and not trajectory["feasible"]:
            self.style["label"] += ", not certified"

    def totals(self):
        length_m = np.hypot(*np.diff(self.place)).sum()
        duration = "" if self.method in UNTIMED else f" in {self.time[-1]:.0f} s"
        return f"{SHORT[self.method]}: {length_m:.0f} m{duration}"


def legend(figure, all_axes):
    """One for the figure, each label once."""
    handles = {}
    for axes in all_axes:
        for handle, label in zip(*axes.get_legend_handles_labels()):
            handles.setdefault(label, handle)
    figure.legend(handles.values(), handles.keys(), loc="lower center", ncol=4)


def draw_world(axes, scene, target, drives):
    for x, y, radius in scene["obstacles"]:
        axes.add_patch(Circle((x, y), radius, fc="#d9d9d9", ec="#969696", lw=0.6))
    for drive in drives:
        axes.plot(*drive.place, **drive.style)
    axes.plot(*scene["start"][0], "o", color="w", ms=9, mec="k", ls="", zorder=9, label="start")
    axes.plot(*scene["targets"][target - 1], "*", color="w", ms=15, mec="k", ls="", zorder=9, label="target")
    totals = " · ".join(drive.totals() for drive in drives if drive.method in SHORT)
    axes.set_title(f"target {target}, world {scene['world']}\n{totals}", fontsize=9.5)
    axes.set(aspect="equal", xlim=(-5, 105), ylim=(-5, 105), xlabel="x [m]")


def draw_trajectories(scene, drives, path):
    figure, all_axes = plt.subplots(1, len(drives), figsize=(19, 7.8), sharex=True, sharey=True)
    for axes, (target, chosen) in zip(all_axes, drives.items()):
        draw_world(axes, scene, target, chosen)
    all_axes[0].set_ylabel("y [m]")
    figure.tight_layout(rect=(0, 0.1, 1, 1))
    legend(figure, all_axes)
    figure.savefig(path, dpi=110)
    plt.close(figure)


def draw_dynamics(scene, drives, path):
    rows = [("speed", scene["max_speed"], "$v_{max}$", "m/s"), ("acceleration", scene["max_acceleration"], "$a_{max}$", "m/s²")]
    figure, all_axes = plt.subplots(2, len(drives), figsize=(19, 8.5), sharex="col", sharey="row")
    for row, (quantity, limit, symbol, unit) in zip(all_axes, rows):
        for axes, chosen in zip(row, drives.values()):
            for drive in chosen:
                if drive.method not in UNTIMED:
                    axes.plot(drive.time, getattr(drive, quantity), **drive.style)
            axes.axhline(limit, color="k", ls="--", lw=1)
            axes.text(0.01, limit, f" {symbol} = {limit:g} {unit}", va="bottom", transform=axes.get_yaxis_transform())
            axes.set(xlim=(0, None), ylim=(0, 1.12 * limit))
            axes.grid(alpha=0.3)
        row[0].set_ylabel(f"{quantity} [{unit}]")
    for axes, target in zip(all_axes[0], drives):
        axes.set_title(f"target {target}, world {scene['world']}")
    for axes in all_axes[1]:
        axes.set_xlabel("time [s]")
    figure.tight_layout(rect=(0, 0.04, 1, 1))
    legend(figure, all_axes[0])
    figure.savefig(path, dpi=110)
    plt.close(figure)


def draw_table2(world, out):
    """Writes fig8.png and fig9.png of the world with that seed to the directory `out`."""
    scene = benchmark.run("table2_curves", world)
    drives = {target: [] for target in range(1, len(scene["targets"]) + 1)}
    for trajectory in scene["drives"]:
        drives[trajectory["target"]].append(Drive(trajectory))
    draw_trajectories(scene, drives, os.path.join(out, "fig9.png"))
    draw_dynamics(scene, drives, os.path.join(out, "fig8.png"))
