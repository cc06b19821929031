#!/usr/bin/python3
"""Somebody takes the base over through a mux, with and without a pause: the robot stops, knows where it is, and drives on when it may."""

import sys
import unittest

import rospy
import rostest
from geometry_msgs.msg import Twist
from std_srvs.srv import SetBool
from topic_tools.srv import MuxSelect

from simulated_robot import SimulatedRobot

LANE_Y = -1.5  # free from end to end


class MuxTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.robot = SimulatedRobot()
        cls.joystick = rospy.Publisher("/ugv1/cmd_vel_joystick", Twist, queue_size=1)
        cls.select = rospy.ServiceProxy("/ugv1/cmd_vel_mux/select", MuxSelect)
        cls.pause = rospy.ServiceProxy("/ugv1/pause", SetBool)
        cls.robot.start()

    def tearDown(self):
        self.assertEqual(self.robot.truth.contacts, 0)

    def by_hand(self, seconds, turn):
        """Somebody turns the robot."""
        self.select("cmd_vel_joystick")
        command = Twist()
        command.angular.z = turn
        end = self.robot.now + seconds
        while self.robot.now < end:
            self.joystick.publish(command)
            self.robot.run(0.1)
        self.joystick.publish(Twist())
        self.robot.run_until(self.robot.standing, 3.0, "it stands")
        self.select("cmd_vel_planned")

    def take_over(self, pauses):
        start, goal = sorted((-4.5, 4.5), key=lambda x: self.robot.distance_to(x, LANE_Y))
        self.robot.send(goal, LANE_Y)
        self.robot.run_until(lambda: abs(self.robot.truth.speed) > 0.6, 20.0, "it is driving")
        since = self.robot.now
        if pauses:
            self.pause(True)
            self.robot.run_until(self.robot.standing, 4.0, "it stands")
        self.by_hand(3.0, 0.5)
        if pauses:
            self.pause(False)
        else:
            self.assertTrue(self.robot.said("brakes from where it is|stopped off the path|off (its|the) (motion|path)", since))
        self.robot.run_until(self.robot.done, 60.0, "it goes on")
        self.assertEqual(self.robot.outcome()[0], "SUCCEEDED", self.robot.outcome()[1])
        self.assertLess(self.robot.distance_to(goal, LANE_Y), 0.2)

    def test_after_a_pause(self):
        self.take_over(True)

    def test_without_warning(self):
        self.take_over(False)


if __name__ == "__main__":
    rospy.init_node("mux_test")
    rostest.rosrun("mocha_ugv", "mux", MuxTest, sys.argv)
