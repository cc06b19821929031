"""The quickest plan of a puzzle of cells, by joint A*: in a step each robot stays or goes to a neighbouring cell that nobody is at or comes to afterwards;
two do not swap. Cells are square, as many as fit between the outer walls of a world."""
import heapq
import itertools

import numpy
import yaml

CELL_M = 1.2
SPEED_MPS = 1.0  # of the rover


def _covers(polygon, point):
    """Whether a convex polygon holds a point."""
    corners = numpy.array(polygon)
    sides = numpy.roll(corners, -1, axis=0) - corners
    to_point = numpy.array(point) - corners
    crosses = sides[:, 0] * to_point[:, 1] - sides[:, 1] * to_point[:, 0]
    return bool((crosses > 0).all() or (crosses < 0).all())


def _cell_of(place):
    cell = tuple(round(coordinate / CELL_M - 0.5) for coordinate in place[:2])
    if any(abs((index + 0.5) * CELL_M - coordinate) > 1e-6 for index, coordinate in zip(cell, place)):
        raise ValueError(f"{place} is not the centre of a cell of {CELL_M} m")
    return cell


def _neighbours(world):
    """Of each free cell: itself, and the free ones beside it."""
    size = [round((high - low - 0.4) / CELL_M) for low, high in zip(world["bounds"]["min"], world["bounds"]["max"])]
    centre = {cell: [(index + 0.5) * CELL_M for index in cell] for cell in itertools.product(*map(range, size))}
    free = {cell for cell, point in centre.items() if not any(_covers(polygon, point) for polygon in world["polygons"])}
    return {(x, y): [each for each in ((x, y), (x + 1, y), (x - 1, y), (x, y + 1), (x, y - 1)) if each in free] for x, y in free}


def _steps_to(goal, neighbours):
    steps = {goal: 0}
    front = [goal]
    while front:
        front = [cell for each in front for cell in neighbours[each] if steps.setdefault(cell, steps[each] + 1) == steps[each] + 1]
        front = list(dict.fromkeys(front))
    return steps


def _joint_steps(here, neighbours):
    for there in itertools.product(*(neighbours[cell] for cell in here)):
        if len(set(there)) == len(there) and not any(here[i] == there[j] and here[j] == there[i] for i in range(len(here)) for j in range(i)):
            yield there


def least_steps(path):
    """The steps of the quickest plan of a world file; None where there is none."""
    with open(path, encoding="utf-8") as file:
        world = yaml.safe_load(file)
    neighbours = _neighbours(world)
    start = tuple(_cell_of(robot["start"]) for robot in world["robots"])
    goal = tuple(_cell_of(robot["goal"]) for robot in world["robots"])
    steps_to = [_steps_to(cell, neighbours) for cell in goal]

    def left(cells):
        return max(steps[cell] for steps, cell in zip(steps_to, cells))

    best = {start: 0}
    queue = [(left(start), 0, start)]
    while queue:
        _, negative, here = heapq.heappop(queue)
        if here == goal:
            return best[here]
        if -negative > best[here]:
            continue
        for there in _joint_steps(here, neighbours):
            if best[here] + 1 < best.get(there, 1 << 30):
                best[there] = best[here] + 1
                heapq.heappush(queue, (best[there] + left(there), -best[there], there))
    return None


def least_time_s(path):
    steps = least_steps(path)
    return None if steps is None else steps * CELL_M / SPEED_MPS
