"""Drives every DynaBARN world of a directory through the whole stack, lidar only: discs of 0.5 m that heed nobody, and jump at the end of their paths.

A drive counts as reached where the robot stands at its goal within 100 s. A contact does not end it. Whose a contact is, the ground truth says: the
robot's own where it moves, faster than 0.1 m/s at that place, unless it was run into from where its lidar does not look.
"""
from benchmarks import mover_drives

add_arguments, run = mover_drives.bench("dynabarn", limit_s=100.0)
