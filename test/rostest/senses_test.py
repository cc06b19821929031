#!/usr/bin/python3
"""A robot without scans, transforms or odometry stands still and says what it misses; with them it goes on."""

import sys
import unittest

import rospy
import rostest
from nav_msgs.msg import Odometry
from sensor_msgs.msg import LaserScan
from tf2_msgs.msg import TFMessage

from node_process import is_connected
from simulated_robot import SimulatedRobot
from waiting import wait_until

GOALS = ((4.5, -1.5), (-4.5, -1.5))
# Promised times, as in config/ [s].
LEASE_S = 0.5
MAP_AGE_S = 1.5
TRANSFORM_AGE_S = 0.5
POSE_AGE_S = 0.25
BRAKING_S = 1.0 / 0.8  # from full speed
SLACK_S = 0.5  # actuator lag, and the periods of the nodes and of the lidar


class Gate:
    """Lets a topic through while it is open."""

    def __init__(self, topic, kind, through):
        self.open = False
        self._out = rospy.Publisher(through, kind, queue_size=100, tcp_nodelay=True)
        rospy.Subscriber(topic, kind, self._on_message, tcp_nodelay=True)

    def _on_message(self, message):
        if self.open:
            self._out.publish(message)


class TransformGate(Gate):
    """Of the transforms, only map -> odom waits at the gate."""

    def _on_message(self, message):
        passing = [each for each in message.transforms if self.open or each.header.frame_id != "map"]
        if passing:
            self._out.publish(TFMessage(passing))


class SensesTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.scan = Gate("/ugv1/scan", LaserScan, "/through/scan")
        cls.odometry = Gate("/ugv1/odom", Odometry, "/through/odom")
        cls.transforms = TransformGate("/tf", TFMessage, "/through/tf")
        cls.robot = SimulatedRobot()
        cls.robot.start()

    def tearDown(self):
        self.assertEqual(self.robot.truth.contacts, 0)

    def far_goal(self):
        return max(GOALS, key=lambda each: self.robot.distance_to(*each))

    def check_does_not_move(self, *words):
        place = self.robot.place()
        self.robot.send(*self.far_goal())
        since = self.robot.now
        self.robot.run(5.0)
        for pattern in words:
            self.assertTrue(self.robot.said(pattern, since), (pattern, self.robot.report()))
        self.assertLess(self.robot.distance_to(*place), 0.01)

    def begin_anew(self):
        """The nodes start again, and hear nothing."""
        self.scan.open = self.odometry.open = self.transforms.open = False
        for node in ("perception", "trajectory_tracker", "local_replanner", "global_planner"):
            self.robot.dead_for(node, 0.02)
            self.robot.wait_for_node(node)
            wait_until(lambda: is_connected("/ugv1/" + node), node + " is connected")

    def test_it_does_not_set_off_without(self):
        self.begin_anew()
        self.check_does_not_move("perception: .*no scan on /through/scan for", "global_planner: .*no odometry on /through/odom yet")
        self.assertFalse(self.robot.done(), "it waits for its pose")
        self.odometry.open = self.scan.open = True
        self.check_does_not_move("perception: .*no transform map <- ugv1/laser",
                                 "global_planner: .*no transform map -> ugv1/odom",
                                 "trajectory_tracker: .*no transform map -> ugv1/odom")
        self.assertFalse(self.robot.done(), "it waits for its pose")
        self.scan.open = False
        self.robot.run(2.0)  # no scan is under way or waits for its transforms any more
        self.transforms.open = True
        self.check_does_not_move("perception: .*no scan on /through/scan for", "global_planner: .*no map on /ugv1/map yet",
                                 "local_replanner: .*map: none on /ugv1/map yet")
        self.assertFalse(self.robot.done(), "it waits for its map")
        self.scan.open = True
        self.robot.run_until(self.robot.done, 60.0, "it sets off when nothing is missing any more")
        self.assertEqual(self.robot.outcome()[0], "SUCCEEDED")

    def test_no_scan_while_driving(self):
        self.check_loss(self.scan, MAP_AGE_S + LEASE_S, "perception: .*no scan on /through/scan for",
                        "local_replanner: .*map: the newest on /ugv1/map is .* old")

    def test_no_transform_while_driving(self):
        self.check_loss(self.transforms, TRANSFORM_AGE_S, "local_replanner: .*no transform map -> ugv1/odom for")

    def test_no_odometry_while_driving(self):
        self.check_loss(self.odometry, POSE_AGE_S, "local_replanner: .*no odometry on /through/odom for")

    def check_loss(self, gate, noticed_s, *words):
        self.scan.open = self.odometry.open = self.transforms.open = True
        goal = self.far_goal()
        self.robot.send(*goal)
        self.robot.run_until(lambda: self.robot.truth.speed > 0.75 and abs(self.robot.place()[0]) < 3.5, 20.0,
                             "it drives at speed")
        gate.open = False
        lost_s = self.robot.now
        bound_s = noticed_s + BRAKING_S + SLACK_S
        self.robot.run(bound_s + 1.5)
        gate.open = True
        self.assertTrue(self.robot.stood_at(lost_s + bound_s), "it still moves; " + self.robot.report())
        self.assertGreater(self.robot.distance_to(*goal), 1.0, "it has reached its goal before it stopped")
        for pattern in words:
            self.assertTrue(self.robot.said(pattern, lost_s), (pattern, self.robot.report()))
        self.robot.run_until(self.robot.done, 60.0, "it goes on")
        self.assertEqual(self.robot.outcome()[0], "SUCCEEDED")
        self.assertLess(self.robot.distance_to(*goal), 0.2)


if __name__ == "__main__":
    rospy.init_node("senses_test")
    rostest.rosrun("mocha_ugv", "senses", SensesTest, sys.argv)
