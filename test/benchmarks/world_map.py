"""The map of a world file, as a robot that has seen all of it would have saved it: surfaces occupied, what is behind them unknown."""
import os

import numpy

DEPTH_M = 0.05  # of a surface
OCCUPIED, UNKNOWN, FREE = 0, 205, 254  # grey, as map_server has it


def circle_depth(cx, cy, radius):
    return lambda x, y: radius - numpy.hypot(x - cx, y - cy)


def wall_depth(low, high):
    return lambda x, y: numpy.minimum(numpy.minimum(x - low[0], high[0] - x), numpy.minimum(y - low[1], high[1] - y))


def solids(world):
    """Each with its lower and upper corner, and how deep places are inside of it [m]."""
    for cx, cy, radius in world.get("circles", []):
        yield (cx - radius, cy - radius), (cx + radius, cy + radius), circle_depth(cx, cy, radius)
    for corners in world.get("polygons", []):  # convex ones, which walls are
        low, high = numpy.min(corners, axis=0), numpy.max(corners, axis=0)
        if {tuple(corner) for corner in corners} != {(a, b) for a in (low[0], high[0]) for b in (low[1], high[1])}:
            raise ValueError("only walls along the axes are drawn")
        yield low, high, wall_depth(low, high)


def depths(world, x, y):
    """How deep the centres of cells, at ascending x and y, are inside the world's solids [m]; negative outside, where it is not exact."""
    depth = numpy.full((len(y), len(x)), -numpy.inf)
    for low, high, depth_in in solids(world):
        columns, rows = (slice(numpy.searchsorted(centres, low[axis]), numpy.searchsorted(centres, high[axis], side="right"))
                         for axis, centres in enumerate((x, y)))
        depth[rows, columns] = numpy.maximum(depth[rows, columns], depth_in(x[None, columns], y[rows, None]))
    return depth


def write(world, resolution_m, path):
    """Writes path (a .yaml) and the image beside it."""
    low, high = numpy.array(world["bounds"]["min"]), numpy.array(world["bounds"]["max"])
    cells = numpy.ceil((high - low) / resolution_m - 1e-6).astype(int)
    x, y = (low[axis] + resolution_m * (numpy.arange(cells[axis]) + 0.5) for axis in (0, 1))
    depth = depths(world, x, y)[::-1]
    grey = numpy.select([depth < 0.0, depth < DEPTH_M], [FREE, OCCUPIED], UNKNOWN).astype(numpy.uint8)
    image = os.path.splitext(path)[0] + ".pgm"
    with open(image, "wb") as file:
        file.write(b"P5\n%d %d\n255\n" % tuple(cells) + grey.tobytes())
    with open(path, "w") as file:
        file.write(f"image: {os.path.basename(image)}\nresolution: {resolution_m}\norigin: [{low[0]}, {low[1]}, 0]\n"
                   "negate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n")
