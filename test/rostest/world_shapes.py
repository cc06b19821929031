"""The circles and walls of a world file, and how far places are from them."""

import numpy as np
import yaml


def load_shapes(path):
    """(circles as rows x, y, radius; polygons as lists of corners)."""
    with open(path) as file:
        world = yaml.safe_load(file)
    return np.array(world["circles"], dtype=float).reshape(-1, 3), world["polygons"]


def occupied_places(grid):
    """Centres of the occupied cells of an OccupancyGrid."""
    cells = np.array(grid.data, dtype=np.int8).reshape(grid.info.height, grid.info.width)
    rows, columns = np.nonzero(cells >= 50)
    origin = np.array((grid.info.origin.position.x, grid.info.origin.position.y))
    return origin + (np.column_stack((columns, rows)) + 0.5) * grid.info.resolution


def distance_to_circles(places, circles):
    """To the nearest rim, for every place."""
    if len(circles) == 0:
        return np.full(len(places), np.inf)
    offsets = places[:, None, :] - circles[None, :, :2]
    return np.abs(np.linalg.norm(offsets, axis=2) - circles[None, :, 2]).min(axis=1)


def distance_to_walls(places, polygons):
    nearest = np.full(len(places), np.inf)
    for polygon in polygons:
        for begin, end in zip(polygon, polygon[1:] + polygon[:1]):
            begin, along = np.array(begin), np.array(end) - np.array(begin)
            share = np.clip((places - begin) @ along / (along @ along), 0.0, 1.0)
            nearest = np.minimum(nearest, np.linalg.norm(places - begin - share[:, None] * along, axis=1))
    return nearest


def distance_to_surfaces(places, circles, polygons):
    return np.minimum(distance_to_circles(places, circles), distance_to_walls(places, polygons))
