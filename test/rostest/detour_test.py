#!/usr/bin/python3
"""A robot with a lidar only swerves around a person that comes slantwise across its way, and is back on its plan at the rejoin point."""

import math
import sys
import unittest

import rospy
import rostest
from mocha_ugv.msg import Candidates, GroundTruth, ReplannerStatus
from visualization_msgs.msg import MarkerArray

from simulated_robot import SimulatedRobot

GOAL = (16.5, 0.0)  # m, as in config/worlds/detour.yaml
THRESHOLD_M = 0.7 * 0.2  # of moving_clearance, below which a promise is not kept in force
PATIENCE_S = 60.0  # simulated


def off_line(place, line):
    """Distance of a place from a polyline [m]."""
    least = math.inf
    for (ax, ay), (bx, by) in zip(line, line[1:]):
        length = math.hypot(bx - ax, by - ay)
        if length > 0.0:
            along = min(1.0, max(0.0, ((place[0] - ax) * (bx - ax) + (place[1] - ay) * (by - ay)) / length ** 2))
            least = min(least, math.hypot(place[0] - ax - along * (bx - ax), place[1] - ay - along * (by - ay)))
    return least


class DetourTest(unittest.TestCase):
    def setUp(self):
        self.driven, self.clearances = [], []  # (x, y) and [m]
        self.plan = []  # the first global one
        self.rejoin_points = []  # of the detours that were driven
        rospy.Subscriber("/fleet_simulator/ground_truth", GroundTruth, self.on_truth)
        self.efforts = []  # of local plans
        rospy.Subscriber("/ugv1/replanner_status", ReplannerStatus, lambda message: self.efforts.append(message.status.effort))
        rospy.Subscriber("/ugv1/candidates", Candidates, self.on_candidates)
        rospy.Subscriber("/ugv1/local_markers", MarkerArray, self.on_markers)
        self.robot = SimulatedRobot()
        self.robot.start()

    def on_truth(self, message):
        self.driven += [(robot.pose.x, robot.pose.y) for robot in message.robots]
        self.clearances += [robot.clearance for robot in message.robots]

    def on_candidates(self, message):
        selected = [one for one in message.candidates if one.selected]
        if selected and not self.plan:
            self.plan = [(point.x, point.y) for point in selected[0].path]

    def on_markers(self, message):
        parts = {marker.ns: marker for marker in message.markers}
        if "detour" in parts and "rejoin point" in parts:
            place = parts["rejoin point"].pose.position
            self.rejoin_points.append((place.x, place.y))

    def test_swerves_and_is_back_at_the_rejoin_point(self):
        self.robot.send(*GOAL)
        self.robot.run_until(self.robot.done, PATIENCE_S, "it arrives")
        self.assertEqual(self.robot.outcome()[0], "SUCCEEDED", self.robot.report())
        self.assertEqual(self.robot.truth.contacts, 0)
        self.assertTrue(self.rejoin_points, "it did not swerve")
        self.assertGreater(max(off_line(place, self.plan) for place in self.driven), 0.4, "it swerved by next to nothing")
        self.assertGreater(min(self.clearances), THRESHOLD_M)
        rejoin_point = self.rejoin_points[-1]
        self.assertLess(off_line(rejoin_point, self.plan), 0.1, "the rejoin point is not on the plan")
        self.assertLess(off_line(rejoin_point, self.driven), 0.1, "it missed the rejoin point")
        self.assertLess(rejoin_point[0], GOAL[0] - 1.0, "it came back only at the goal")
        for place in self.driven:
            if place[0] > rejoin_point[0]:
                self.assertLess(off_line(place, self.plan), 0.2, "it left the plan again")
        self.says_what_planning_took()

    def says_what_planning_took(self):
        self.robot.run(1.5)  # diagnostics come every second
        effort, told = self.efforts[-1], self.robot.values["ugv1/local_replanner: detours"]
        self.assertGreater(effort.plans, 0)
        self.assertGreater(effort.time, 0.0)
        self.assertGreaterEqual(int(told["plans made"]), effort.plans)
        self.assertIn("the last plan fell back on", told)
        for fallback in effort.fallbacks:
            words = fallback.message.rsplit(", at ", 1)[0]
            self.assertGreaterEqual(int(told["plans with " + words]), fallback.plans)


if __name__ == "__main__":
    rospy.init_node("detour_test")
    rostest.rosrun("mocha_ugv", "detour", DetourTest, sys.argv)
