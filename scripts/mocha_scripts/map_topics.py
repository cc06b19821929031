"""The newest map from the whole grids on `map` and what changes on `map_updates`."""
import copy

import numpy as np


class NewestMap:
    """Put together as the nodes do it (src/ros_bridge/inputs/map_source.h), but nothing is asked for anew."""

    def __init__(self):
        self.grid = None  # an OccupancyGrid, its data an array; another one after each change
        self._grid_stamp = None
        self._awaited = None  # stamp of a grid that was announced
        self._waiting = []  # updates that follow it

    def take_grid(self, grid):
        if self._awaited is not None and grid.header.stamp < self._awaited:
            return
        whole = copy.copy(grid)
        whole.data = np.array(grid.data, dtype=np.int8)
        self.grid, self._grid_stamp, self._awaited = whole, grid.header.stamp, None
        waiting, self._waiting = self._waiting, []
        for update in waiting:
            self.take_update(update)

    def take_update(self, update):
        if self.grid is None or self._awaited is not None:
            self._waiting.append(update)
        elif update.header.stamp <= self._grid_stamp:
            return  # the grid contains it
        elif update.width == 0:
            self._awaited = update.header.stamp
        else:
            self._apply(update)

    def _apply(self, update):
        grid = copy.copy(self.grid)
        grid.header = update.header
        grid.data = self.grid.data.copy()
        rows = grid.data.reshape(grid.info.height, grid.info.width)
        rows[update.y:update.y + update.height, update.x:update.x + update.width] = np.array(update.data, dtype=np.int8).reshape(
            update.height, update.width)
        self.grid = grid

    def take(self, topic, message):
        """What a bag holds of either topic."""
        if topic.endswith("/map"):
            self.take_grid(message)
        else:
            self.take_update(message)
        return self.grid
