"""Draws what led to the contacts of a robot with what moves."""
import os

import matplotlib
matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
import yaml

from benchmarks import benchmark

BEFORE_S = (2.5, 2.0, 1.5, 1.2, 0.9, 0.6, 0.3, 0.0)  # the moments that are drawn
SIDE_M = 3.2
LIMIT_S = 100.0


def footprint_of(world):
    """Length and width of the first robot's body [m]; of a disc, those of a square about as large."""
    with open(world) as file:
        robot = yaml.safe_load(file)["robots"][0]
    with open(os.path.join(benchmark.ROOT, "config/robots", f"{robot['model']}.yaml")) as file:
        model = yaml.safe_load(file) or {}
    return model.get("footprint_length", 0.5), model.get("footprint_width", 0.5)


def draw_moment(axes, row, place, size, title):
    for x, y, radius in row["movers"]:
        axes.add_patch(plt.Circle((x, y), radius, color="0.75"))
    for x, y, radius, vx, vy, _ in row["predicted"]:
        axes.add_patch(plt.Circle((x, y), radius, fill=False, color="C3"))
        axes.arrow(x, y, vx, vy, color="C3", head_width=0.08, length_includes_head=True)
    promised = np.array(row["promised"]).reshape(-1, 2)
    axes.plot(*promised.T, "C0.-", ms=4)
    x, y, yaw = row["pose"]
    corners = 0.5 * np.array([[1, 1], [1, -1], [-1, -1], [-1, 1]]) * size
    turn = np.array([[np.cos(yaw), -np.sin(yaw)], [np.sin(yaw), np.cos(yaw)]])
    axes.fill(*(corners @ turn.T + [x, y]).T, color="C2", alpha=0.7)
    axes.plot(*place, "k*")
    axes.set(xlim=(place[0] - SIDE_M, place[0] + SIDE_M), ylim=(place[1] - 0.75 * SIDE_M, place[1] + 0.75 * SIDE_M), aspect="equal")
    axes.set_title(title, fontsize=9)


def draw_course(axes, rows, contact_s):
    near = [row for row in rows if contact_s - 4.0 < row["time_s"] < contact_s + 1.0]
    times = [row["time_s"] for row in near]
    axes.plot(times, [row["twist"][0] for row in near], label="speed [m/s]")
    axes.plot(times, [row["twist"][1] for row in near], label="yaw rate [rad/s]")
    gaps = [min((np.hypot(x - row["pose"][0], y - row["pose"][1]) - radius for x, y, radius in row["movers"]), default=np.nan)
            for row in near]
    axes.plot(times, gaps, label="robot's centre to the nearest mover [m]")
    axes.axvline(contact_s, color="0.5")
    last = None
    for row in near:
        if row["row"] != last:
            axes.text(row["time_s"], -1.9, row["row"], rotation=90, fontsize=7)
        last = row["row"]
    axes.set(ylim=(-2.0, 3.0), xlabel="time [s]")
    axes.legend(loc="upper right")
    axes.grid(alpha=0.3)


def draw_contacts(world, seed, out):
    result = benchmark.run("mover_trace", os.path.abspath(world), seed, LIMIT_S)
    size = footprint_of(world)
    times = np.array([row["time_s"] for row in result["rows"]])
    print(f"reached: {result['reached']}, after {result['time_s']} s; contacts: {len(result['contacts'])}")
    for number, contact in enumerate(result["contacts"], 1):
        figure = plt.figure(figsize=(20, 11))
        for i, before_s in enumerate(BEFORE_S):
            row = result["rows"][int(np.argmin(np.abs(times - contact["time_s"] + before_s)))]
            title = f"{-before_s:+.1f} s, {row['twist'][0]:.2f} m/s, {row['row']}"
            draw_moment(figure.add_subplot(3, 4, i + 1), row, contact["place"], size, title)
        draw_course(figure.add_subplot(3, 1, 3), result["rows"], contact["time_s"])
        figure.suptitle(f"with {contact['other']} after {contact['time_s']} s: {contact['blame']}, at {contact['speed_mps']} m/s, "
                        f"approaching at {contact['approach_mps']} m/s")
        figure.savefig(os.path.join(out, f"contact_{number:02}.png"), dpi=70, bbox_inches="tight")
        plt.close(figure)
