#!/usr/bin/python3
"""robot.launch has all that a robot needs: it drives to a goal in another room."""

import sys
import unittest
import xml.etree.ElementTree as ElementTree

import rospy
import rostest
from tf2_msgs.msg import TFMessage

from simulated_robot import SimulatedRobot

GOAL = (6.0, 3.4)
MOUNT = (0.04, 0.0, 0.12)  # of waveshare_rover's lidar


class RobotLaunchTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.mounts = {}  # publisher, parent, child -> place
        rospy.Subscriber("/tf_static", TFMessage, cls.take)
        cls.robot = SimulatedRobot("ugv3")
        cls.robot.start()

    @classmethod
    def take(cls, message):
        publisher = message._connection_header["callerid"]
        for transform in message.transforms:
            place = transform.transform.translation
            cls.mounts[publisher, transform.header.frame_id, transform.child_frame_id] = (place.x, place.y, place.z)

    def test_arrives(self):
        self.robot.arrive(*GOAL)
        self.assertEqual(self.robot.truth.contacts, 0)

    def test_frames(self):
        self.robot.run_until(lambda: len(self.mounts) >= 3, 10.0, "all mounts are told")
        self.assertEqual(self.mounts["/ugv3/robot_state_publisher", "ugv3/base_link", "ugv3/laser"], MOUNT)
        self.assertEqual(self.mounts["/ugv3/lidar_frame", "ugv3/laser", "laser_link"], (0.0, 0.0, 0.0))

    def test_description_is_where_rviz_looks_for_it(self):
        urdf = ElementTree.fromstring(rospy.get_param("/ugv3/robot_description"))
        self.assertEqual([link.get("name") for link in urdf.findall("link")], ["ugv3/base_link", "ugv3/laser"])


if __name__ == "__main__":
    rospy.init_node("robot_launch_test")
    rostest.rosrun("mocha_ugv", "robot_launch", RobotLaunchTest, sys.argv)
