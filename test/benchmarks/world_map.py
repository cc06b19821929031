"""The map of a world file, as a robot that has seen all of it would have saved it: surfaces occupied, what is behind them unknown."""
import os

import numpy

DEPTH_M = 0.05  # of a surface
OCCUPIED, UNKNOWN, FREE = 0, 205, 254  # grey, as map_server has it


def depths(world, x, y):
    """How deep points are inside the world's solids [m]; negative outside, where it is not exact."""
    depth = numpy.full(numpy.broadcast(x, y).shape, -numpy.inf)
    for cx, cy, radius in world.get("circles", []):
        depth = numpy.maximum(depth, radius - numpy.hypot(x - cx, y - cy))
    for corners in world.get("polygons", []):  # convex ones, which walls are
        lows, highs = numpy.min(corners, axis=0), numpy.max(corners, axis=0)
        if {tuple(corner) for corner in corners} != {(a, b) for a in (lows[0], highs[0]) for b in (lows[1], highs[1])}:
            raise ValueError("only walls along the axes are drawn")
        depth = numpy.maximum(depth, numpy.minimum(numpy.minimum(x - lows[0], highs[0] - x), numpy.minimum(y - lows[1], highs[1] - y)))
    return depth


def write(world, resolution_m, path):
    """Writes path (a .yaml) and the image beside it."""
    low, high = numpy.array(world["bounds"]["min"]), numpy.array(world["bounds"]["max"])
    cells = numpy.ceil((high - low) / resolution_m - 1e-6).astype(int)
    x = low[0] + resolution_m * (numpy.arange(cells[0]) + 0.5)
    y = low[1] + resolution_m * (numpy.arange(cells[1]) + 0.5)
    depth = depths(world, x[None, :], y[::-1, None])
    grey = numpy.select([depth < 0.0, depth < DEPTH_M], [FREE, OCCUPIED], UNKNOWN).astype(numpy.uint8)
    image = os.path.splitext(path)[0] + ".pgm"
    with open(image, "wb") as file:
        file.write(b"P5\n%d %d\n255\n" % tuple(cells) + grey.tobytes())
    with open(path, "w") as file:
        file.write(f"image: {os.path.basename(image)}\nresolution: {resolution_m}\norigin: [{low[0]}, {low[1]}, 0]\n"
                   "negate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n")
