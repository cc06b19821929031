"""The map of a robot as a test hears it: whole grids, and updates of them."""

import math
import os
import sys
import threading

import rospy
from map_msgs.msg import OccupancyGridUpdate
from nav_msgs.msg import OccupancyGrid

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../scripts"))
from mocha_scripts.map_topics import NewestMap  # noqa: E402


class MapListener:
    def __init__(self, robot="ugv1"):
        self.grids = []  # as they came
        self.updates = []
        self._newest = NewestMap()
        self.changed = threading.Condition()
        self._subscribers = [rospy.Subscriber("/%s/map_updates" % robot, OccupancyGridUpdate, self._on_update, queue_size=1000),
                             rospy.Subscriber("/%s/map" % robot, OccupancyGrid, self._on_grid, queue_size=10)]

    def _on_grid(self, grid):
        with self.changed:
            self.grids.append(grid)
            self._newest.take_grid(grid)
            self.changed.notify_all()

    def _on_update(self, update):
        with self.changed:
            self.updates.append(update)
            self._newest.take_update(update)
            self.changed.notify_all()

    def unregister(self):
        for subscriber in self._subscribers:
            subscriber.unregister()

    @property
    def map(self):
        """The newest, or None."""
        return self._newest.grid

    def stamps_s(self):
        """When the map was as it was published, each publication once."""
        with self.changed:
            return sorted({message.header.stamp.to_sec() for message in self.grids + self.updates})

    def cell(self, x, y):
        """The value at a place; unknown outside."""
        grid = self.map
        column = math.floor((x - grid.info.origin.position.x) / grid.info.resolution)
        row = math.floor((y - grid.info.origin.position.y) / grid.info.resolution)
        if not (0 <= column < grid.info.width and 0 <= row < grid.info.height):
            return -1
        return grid.data[row * grid.info.width + column]
