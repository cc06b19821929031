#!/usr/bin/python3
"""A robot drives through base_driver, a serial line and the emulated firmware, whose ends die on the way: it stands within what was
promised, and goes on."""

import sys
import unittest

import rospy
import rostest
from nav_msgs.msg import Odometry

from simulated_robot import SimulatedRobot

ENDS = (-4.5, 4.5)  # of the lane, x
LANE_Y = -1.5
HEARTBEAT_S = 0.3
COMMAND_AGE_S = 0.3  # of the simulated wheels, where the firmware itself is gone
STOP_S = 1.0 / 2.5 + 5.0 * 0.05  # from full speed, as fast as the wheels can, and their lag
SLACK_S = 0.2  # periods of the nodes


class SerialStackTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.robot = SimulatedRobot()
        cls.odometry = []
        rospy.Subscriber("/ugv1/odom", Odometry, cls.odometry.append)
        cls.robot.start()

    def far_end(self):
        return max(ENDS, key=lambda end: self.robot.distance_to(end, LANE_Y))

    def drive_to_speed(self):
        x = self.far_end()
        self.robot.send(x, LANE_Y)
        self.robot.run_until(lambda: self.robot.truth.speed > 0.75 and abs(self.robot.place()[0]) < 3.5, 20.0, "it drives at speed")
        return x

    def check_kill(self, node, bound_s):
        x = self.drive_to_speed()
        killed_s = self.robot.now
        self.robot.dead_for(node, bound_s + 1.5)
        self.assertTrue(self.robot.stood_at(killed_s + bound_s), "it still moves; " + self.robot.report())
        self.assertGreater(self.robot.distance_to(x, LANE_Y), 1.0, "it has reached its goal before it stopped")
        self.robot.wait_for_node(node)
        self.robot.run_until(self.robot.done, 60.0, "it goes on after the respawn of " + node)
        self.assertEqual(self.robot.outcome()[0], "SUCCEEDED", self.robot.report())
        self.assertLess(self.robot.distance_to(x, LANE_Y), 0.2)
        self.assertEqual(self.robot.truth.contacts, 0)

    def test_arrives(self):
        self.robot.arrive(self.far_end(), LANE_Y)
        self.assertEqual(self.robot.truth.contacts, 0)
        self.assertTrue(all(odometry.pose.covariance[0] > 0.0 for odometry in self.odometry), "the driver's, not the simulator's")
        self.assertGreater(len(self.odometry), 100)

    def test_base_driver(self):
        self.check_kill("base_driver", HEARTBEAT_S + STOP_S + SLACK_S)

    def test_base_emulator(self):
        self.check_kill("base_emulator", COMMAND_AGE_S + STOP_S + SLACK_S)


if __name__ == "__main__":
    rospy.init_node("serial_stack_test")
    rostest.rosrun("mocha_ugv", "serial_stack", SerialStackTest, sys.argv)
