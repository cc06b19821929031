"""Draws a recorded drive: map with trajectories, speed, acceleration and yaw rate against limits, clearance, separation."""
import math
import os

import matplotlib
matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
import rosbag
from matplotlib.collections import LineCollection

from mocha_scripts import bags, worlds
from mocha_scripts.map_topics import NewestMap

COLOURS = ["#1f77b4", "#d62728", "#2ca02c", "#9467bd", "#ff7f0e", "#17becf", "#8c564b", "#e377c2"]


class Track:
    """Ground truth of one robot over time."""

    def __init__(self):
        self.rows = []

    def add(self, stamp, truth):
        self.rows.append((stamp, truth.pose.x, truth.pose.y, truth.speed, truth.acceleration, truth.yaw_rate,
                          truth.clearance))

    def columns(self):
        names = ("time", "x", "y", "speed", "acceleration", "yaw_rate", "clearance")
        return dict(zip(names, np.array(self.rows).T))


def read_bag(path):
    """Tracks by robot, times and separations, and the last map of every robot."""
    tracks, separation, maps = {}, [], {}
    with rosbag.Bag(path) as bag:
        for topic, message, _ in bag.read_messages():
            if topic == "/fleet_simulator/ground_truth":
                stamp = message.header.stamp.to_sec()
                separation.append((stamp, message.min_separation))
                for truth in message.robots:
                    tracks.setdefault(truth.name, Track()).add(stamp, truth)
            elif topic.endswith(("/map", "/map_updates")):
                maps.setdefault(topic.strip("/").split("/")[0], NewestMap()).take(topic, message)
    maps = {name: newest.grid for name, newest in maps.items() if newest.grid is not None}
    return {name: track.columns() for name, track in tracks.items()}, np.array(separation), maps


def draw_known(axes, grid):
    """Free cells white, occupied ones black; nothing where nothing is known."""
    width, height, cell = grid.info.width, grid.info.height, grid.info.resolution
    cells = np.array(grid.data, dtype=np.int8).reshape(height, width)
    picture = np.zeros((height, width, 4))
    picture[(cells >= 0) & (cells < 50)] = 1.0
    picture[cells >= 50] = (0.0, 0.0, 0.0, 1.0)
    x, y = grid.info.origin.position.x, grid.info.origin.position.y
    axes.imshow(picture, origin="lower", interpolation="nearest", extent=(x, x + width * cell, y, y + height * cell))


def draw_grid(axes, grid):
    axes.set_facecolor("0.8")
    draw_known(axes, grid)


def draw_obstacles(axes, world):
    for x, y, radius in world.get("circles") or []:
        axes.add_patch(plt.Circle((x, y), radius, fill=False, lw=0.8, color="#cc7a00"))
    for polygon in world.get("polygons") or []:
        axes.add_patch(plt.Polygon(polygon, fill=False, lw=0.8, color="#cc7a00"))


def draw_map(tracks, maps, world, limits, path):
    bounds = world["bounds"]
    spans = [high - low for low, high in zip(bounds["min"], bounds["max"])]
    figure, axes = plt.subplots(figsize=(12, max(3.5, min(14, 12 * spans[1] / spans[0] + 1))))
    if maps:
        draw_grid(axes, maps[sorted(maps)[0]])
    draw_obstacles(axes, world)
    top = max(limit["max_speed"] for limit in limits.values())
    for i, (name, track) in enumerate(sorted(tracks.items())):
        points = np.column_stack((track["x"], track["y"])).reshape(-1, 1, 2)
        line = LineCollection(np.concatenate((points[:-1], points[1:]), axis=1), cmap="turbo", lw=2)
        line.set_array(np.abs(track["speed"][:-1]))
        line.set_clim(0, top)
        axes.add_collection(line)
        axes.plot(track["x"][0], track["y"][0], "o", color=COLOURS[i % len(COLOURS)], label=name)
    for robot in world["robots"]:
        if "goal" in robot:
            axes.plot(robot["goal"][0], robot["goal"][1], "*", ms=12, color="#2ca02c", mec="k")
    figure.colorbar(line, ax=axes, label="speed [m/s]", fraction=0.03, pad=0.01)
    axes.set(xlim=(bounds["min"][0], bounds["max"][0]), ylim=(bounds["min"][1], bounds["max"][1]), aspect="equal",
             xlabel="x [m]", ylabel="y [m]", title="Map from lidar, true obstacles (orange) and driven trajectories")
    axes.legend(loc="upper left")
    save(figure, path)


def draw_dynamics(tracks, limits, path):
    rows = [("speed", "max_speed", "speed [m/s]"), ("acceleration", "max_acceleration", "acceleration\nalong [m/s²]"),
            ("yaw_rate", "max_yaw_rate", "yaw rate [rad/s]")]
    figure, all_axes = plt.subplots(3, 1, figsize=(12, 8), sharex=True)
    for axes, (quantity, limit, label) in zip(all_axes, rows):
        for i, (name, track) in enumerate(sorted(tracks.items())):
            colour = COLOURS[i % len(COLOURS)]
            axes.plot(track["time"], track[quantity], color=colour, lw=1, label=name)
            for sign in (-1, 1):
                axes.axhline(sign * limits[name][limit], color=colour, ls="--", lw=0.7)
        axes.set_ylabel(label)
        axes.grid(alpha=0.3)
    all_axes[0].legend(loc="upper right")
    all_axes[0].set_title("Driven (solid) against limits (dashed), ground truth")
    all_axes[-1].set_xlabel("time [s]")
    save(figure, path)


def draw_clearance(tracks, limits, path):
    figure, axes = plt.subplots(figsize=(12, 4))
    for i, (name, track) in enumerate(sorted(tracks.items())):
        axes.plot(track["time"], track["clearance"], color=COLOURS[i % len(COLOURS)], lw=1, label=name)
    margins = ("margin_tracking", "margin_localisation", "margin_map")
    budget = max(sum(limit[margin] for margin in margins) for limit in limits.values())
    axes.axhline(budget, color="k", ls="--", lw=0.8, label="margin budget")
    axes.axhline(0, color="r", lw=0.8)
    axes.set(xlabel="time [s]", ylabel="footprint to obstacle [m]", title="Clearance, ground truth",
             ylim=(-0.05, min(3.0, max(track["clearance"].max() for track in tracks.values()) + 0.1)))
    axes.grid(alpha=0.3)
    axes.legend(loc="upper right")
    save(figure, path)


def draw_separation(separation, path):
    figure, axes = plt.subplots(figsize=(12, 4))
    axes.plot(separation[:, 0], separation[:, 1], lw=1)
    axes.axhline(0.8, color="r", ls="--", lw=0.8, label="0.8 m")
    axes.set(xlabel="time [s]", ylabel="centre to centre [m]", title="Smallest separation of two robots, ground truth",
             ylim=(0, None))
    axes.grid(alpha=0.3)
    axes.legend(loc="upper right")
    save(figure, path)


def save(figure, path):
    figure.tight_layout()
    figure.savefig(path, dpi=110)
    plt.close(figure)


def draw_drive(bag, world_path, out):
    """Writes map.png, dynamics.png, clearance.png and, for more than one robot, separation.png to the directory `out`."""
    world = worlds.read_world(world_path)
    bags.check_drive(bag, world, world_path)
    tracks, separation, maps = read_bag(bag)
    limits = {robot["name"]: worlds.robot_values(robot["model"]) for robot in world["robots"]}
    draw_map(tracks, maps, world, limits, os.path.join(out, "map.png"))
    draw_dynamics(tracks, limits, os.path.join(out, "dynamics.png"))
    draw_clearance(tracks, limits, os.path.join(out, "clearance.png"))
    if len(tracks) > 1 and math.isfinite(separation[:, 1].min()):
        draw_separation(separation, os.path.join(out, "separation.png"))
