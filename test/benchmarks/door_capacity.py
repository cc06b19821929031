"""The time in which the capacity of a door lets robots through that want to pass it in both directions, each straight to it and on to its goal.

Kinematic, with speed v, acceleration a, and s the distance that any two keep between their centres. A robot that starts d from the door is there after
d / v + v / 2a, at full speed, or later if it pleases; one that has passed it is at its goal, e away, after e / v + v / 2a. Two that follow each
other pass it s / v after one another. Two that come from opposite sides keep s only if they leave room: the door lets them come and go at a right
angle (45 degrees to either side of its axis, which a door twice as wide as the robots just allows), and they are nearest half way between, at
t v / sqrt(2) if the second passes t after the first: t = sqrt(2) s / v. The order is the best there is.
"""
import functools
import math

import yaml

TOLERANCE_S = 1e-3


def _order_exists(robots, last_s, follow_s, change_s):
    """Whether all can be at their goals by `last_s`. A robot is (its side, earliest at the door, from there to the goal)."""
    everyone = (1 << len(robots)) - 1

    @functools.lru_cache(maxsize=None)
    def earliest_s(passed, side):
        """When the last of those that passed, which came from `side`, can be at the door."""
        best = math.inf
        for i, (own_side, there_s, onward_s) in enumerate(robots):
            if own_side != side or not passed >> i & 1:
                continue
            before = passed & ~(1 << i)
            free_s = min(earliest_s(before, side) + follow_s, earliest_s(before, not side) + change_s) if before else 0.0
            passes_s = max(there_s, free_s)
            if passes_s + onward_s <= last_s:
                best = min(best, passes_s)
        return best

    return min(earliest_s(everyone, False), earliest_s(everyone, True)) < math.inf


def least_time_of(ways, pace):
    """`ways`: of each robot, whether it comes from the other side, and how far it is to the door and on to its goal [m]."""
    ramp_s = pace["speed_mps"] / (2.0 * pace["acceleration_mps2"])
    robots = [(bool(side), to_m / pace["speed_mps"] + ramp_s, from_m / pace["speed_mps"] + ramp_s) for side, to_m, from_m in ways]
    follow_s = pace["apart_m"] / pace["speed_mps"]
    change_s = math.sqrt(2.0) * follow_s
    low = max(there_s + onward_s for _, there_s, onward_s in robots) - TOLERANCE_S
    high = max(there_s for _, there_s, _ in robots) + len(robots) * change_s + max(onward_s for _, _, onward_s in robots)
    while high - low > TOLERANCE_S:
        middle = 0.5 * (low + high)
        if _order_exists(robots, middle, follow_s, change_s):
            high = middle
        else:
            low = middle
    return high


def least_time_s(path, door, pace):
    """Of a world file whose robots all have to pass `door`, a wall along y."""
    with open(path, encoding="utf-8") as file:
        world = yaml.safe_load(file)
    ways = [(robot["start"][0] > door[0], math.dist(robot["start"][:2], door), math.dist(door, robot["goal"][:2])) for robot in world["robots"]]
    return least_time_of(ways, pace)
