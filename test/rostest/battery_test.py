#!/usr/bin/python3
"""A battery that is low: goals are given up and refused, and the robot drives to where it is charged, until it is."""

import sys
import unittest

import rospy
import rostest
from sensor_msgs.msg import BatteryState

from simulated_robot import SimulatedRobot

LANE_Y = -1.5  # free from end to end
CHARGER = (-3.0, LANE_Y)
FULL_V, LOW_V = 12.0, 9.0


class BatteryTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.robot = SimulatedRobot()
        cls.battery = rospy.Publisher("/ugv1/battery", BatteryState, queue_size=5)
        cls.robot.start()

    def tearDown(self):
        self.assertEqual(self.robot.truth.contacts, 0)

    def run_at(self, voltage, until, limit_s, what):
        """Lets time go on with a battery of this voltage until the condition holds."""

        def tell_and_look():
            self.battery.publish(voltage=voltage)
            return until()

        self.robot.run_until(tell_and_look, limit_s, what)

    def run_for(self, voltage, seconds):
        end = self.robot.now + seconds
        self.run_at(voltage, lambda: self.robot.now >= end, 2.0 * seconds, "time goes on")

    def charge(self):
        since = self.robot.now
        self.run_at(FULL_V, lambda: self.robot.said("battery is charged", since), 10.0, "it is charged")

    def at_charger(self):
        return self.robot.distance_to(*CHARGER) < 0.15 and self.robot.standing()

    def run_low(self):
        """Sends it off, and lets its battery get low on the way."""
        self.robot.arrive(*CHARGER)
        self.robot.send(4.5, LANE_Y)
        self.robot.run_until(lambda: abs(self.robot.truth.speed) > 0.6, 20.0, "it is driving")
        self.run_for(LOW_V, 2.0)
        self.run_for(FULL_V, 0.5)
        self.assertFalse(self.robot.done(), "a sag is not low")
        self.run_at(LOW_V, self.robot.done, 6.0, "the goal is given up")
        state, text = self.robot.outcome()
        self.assertEqual(state, "ABORTED")
        self.assertIn("battery low: 9.00 V", text)
        self.assertGreater(self.robot.distance_to(*CHARGER), 1.0)

    def test_drives_to_its_charger_and_takes_no_goal_until_it_is_charged(self):
        self.run_low()
        self.run_for(LOW_V, 1.0)
        self.robot.send(4.5, LANE_Y)
        self.run_at(LOW_V, self.robot.done, 3.0, "a new goal is refused")
        self.assertIn("battery low", self.robot.outcome()[1])
        self.run_at(LOW_V, self.at_charger, 40.0, "it is at its charger all the same")
        since = self.robot.now
        self.run_at(LOW_V, lambda: self.robot.said("planning: .*battery low", since), 5.0, "diagnostics say so")
        self.run_for(10.5, 10.0)
        self.robot.send(0.0, LANE_Y)
        self.run_at(10.5, self.robot.done, 3.0, "it is not charged yet")
        self.assertTrue(self.at_charger())
        self.charge()
        self.run_for(FULL_V, 2.0)
        self.assertTrue(self.at_charger(), "it does not go on by itself")
        self.robot.arrive(0.0, LANE_Y)


if __name__ == "__main__":
    rospy.init_node("battery_test")
    rostest.rosrun("mocha_ugv", "battery", BatteryTest, sys.argv)
