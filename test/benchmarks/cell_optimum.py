"""The quickest plan of a puzzle of cells, by breadth-first search from both ends: in a step each robot stays or goes to a neighbouring
cell that nobody is at or comes to afterwards; two do not swap. Cells are square, as many as fit between the outer walls of a world."""
import itertools

import numpy
import yaml

CELL_M = 1.2
SPEED_MPS = 1.0  # of the rover
ROWS_AT_ONCE = 20000  # for memory


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


def _steps_between(neighbours):
    """From each cell to each, for one robot alone; -1 where there is no way."""
    steps = numpy.full((len(neighbours), len(neighbours)), -1)
    for start, row in enumerate(steps):
        front = [start]
        while front:
            row[front] = row.max() + 1
            front = [cell for cell in numpy.unique(neighbours[front]) if cell >= 0 and row[cell] < 0]
    return steps


def _joint_steps(here, neighbours, allowed):
    """All that can follow: rows of a cell for each robot, of such rows. `allowed` tells for each robot and cell whether it may be there."""
    there = here[:, :0]
    for robot in range(here.shape[1]):
        options = neighbours[here[:, robot]]
        row, choice = numpy.nonzero((options >= 0) & allowed[robot][options])
        here, before, cell = here[row], there[row], options[row, choice][:, None]
        taken = before == cell
        swapped = (before == here[:, [robot]]) & (here[:, :robot] == cell)
        free = ~(taken | swapped).any(axis=1)
        here, there = here[free], numpy.hstack([before, cell])[free]
    return there


def _reached(start, neighbours, steps, allowed_after):
    """All rows that can be reached in so many steps, as sorted numbers, and whether the last of them reached a new one."""
    place_values = len(neighbours) ** numpy.arange(start.size)
    front = reached = numpy.array([start @ place_values])
    for step in range(1, steps + 1):
        rows = (front[:, None] // place_values % len(neighbours)).astype(numpy.int16)
        parts = numpy.array_split(rows, len(rows) // ROWS_AT_ONCE + 1)
        after = [numpy.unique(_joint_steps(part, neighbours, allowed_after(step)) @ place_values) for part in parts]
        front = numpy.setdiff1d(numpy.concatenate(after), reached)
        reached = numpy.union1d(reached, front)
    return reached, front.size > 0


def least_steps(path):
    """The steps of the quickest plan of a world file; None where there is none.

    In so many steps are those plans of which the first half, and the second one backwards, meet; a robot is nowhere from where it
    could not come to its end, all alone, in the steps that are left."""
    with open(path, encoding="utf-8") as file:
        world = yaml.safe_load(file)
    cells = _neighbours(world)
    index = {cell: number for number, cell in enumerate(cells)}
    neighbours = numpy.array([[index[each] for each in near] + [-1] * (5 - len(near)) for near in cells.values()], numpy.int16)
    start, goal = (numpy.array([index[_cell_of(robot[end])] for robot in world["robots"]]) for end in ("start", "goal"))
    if len(cells) ** len(start) >= 1 << 63:
        raise ValueError(f"{len(start)} robots on {len(cells)} cells are too many to be numbered")
    between = _steps_between(neighbours)
    if between[start, goal].min() < 0:
        return None
    for steps in itertools.count(between[start, goal].max()):
        halves = [_reached(end, neighbours, half, lambda step, other=other: between[other] <= steps - step)
                  for end, other, half in ((start, goal, steps // 2), (goal, start, steps - steps // 2))]
        if numpy.isin(halves[0][0], halves[1][0]).any():
            return int(steps)
        if steps // 2 > between.max() and not all(grows for _, grows in halves):
            return None


def least_time_s(path):
    steps = least_steps(path)
    return None if steps is None else steps * CELL_M / SPEED_MPS
