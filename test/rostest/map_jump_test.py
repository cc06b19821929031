#!/usr/bin/python3
"""The map and the robot's place in it jump while it drives, as where a loop is closed: it goes on to its goal, without a contact."""

import math
import sys
import unittest

import rospy
import rostest
import tf2_ros
from geometry_msgs.msg import TransformStamped
from std_srvs.srv import Trigger

from simulated_robot import SimulatedRobot

LANE_Y = -1.5  # free from end to end
ENDS = (-4.5, 4.5)  # of the lane, x; at the first the robot, and its odometry, begin
# x, y, yaw of the simulator's world in the map [m, m, rad]
JUMPS = [(0.1, -0.1, 0.02), (-0.25, 0.2, -0.06), (0.4, 0.3, 0.1), (0.0, 0.0, 0.0)]
GOAL_TOLERANCE_M = 0.2


class MapJumpTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.static = tf2_ros.StaticTransformBroadcaster()
        cls.clear_map = rospy.ServiceProxy("/ugv1/clear_map", Trigger)
        cls.robot = SimulatedRobot()
        cls.put(0.0, 0.0, 0.0)
        cls.robot.start()

    @classmethod
    def put(cls, x, y, yaw):
        """From now on, that is where the world is in the map."""
        cls.world = (x, y, yaw)
        transform = TransformStamped()
        transform.header.frame_id, transform.child_frame_id = "map", "ugv1/odom"
        transform.transform.translation.x, transform.transform.translation.y = cls.in_map(ENDS[0], LANE_Y)
        transform.transform.rotation.z, transform.transform.rotation.w = math.sin(0.5 * yaw), math.cos(0.5 * yaw)
        cls.static.sendTransform([transform])

    @classmethod
    def in_map(cls, x, y):
        c, s = math.cos(cls.world[2]), math.sin(cls.world[2])
        return cls.world[0] + c * x - s * y, cls.world[1] + s * x + c * y

    def in_world(self, x, y):
        c, s = math.cos(self.world[2]), math.sin(self.world[2])
        x, y = x - self.world[0], y - self.world[1]
        return c * x + s * y, c * y - s * x

    def test_goes_on(self):
        for number, jump in enumerate(JUMPS):
            with self.subTest(jump=jump):
                goal = self.in_map(ENDS[(number + 1) % 2], LANE_Y)
                self.robot.send(*goal)
                self.robot.run_until(lambda: abs(self.robot.truth.speed) > 0.6, 20.0, "it is driving")
                self.put(*jump)
                self.assertTrue(self.clear_map().success)  # scan_localizer has perception make another one
                self.robot.run_until(self.robot.done, 60.0, "it reaches its goal")
                self.assertEqual(self.robot.outcome()[0], "SUCCEEDED", self.robot.report())
                self.assertLess(self.robot.distance_to(*self.in_world(*goal)), GOAL_TOLERANCE_M)
                self.robot.run_until(self.robot.standing, 1.0, "it stands")
        self.assertEqual(self.robot.truth.contacts, 0, self.robot.report())


if __name__ == "__main__":
    rospy.init_node("map_jump_test")
    rostest.rosrun("mocha_ugv", "map_jump", MapJumpTest, sys.argv)
