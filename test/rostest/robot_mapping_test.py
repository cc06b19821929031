#!/usr/bin/python3
"""A robot that knows nothing drives through a flat and back, makes a map of it, and saves it."""

import os
import sys
import tempfile
import unittest

import rospy
import rostest
from mocha_ugv.srv import SaveMap

from simulated_robot import SimulatedRobot

WAYPOINTS = [(1.0, 3.5), (6.2, 0.8), (6.0, 3.4), (0.0, 0.0)]  # all three rooms
MAP_ERROR_M = 0.25  # the map grows with the robot's own errors, far from where it began


class RobotMappingTest(unittest.TestCase):
    def test_maps_a_flat(self):
        robot = SimulatedRobot("ugv3")
        robot.start()
        for x, y in WAYPOINTS:
            robot.send(x, y)
            robot.run_until(robot.done, 90.0, "it reaches (%.1f, %.1f) of its map" % (x, y))
            self.assertEqual(robot.outcome()[0], "SUCCEEDED", robot.report())
            self.assertLess(robot.distance_to(x, y), MAP_ERROR_M, robot.report())
            print("%.3f m from (%.1f, %.1f)" % (robot.distance_to(x, y), x, y))
        self.assertEqual(robot.truth.contacts, 0)
        with tempfile.TemporaryDirectory() as directory:
            answer = rospy.ServiceProxy("/ugv3/save_map", SaveMap)(os.path.join(directory, "flat.bt"))
            self.assertTrue(answer.success, answer.message)
            self.assertGreater(os.path.getsize(os.path.join(directory, "flat.bt")), 10000)


if __name__ == "__main__":
    rospy.init_node("robot_mapping_test")
    rostest.rosrun("mocha_ugv", "robot_mapping", RobotMappingTest, sys.argv)
