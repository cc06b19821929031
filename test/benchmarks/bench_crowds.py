"""Drives every world of recorded pedestrians of a directory through the whole stack, lidar only. They do not see the robot.

A drive counts as reached where the robot stands at its goal before the recordings end. A contact does not end it; see bench dynabarn for whose it is.
"""
from benchmarks import mover_drives

KIND = "crowd"
LIMIT_S = 90.0


def add_arguments(parser):
    mover_drives.add_arguments(parser, KIND)


def run(options):
    return mover_drives.run(options, KIND, LIMIT_S)
