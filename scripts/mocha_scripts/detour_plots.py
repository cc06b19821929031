"""Draws a recorded drive around what moves as the paper's Figs. 10 and 11: plan, local trajectories and rejoin points, and the clearance over time."""
import os

import matplotlib
matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
import rosbag
from matplotlib.patches import Circle

from mocha_scripts import bags, drive_plots, worlds

MOVER, PLAN, LOCAL, DRIVEN = "#f28e2b", "#1f77b4", "#c00000", "#222222"
EVERY_S = 1.5  # robot and people are drawn
DEEPEST_M = 3.0  # clearances beyond are cut off


class Recording:
    """What a bag says of one robot and of what it saw move."""

    def __init__(self, bag, robot):
        self.truth = []  # time, x, y, clearance
        self.plan = None  # the first global one
        self.detours = []  # (time, places up to the rejoin point, rejoin point)
        self.seen = []  # (time, x, y, radius) of what moves, as tracked
        with rosbag.Bag(bag) as messages:
            for topic, message, _ in messages.read_messages():
                self._read(topic.replace(f"/{robot}/", ""), message, robot)
        self.truth = np.array(self.truth)

    def _read(self, topic, message, robot):
        if topic == "/fleet_simulator/ground_truth":
            self.truth += [(message.header.stamp.to_sec(), one.pose.x, one.pose.y, one.clearance) for one in message.robots if one.name == robot]
        elif topic == "candidates" and self.plan is None:
            self.plan = next((places(one.path) for one in message.candidates if one.selected), None)
        elif topic == "predicted_obstacles":
            self.seen += [(message.header.stamp.to_sec(), thing.position.x, thing.position.y, thing.radius) for thing in message.obstacles]
        elif topic == "local_markers":
            self._read_detour(message)

    def _read_detour(self, message):
        parts = {marker.ns: marker for marker in message.markers}
        if "detour" not in parts or "rejoin point" not in parts:
            return
        path, rejoin_point = places(parts["detour"].points), parts["rejoin point"].pose.position
        if not self.detours or not np.array_equal(path, self.detours[-1][1]):
            self.detours.append((parts["detour"].header.stamp.to_sec(), path, (rejoin_point.x, rejoin_point.y)))

    def place_at(self, time_s):
        return [np.interp(time_s, self.truth[:, 0], self.truth[:, column]) for column in (1, 2)]


def places(points):
    return np.array([(point.x, point.y) for point in points])


def draw_scene(axes, recording, world, radius):
    drive_plots.draw_obstacles(axes, world)
    if recording.plan is not None:
        axes.plot(*recording.plan.T, color=PLAN, ls="--", lw=1.6, label="global plan")
    for k, (_, path, rejoin_point) in enumerate(recording.detours):
        first = k == 0
        axes.plot(*path.T, color=LOCAL, lw=3.0 if first else 1.0, alpha=0.6, label="local trajectories" if first else None)
        axes.plot(*rejoin_point, "s", color=LOCAL, ms=9 if first else 5, mec="k" if first else "none", ls="", label="rejoin points" if first else None)
    axes.plot(recording.truth[:, 1], recording.truth[:, 2], color=DRIVEN, lw=1.0, label="driven")
    start, end = recording.truth[0, 0], recording.truth[-1, 0]
    for time_s in np.arange(start, end, EVERY_S):
        axes.add_patch(Circle(recording.place_at(time_s), radius, fc="none", ec=DRIVEN, lw=0.8))
        axes.annotate(f"{time_s:.0f}", recording.place_at(time_s), ha="center", va="center", fontsize=7)
        now = [thing for thing in recording.seen if abs(thing[0] - time_s) < 0.06]
        for _, x, y, seen_radius in now:
            axes.add_patch(Circle((x, y), seen_radius, fc=MOVER, ec="#8a4b08", lw=0.6, alpha=0.5))
            axes.annotate(f"{time_s:.0f}", (x, y), ha="center", va="center", fontsize=7)
    axes.plot([], [], "o", color=MOVER, label="what moves, as tracked, with the time [s]")
    bounds = world["bounds"]
    axes.set(xlim=(bounds["min"][0], bounds["max"][0]), ylim=(bounds["min"][1], bounds["max"][1]), aspect="equal", xlabel="x [m]", ylabel="y [m]",
             title="Local replanning through lidar (as Fig. 10)")
    axes.legend(loc="upper right", fontsize=8)


def draw_clearance(axes, recording, threshold_m):
    axes.plot(recording.truth[:, 0], np.minimum(recording.truth[:, 3], DEEPEST_M), color=DRIVEN, lw=1.2, label="to the nearest obstacle, moving or not")
    axes.axhline(threshold_m, color=LOCAL, ls="--", lw=1.0, label=f"threshold {threshold_m:.2f} m")
    for k, (time_s, _, _) in enumerate(recording.detours):
        axes.axvline(time_s, color=LOCAL, lw=0.6, alpha=0.5, label=None if k else "local trajectories taken")
    axes.set(xlabel="time [s]", ylabel="clearance [m]", ylim=(0.0, None), title="Clearance, ground truth (as Fig. 11)")
    axes.grid(alpha=0.3)
    axes.legend(loc="upper right", fontsize=8)


def draw_detour(bag, world_path, out):
    """Writes detour.png to the directory `out`, of the first robot of the world."""
    world = worlds.read_world(world_path)
    bags.check_drive(bag, world, world_path)
    robot = world["robots"][0]
    values = worlds.robot_values(robot["model"])
    recording = Recording(bag, robot["name"])
    figure, axes = plt.subplots(2, 1, figsize=(12, 10), gridspec_kw={"height_ratios": [2, 1]})
    draw_scene(axes[0], recording, world, values["footprint_radius"])
    draw_clearance(axes[1], recording, threshold_m(values))
    drive_plots.save(figure, os.path.join(out, "detour.png"))
    return recording


def threshold_m(values):
    """What a promise in force keeps at least from the most likely course of what moves, less the tracking error."""
    return 0.7 * values["moving_clearance"]
