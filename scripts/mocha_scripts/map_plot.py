"""Draws a map as it was driven: what scan_localizer saves of its pose graph."""
import os

import matplotlib
matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

from mocha_scripts.complaint import Complaint

INCHES_PER_M = 0.25
LONGEST_INCHES = 24.0


class DrivenMap:
    """Poses (x, y, yaw) of keyframes, what each hit as seen from there, and constraints (from, to, doubtful)."""

    def __init__(self, path):
        self.poses, self.hits, self.constraints = [], [], []
        try:
            with open(path) as file:
                for line in file:
                    self.read(line.split())
            self.poses = np.array(self.poses).reshape(-1, 3)
        except (OSError, UnicodeDecodeError, ValueError, IndexError) as error:
            raise Complaint(f"{path}: {error}") from error
        if not len(self.poses) or len(self.poses) != len(self.hits):
            raise Complaint(f"{path}: holds no keyframes, or some without scan")

    def read(self, words):
        if words[:1] == ["VERTEX_SE2"]:
            self.poses.append([float(word) for word in words[2:5]])
        elif words[:1] == ["KEYFRAME"]:
            self.hits.append(np.array(words[8:8 + 2 * int(words[7])], dtype=float).reshape(-1, 2))
        elif words[:1] == ["EDGE_SE2"]:
            self.constraints.append((int(words[1]), int(words[2]), words[-1] == "DOUBTFUL"))

    def walls(self):
        """All hits, in the map."""
        placed = []
        for (x, y, yaw), hits in zip(self.poses, self.hits):
            turn = np.array([[np.cos(yaw), -np.sin(yaw)], [np.sin(yaw), np.cos(yaw)]])
            placed.append(hits @ turn.T + (x, y))
        return np.concatenate(placed)

    def loops(self):
        """Ends of the constraints by which loops were closed: those in doubt, but for the odometry's."""
        return [(self.poses[start, :2], self.poses[end, :2]) for start, end, doubtful in self.constraints if doubtful and abs(end - start) > 1]


def draw_map(path, out):
    """Writes a picture that has the file's name. Returns its path."""
    driven = DrivenMap(path)
    walls = driven.walls()
    size_m = np.ptp(np.concatenate([walls, driven.poses[:, :2]]), axis=0) + 1.0
    inches = size_m * min(INCHES_PER_M, LONGEST_INCHES / size_m.max())
    figure, axes = plt.subplots(figsize=np.maximum(inches, 4.0))
    axes.plot(*walls.T, ",", color="black", alpha=0.6, zorder=2)
    axes.plot(driven.poses[:, 0], driven.poses[:, 1], color="tab:blue", lw=0.8, zorder=3, label=f"{len(driven.poses)} keyframes")
    for number, ends in enumerate(driven.loops()):
        axes.plot(*np.transpose(ends), color="tab:red", lw=0.6, alpha=0.6, zorder=4, label=None if number else "loops")
    axes.plot(*driven.poses[0, :2], "o", color="tab:green", ms=5, zorder=5, label="start")
    axes.set(aspect="equal", xlabel="x [m]", ylabel="y [m]")
    axes.legend(loc="upper right", fontsize=8)
    picture = os.path.join(out, os.path.splitext(os.path.basename(path))[0] + ".png")
    figure.savefig(picture, dpi=120, bbox_inches="tight")
    plt.close(figure)
    return picture
