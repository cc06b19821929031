#!/usr/bin/python3
"""What walks in front of a robot is published as such and does not enter the map."""

import math
import sys
import unittest

import rospy
import rostest
from mocha_ugv.msg import PredictedObstacles

from map_listener import MapListener
from simulated_robot import SimulatedRobot

# As in test/worlds/walker.yaml.
START_S = 1.0  # of the simulation
FROM_M, TO_M, X_M, SPEED = -2.5, 2.5, 2.5, 0.8
LEG_S = (TO_M - FROM_M) / SPEED
SETTLED_S = 1.0  # after a turn


def walker(now):
    """y and its rate, and how long ago the walker turned."""
    legs, since = divmod(now - START_S, LEG_S)
    if legs % 2 == 0:
        return FROM_M + SPEED * since, SPEED, since
    return TO_M - SPEED * since, -SPEED, since


class MovingThingsTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.predictions = []
        rospy.Subscriber("/ugv1/predicted_obstacles", PredictedObstacles, cls.predictions.append)
        cls.maps = MapListener()
        cls.robot = SimulatedRobot()
        cls.robot.start()

    def occupied_at(self, x, y):
        return self.maps.cell(x, y) == 100

    def test_somebody_walks(self):
        begun = len(self.predictions)
        self.robot.run(20.0)
        self.robot.settle()
        predictions = self.predictions[begun:]
        self.assertGreater(len(predictions), 150, "one for each scan")
        self.assertEqual(self.predictions[0].obstacles, [], "nothing is known to move at first, and it says so")
        checked = 0
        for message in predictions:
            self.assertEqual(message.header.frame_id, "map")
            checked += self.walks_as_predicted(message)
        self.assertGreater(checked, 60)
        self.assertTrue(self.robot.said("perception: moving things: tracked"), self.robot.report())
        for y in (-2.0, -1.0, 0.0, 1.0, 2.0):
            for x in (2.25, 2.3, 2.35, 2.4, 2.5):
                self.assertFalse(self.occupied_at(x, y), (x, y))

    def walks_as_predicted(self, message):
        """Whether the message fell into a time of steady walking; then it must be right."""
        now = message.header.stamp.to_sec()
        y, rate, since = walker(now)
        if now < START_S + LEG_S or since < SETTLED_S:
            return False
        self.assertEqual(len(message.obstacles), 1, now)
        seen = message.obstacles[0]
        self.assertLess(math.hypot(seen.position.x - X_M, seen.position.y - y), 0.15, now)
        self.assertLess(math.hypot(seen.velocity.x, seen.velocity.y - rate), 0.25, now)
        self.assertAlmostEqual(seen.radius, 0.25, delta=0.1)
        return True

    def test_the_robot_drives_and_nothing_else_moves(self):
        begun = len(self.predictions)
        for goal in ((-3.0, 2.0), (-3.0, -2.0), (0.0, 0.0)):
            self.robot.arrive(*goal)
        predictions = self.predictions[begun:]
        self.assertGreater(len(predictions), 80)
        seen = 0
        for message in predictions:
            now = message.header.stamp.to_sec()
            for thing in message.obstacles:
                self.assertLess(math.hypot(thing.position.x - X_M, thing.position.y - walker(now)[0]), 0.5, (now, thing))
            seen += len(message.obstacles)
        self.assertGreater(seen, 0.8 * len(predictions))


if __name__ == "__main__":
    rospy.init_node("moving_things_test")
    rostest.rosrun("mocha_ugv", "moving_things", MovingThingsTest, sys.argv)
