"""Seeded halls with people who walk there and back, so that they meet a robot that drives through."""
import math
import random

LENGTH_M, HALF_M, WALL_M = 16.0, 3.5, 0.2
START, GOAL_X = (1.5, 0.0), 14.5
PEOPLE, BOXES = 3, 3
WATCHED_S = 45.0  # people do not run into each other so long
KINDS = ("crossing", "head_on", "walking_ahead")


def box(x0, y0, x1, y1):
    return [[round(x, 3), round(y, 3)] for x, y in ((x0, y0), (x1, y0), (x1, y1), (x0, y1))]


def walls():
    far, side = LENGTH_M + WALL_M, HALF_M + WALL_M
    return [box(-WALL_M, HALF_M, far, side), box(-WALL_M, -side, far, -HALF_M),
            box(-WALL_M, -HALF_M, 0.0, HALF_M), box(LENGTH_M, -HALF_M, far, HALF_M)]


def passing_time_s(x):
    """About when the robot passes, undisturbed."""
    return 3.4 + (x - START[0]) / 0.97


class Walk:
    """There and back between two points, standing at each for `turn_s`; begins so as to be at `meeting` (0 to 1 of the way there)
    at a time, if it stands nowhere before."""

    def __init__(self, radius, speed, ends, meeting, meet_s, turn_s):
        self.radius, self.speed, self.ends = radius, speed, ends
        self.walk_s = math.dist(*ends) / speed
        self.leg_s = self.walk_s + turn_s
        self.begin_s = (meeting * self.walk_s - meet_s) % (2.0 * self.leg_s)

    def place(self, t):
        leg, since_s = divmod((self.begin_s + t) % (2.0 * self.leg_s), self.leg_s)
        share = min(1.0, since_s / self.walk_s)
        return tuple(a + share * (b - a) for a, b in zip(*(self.ends if leg == 0 else self.ends[::-1])))

    def as_dict(self):
        """With a keyframe wherever it stops or sets off."""
        again_s = 2.0 * self.leg_s
        changes_s = (0.0, self.walk_s, self.leg_s, self.leg_s + self.walk_s)
        times_s = {0.0, round(again_s, 3)} | {round((change_s - self.begin_s) % again_s, 3) for change_s in changes_s}
        return {"radius": round(self.radius, 3), "repeat": True,
                "keyframes": [[t, *(round(value, 3) for value in self.place(t))] for t in sorted(times_s)]}


def draw_walk(draw, goal, turn_s):
    kind = draw.choice(KINDS)
    radius, speed = draw.uniform(0.25, 0.3), draw.uniform(0.4, 1.2)
    x = draw.uniform(4.5, 11.5)
    y = START[1] + (x - START[0]) / (goal[0] - START[0]) * (goal[1] - START[1])  # of the robot's way
    if kind == "crossing":
        skew_m = draw.uniform(-1.0, 1.0)
        ends = [(x - skew_m, -HALF_M + 0.6), (x + skew_m, HALF_M - 0.6)]
        ends = ends if draw.random() < 0.5 else ends[::-1]
        meeting = (y - ends[0][1]) / (ends[1][1] - ends[0][1])
    else:
        aside_m = draw.uniform(-0.3, 0.3)
        ends = [(3.8, y + aside_m), (12.6, y + aside_m)]
        if kind == "head_on":
            ends = ends[::-1]
        else:
            speed = draw.uniform(0.4, 0.6)
        meeting = (x - ends[0][0]) / (ends[1][0] - ends[0][0])
    return Walk(radius, speed, ends, meeting, passing_time_s(x) + draw.uniform(-0.5, 0.5), turn_s)


def fair(walk, others, goal):
    times = [0.1 * i for i in range(int(10 * WATCHED_S))]
    if any(math.dist(walk.place(t), place) < 1.4 + walk.radius for t in times for place in (START, goal)):
        return False
    return all(math.dist(walk.place(t), other.place(t)) > walk.radius + other.radius + 0.1 for other in others for t in times)


def draw_box(draw, walks):
    """Along a wall, out of the others' way."""
    while True:
        x, width, depth = draw.uniform(2.5, 12.5), draw.uniform(0.5, 0.9), draw.uniform(0.4, 0.8)
        y = HALF_M - depth if draw.random() < 0.5 else -HALF_M
        near = lambda walk, place: math.hypot(max(x - place[0], 0.0, place[0] - x - width),
                                              max(y - place[1], 0.0, place[1] - y - depth)) < walk.radius + 0.2
        if not any(near(walk, walk.place(0.1 * i)) for walk in walks for i in range(int(10 * WATCHED_S))):
            return box(x, y, x + width, y + depth)


def crossing_world(seed, turn_s=0.0):
    """The contents of a world file whose people stand for `turn_s` where they turn round."""
    draw = random.Random(seed)
    goal = (GOAL_X, round(draw.uniform(-1.0, 1.0), 2))
    walks = []
    while len(walks) < PEOPLE:
        walk = draw_walk(draw, goal, turn_s)
        if fair(walk, walks, goal):
            walks.append(walk)
    boxes = [draw_box(draw, walks) for _ in range(BOXES)]
    side = HALF_M + WALL_M
    return {"bounds": {"min": [-WALL_M, -side], "max": [LENGTH_M + WALL_M, side]}, "polygons": walls() + boxes,
            "moving": [walk.as_dict() for walk in walks],
            "robots": [{"name": "ugv1", "model": "rover", "start": [*START, 0.0], "goal": list(goal)}]}
