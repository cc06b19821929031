"""Drives every world of recorded pedestrians of a directory through the whole stack, lidar only. They do not see the robot.

A drive counts as reached where the robot stands at its goal before the recordings end. A contact does not end it; see bench dynabarn for whose it is.
"""
from benchmarks import mover_drives

add_arguments, run = mover_drives.bench("crowd", limit_s=90.0)
