#!/usr/bin/python3
"""Each node is killed while the robot drives at speed: it stands within what was promised, says why, and goes on."""

import subprocess
import sys
import unittest

import rospkg
import rospy
import rostest

from simulated_robot import SimulatedRobot

ENDS = (-4.5, 4.5)  # of the lane, x
LANE_Y = -1.5
# Promised times, as in config/ [s].
LEASE_S = 0.5
BLIND_S = 0.8  # until it brakes without perception: max_prediction_age, a period and emergency_time, and a little
FLEET_AGE_S = 1.2
COMMAND_AGE_S = 0.3
BRAKING_S = 1.0 / (0.6 * 0.8)  # from full speed, as promised
BASE_BRAKING_S = 1.0 / 0.8  # the same of a base without commands
SLACK_S = 0.4  # actuator lag, and the periods of the nodes
WORLD = rospkg.RosPack().get_path("mocha_ugv") + "/test/worlds/hall.yaml"


class FailuresTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.robot = SimulatedRobot()
        cls.robot.start()

    def drive_to_speed(self):
        """Sets off for the far end; where that is."""
        x = max(ENDS, key=lambda end: self.robot.distance_to(end, LANE_Y))
        self.robot.send(x, LANE_Y)
        self.robot.run_until(self.at_speed, 20.0, "it drives at speed")
        return x

    def at_speed(self):
        return self.robot.truth.speed > 0.75 and abs(self.robot.place()[0]) < 3.5

    def check_kill(self, node, bound_s, words):
        x = self.drive_to_speed()
        killed_s = self.robot.now
        self.robot.dead_for(node, bound_s + 1.5)
        self.assertTrue(self.robot.stood_at(killed_s + bound_s), "it still moves; " + self.robot.report())
        self.assertGreater(self.robot.distance_to(x, LANE_Y), 1.0, "it has reached its goal before it stopped")
        self.assertTrue(self.robot.said(words, killed_s), self.robot.report())
        self.assertFalse(self.robot.done(), self.robot.outcome())
        self.robot.wait_for_node(node)
        self.robot.run_until(self.robot.done, 60.0, "it goes on after the respawn of " + node)
        self.assertEqual(self.robot.outcome()[0], "SUCCEEDED", self.robot.report())
        self.assertLess(self.robot.distance_to(x, LANE_Y), 0.2)
        self.assertEqual(self.robot.truth.contacts, 0)

    def test_perception(self):
        self.check_kill("perception", BLIND_S + BRAKING_S + SLACK_S, "local_replanner: .*people: no usable word from perception")

    def test_local_replanner(self):
        self.check_kill("local_replanner", LEASE_S + BRAKING_S + SLACK_S, "trajectory_tracker: .*the lease ended")

    def test_trajectory_broadcaster(self):
        self.check_kill("trajectory_broadcaster", FLEET_AGE_S + LEASE_S + BRAKING_S + SLACK_S,
                        "local_replanner: .*no word from trajectory_broadcaster")

    def test_trajectory_tracker(self):
        self.check_kill("trajectory_tracker", COMMAND_AGE_S + BASE_BRAKING_S + SLACK_S,
                        "local_replanner: .*off its promised motion")

    def test_respawned_at_once(self):
        """While it still moves."""
        for node in ("perception", "local_replanner", "trajectory_broadcaster", "trajectory_tracker"):
            with self.subTest(node):
                x = self.drive_to_speed()
                self.robot.dead_for(node, 0.02)
                self.robot.wait_for_node(node)
                self.robot.run_until(self.robot.done, 60.0, "it goes on after the respawn of " + node)
                self.assertEqual(self.robot.outcome()[0], "SUCCEEDED", self.robot.report())
                self.assertLess(self.robot.distance_to(x, LANE_Y), 0.2)
                self.assertEqual(self.robot.truth.contacts, 0)

    def test_global_planner(self):
        """What was planned and proved is driven on; its user, here send_goals, gives the goal once more."""
        self.robot.arrive(ENDS[0], LANE_Y)
        user = subprocess.Popen(["rosrun", "mocha_ugv", "send_goals", WORLD], stdout=subprocess.PIPE,
                                stderr=subprocess.STDOUT, text=True)
        try:
            self.robot.run_until(self.at_speed, 60.0, "it drives for send_goals")
            killed_s = self.robot.now
            self.robot.dead_for("global_planner", 1.0)
            self.robot.wait_for_node("global_planner")
            heard = lambda words: lambda: self.robot.said("/send_goals: ugv1: goal " + words, killed_s)
            self.robot.run_until(heard("lost, for the planner was started again"), 30.0, "the loss is noticed")
            self.robot.run_until(heard("succeeded"), 60.0, "the goal is reached all the same")
        finally:
            user.terminate()
            user.wait(10.0)
        self.assertLess(self.robot.distance_to(ENDS[1], LANE_Y), 0.2)
        self.assertTrue(self.robot.standing())
        self.assertEqual(self.robot.truth.contacts, 0)


if __name__ == "__main__":
    rospy.init_node("failures_test")
    rostest.rosrun("mocha_ugv", "failures", FailuresTest, sys.argv)
