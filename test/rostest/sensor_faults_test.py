#!/usr/bin/python3
"""Sensors that begin to lie while a robot drives: diagnostics say which, the robot stops where it must, and goes on when it is over."""

import sys
import unittest

import rospy
import rostest
from dynamic_reconfigure.client import Client

from simulated_robot import SimulatedRobot

LEFT, RIGHT = (-4.5, -1.5), (4.5, -1.5)  # m
NOTICED_S = 1.0  # by the log
STOP_S = NOTICED_S + 0.1 + 1.0 / 0.8 + 0.4  # the replanner's period, braking from full speed, lag
PATIENCE_S = 60.0  # simulated
TIMEOUT_S = 20.0  # wall


class SensorFaultsTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.robot = SimulatedRobot()
        cls.robot.start()
        cls.client = Client("/fleet_simulator", timeout=TIMEOUT_S)

    def lie(self, fault):
        self.client.update_configuration({"sensor_fault": fault})
        return self.robot.now

    def tearDown(self):
        self.lie("none")
        self.assertEqual(self.robot.truth.own_contacts, 0, self.robot.report())

    def drive_to_speed(self):
        """With honest sensors, so that nothing is said."""
        begun = self.robot.now
        self.robot.arrive(*LEFT, limit_s=PATIENCE_S)
        self.assertFalse(self.robot.said("perception: sensor faults: (?!lidar, odometry and map agree)", begun + 1.5), self.robot.report())
        self.robot.send(*RIGHT)
        self.robot.run_until(lambda: self.robot.truth.speed > 0.7, PATIENCE_S, "it drives at speed")

    def hear(self, words, since):
        self.robot.run_until(lambda: self.robot.said("perception: .*" + words, since), NOTICED_S, words)
        self.robot.run_until(lambda: self.robot.said("perception: sensor faults: .*" + words, since), 1.5, "diagnostics say so")

    def check_arrival(self):
        self.robot.run_until(self.robot.done, PATIENCE_S, "it goes on, and arrives")
        self.assertEqual(self.robot.outcome()[0], "SUCCEEDED", self.robot.report())
        self.assertLess(self.robot.distance_to(*RIGHT), 0.2)

    def check_stop(self, fault, words):
        self.drive_to_speed()
        begun = self.lie(fault)
        self.hear(words, begun)
        self.robot.run_until(lambda: self.robot.said("local_replanner: .*sensors: .*" + words, begun), 2.0, "the replanner says why it stops")
        self.robot.run(max(0.1, begun + STOP_S + 0.5 - self.robot.now))
        self.assertTrue(self.robot.stood_at(begun + STOP_S), "it still moves; " + self.robot.report())
        self.assertFalse(self.robot.done(), self.robot.outcome())
        self.lie("none")
        self.check_arrival()

    def test_frozen_scans(self):
        self.check_stop("scan_frozen", "the scan is frozen")

    def test_a_blind_sector(self):
        self.check_stop("scan_blind_sector", "the lidar is blind")

    def test_a_frozen_odometry(self):
        self.check_stop("odometry_frozen", "the odometry is frozen")

    def test_noisy_scans_are_driven_with(self):
        self.drive_to_speed()
        self.hear("the lidar is noisy", self.lie("scan_noisy"))
        self.check_arrival()


if __name__ == "__main__":
    rospy.init_node("sensor_faults_test")
    rostest.rosrun("mocha_ugv", "sensor_faults", SensorFaultsTest, sys.argv)
