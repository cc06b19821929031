"""Draws a recorded drive as an animated picture: what the robots know of the world, where they are, and what they have promised."""
import os

import matplotlib
matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
import rosbag
import yaml
from matplotlib.patches import Polygon
from PIL import Image

from mocha_scripts import bags, costs_plots, drive_plots, worlds
from mocha_scripts.map_topics import NewestMap

FRAMES_PER_S = 12.5  # as GIF counts in hundredths
LONGER_SIDE_PX = 880
DPI = 100
COLOURS = 96  # of the whole picture; fewer make it smaller
LAST_S = 1.5  # the last frame stays so long
TRAIL_S = 4.0


class Recording:
    """By time: poses of each robot, its maps, and the places along what it has promised."""

    def __init__(self, bag, names):
        self.poses = {name: [] for name in names}  # time, x, y, yaw
        self.maps = {name: [] for name in names}  # (time, OccupancyGrid)
        self.promises = {name: [] for name in names}  # (time, places)
        newest = {name: NewestMap() for name in names}
        topics = [f"/{name}/{topic}" for name in names for topic in ("map", "map_updates", "committed_trajectory")]
        with rosbag.Bag(bag) as messages:
            for topic, message, stamp in messages.read_messages(topics + [bags.TRUTH]):
                if topic == bags.TRUTH:
                    for robot in message.robots:
                        self.poses[robot.name].append((message.header.stamp.to_sec(), robot.pose.x, robot.pose.y, robot.pose.theta))
                    continue
                name = topic.split("/")[1]
                if topic.endswith("committed_trajectory"):
                    self.promises[name].append((stamp.to_sec(), costs_plots.promised_places(message) if costs_plots.drives(message) else None))
                elif newest[name].take(topic, message) is not None:
                    self.maps[name].append((stamp.to_sec(), newest[name].grid))
        self.poses = {name: np.array(rows) for name, rows in self.poses.items() if rows}

    def begin_s(self):
        return min(rows[0, 0] for rows in self.poses.values())

    def end_s(self):
        """When the last robot came to rest."""
        return max(costs_plots.moving_s(rows[:, :3])[1] for rows in self.poses.values())

    def pose_at(self, name, time_s):
        rows = self.poses[name]
        return rows[max(0, np.searchsorted(rows[:, 0], time_s, side="right") - 1), 1:]

    def trail(self, name, time_s):
        rows = self.poses[name]
        return rows[(rows[:, 0] <= time_s) & (rows[:, 0] >= time_s - TRAIL_S), 1:3]

    @staticmethod
    def newest(rows, time_s):
        """The last of (time, what) by then; None where there is none."""
        return next((what for stamp, what in reversed(rows) if stamp <= time_s), None)


def rectangle(length, width):
    return np.array([(length, width), (-length, width), (-length, -width), (length, -width)]) / 2.0


def disc(radius):
    angles = np.linspace(0.0, 2.0 * np.pi, 32, endpoint=False)
    return radius * np.column_stack((np.cos(angles), np.sin(angles)))


def footprint(robot):
    """The corners of a robot of a world file, in base_link: its own, else those of its model."""
    if "radius" in robot:
        return disc(robot["radius"])
    if "footprint" in robot:
        return np.array(robot["footprint"]) if isinstance(robot["footprint"][0], list) else rectangle(*robot["footprint"])
    values = worlds.robot_values(robot["model"])
    if values["footprint"] == "polygon":
        return np.array(yaml.safe_load(values["footprint_corners"]))
    if values["footprint"] == "rectangle":
        return rectangle(values["footprint_length"], values["footprint_width"])
    return disc(values["footprint_radius"])


def placed(corners, pose):
    """A footprint in the map frame, and the line that says where its front is."""
    x, y, yaw = pose
    turn = np.array([(np.cos(yaw), np.sin(yaw)), (-np.sin(yaw), np.cos(yaw))])
    front = np.array([(0.0, 0.0), (corners[:, 0].max(), 0.0)])
    return corners @ turn + (x, y), front @ turn + (x, y)


def draw_frame(axes, recording, world, footprints, time_s):
    axes.clear()
    axes.set_facecolor("#b8b8b8")
    for maps in recording.maps.values():
        grid = recording.newest(maps, time_s)
        if grid is not None:
            drive_plots.draw_known(axes, grid)
    for robot in world["robots"]:
        if "goal" in robot:
            axes.plot(*robot["goal"][:2], "*", ms=13, color="w", mec="k", zorder=3)
    for i, name in enumerate(sorted(recording.poses)):
        colour = drive_plots.COLOURS[i % len(drive_plots.COLOURS)]
        promise = recording.newest(recording.promises[name], time_s)
        if promise is not None:
            axes.plot(*promise.T, color=colour, lw=5, alpha=0.45, solid_capstyle="round", zorder=4)
        axes.plot(*recording.trail(name, time_s).T, color=colour, lw=1.2, zorder=4)
        body, front = placed(footprints[name], recording.pose_at(name, time_s))
        axes.add_patch(Polygon(body, fc=colour, ec="k", lw=1.0, zorder=5))
        axes.plot(*front.T, color="w", lw=2, zorder=6)
    low, high = world["bounds"]["min"], world["bounds"]["max"]
    axes.set(xlim=(low[0], high[0]), ylim=(low[1], high[1]), aspect="equal", xticks=[], yticks=[])
    axes.annotate(f"{time_s - recording.begin_s():.0f} s", (0, 0), (6, 6), xycoords="axes fraction", textcoords="offset points", fontsize=10,
                  bbox={"boxstyle": "round,pad=0.2", "fc": "w", "ec": "none", "alpha": 0.8}, zorder=7)


def frames(recording, world, footprints, speed):
    low, high = (np.array(world["bounds"][end]) for end in ("min", "max"))
    figure = plt.figure(figsize=LONGER_SIDE_PX / DPI * (high - low) / max(high - low), dpi=DPI)
    axes = figure.add_axes((0, 0, 1, 1))
    for time_s in np.arange(recording.begin_s(), recording.end_s() + 1.0, speed / FRAMES_PER_S):
        draw_frame(axes, recording, world, footprints, time_s)
        figure.canvas.draw()
        yield Image.fromarray(np.asarray(figure.canvas.buffer_rgba())[:, :, :3])
    plt.close(figure)


def draw_animation(bag, world_path, out, speed):
    """Writes drive.gif to the directory `out`, `speed` times as fast as it was driven."""
    world = worlds.read_world(world_path)
    bags.check_drive(bag, world, world_path)
    footprints = {robot["name"]: footprint(robot) for robot in world["robots"]}
    recording = Recording(bag, list(footprints))
    pictures = list(frames(recording, world, footprints, speed))
    palette = pictures[len(pictures) // 2].quantize(COLOURS)  # one for all: only what moves changes from frame to frame
    pictures = [picture.quantize(palette=palette, dither=Image.Dither.NONE) for picture in pictures]
    durations = [int(1000 / FRAMES_PER_S)] * (len(pictures) - 1) + [int(1000 * LAST_S)]
    path = os.path.join(out, "drive.gif")
    pictures[0].save(path, save_all=True, append_images=pictures[1:], duration=durations, loop=0, optimize=True)
    return path
