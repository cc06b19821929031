#!/usr/bin/python3
"""Zones as a service and a file: what is in force is heard, seen in the map, driven round, left, and refused as a goal."""

import sys
import tempfile
import unittest

import rospy
import rostest
from geometry_msgs.msg import Point32, PoseStamped
from mocha_ugv.msg import PlannerStatus, Zone, Zones
from mocha_ugv.srv import PlanTrajectory, SetZones
from std_srvs.srv import SetBool

from map_listener import MapListener
from simulated_robot import SimulatedRobot, pose

LANE_Y = -1.5  # free from end to end
RADIUS_M = 0.2  # of the rover, at least
SLOW_MPS = 0.3
FEEDBACK_MPS = 0.05  # of the tracker, on top of the motion's speed
NOTICE_S = 2.0  # before a speed zone counts
BRAKING_MPS2 = 0.48


def box(name, x0, y0, x1, y1, max_speed=Zone.KEEP_OUT):
    zone = Zone(name=name, max_speed=max_speed)
    zone.area.points = [Point32(x, y, 0.0) for x, y in ((x0, y0), (x1, y0), (x1, y1), (x0, y1))]
    return zone


class ZonesTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.robot = SimulatedRobot()
        cls.maps = MapListener()
        cls.in_force = []
        rospy.Subscriber("/ugv1/zones", Zones, cls.in_force.append)
        cls.set_zones = rospy.ServiceProxy("/ugv1/set_zones", SetZones)
        cls.plan = rospy.ServiceProxy("/ugv1/plan", PlanTrajectory)
        cls.pause = rospy.ServiceProxy("/ugv1/pause", SetBool)
        cls.robot.start()

    def tearDown(self):
        self.assertEqual(self.robot.truth.contacts, 0)
        self.put()

    def put(self, *zones):
        answer = self.set_zones("", list(zones))
        self.assertTrue(answer.success, answer.message)
        self.robot.run_until(lambda: self.names() == [zone.name for zone in zones], 1.0, "the zones are in force")

    def names(self):
        return [zone.name for zone in self.in_force[-1].zones] if self.in_force else None

    def inside(self, x0, y0, x1, y1, margin=0.0):
        x, y = self.robot.place()
        return x0 - margin < x < x1 + margin and y0 - margin < y < y1 + margin

    def drive(self, x, y, watch):
        """To the place; whatever it does on the way, `watch` stays true."""
        self.robot.send(x, y)
        end = self.robot.now + 60.0
        while not self.robot.done():
            self.robot.run(0.1)
            self.assertTrue(watch(), self.robot.report())
            self.assertLess(self.robot.now, end, self.robot.report())
        self.assertEqual(self.robot.outcome()[0], "SUCCEEDED", self.robot.outcome()[1])

    def go_to_speed(self):
        self.robot.arrive(-4.5, LANE_Y, 0.0)
        self.robot.send(4.5, LANE_Y)
        self.robot.run_until(lambda: abs(self.robot.truth.speed) > 0.6, 20.0, "it is driving")

    def test_what_is_in_force_is_driven_round(self):
        self.robot.arrive(-4.5, LANE_Y)
        area = (-1.0, -2.2, 0.5, 0.0)
        self.put(box("spill", *area))
        self.robot.run_until(lambda: self.maps.cell(-0.3, -1.0) == 100, 1.0, "it is in the map")
        self.drive(4.5, LANE_Y, lambda: not self.inside(*area, margin=RADIUS_M))
        self.put()
        self.robot.run_until(lambda: self.maps.cell(-0.3, -1.0) != 100, 1.0, "it is gone")
        passed = []
        self.drive(-4.5, LANE_Y, lambda: passed.append(self.inside(*area)) is None)
        self.assertTrue(any(passed), "the way leads there again")

    def test_slow_where_that_is_asked_for(self):
        self.robot.arrive(-4.5, LANE_Y, 0.0)
        area = (-1.0, -3.4, 1.0, 3.4)
        self.put(box("door", *area, max_speed=SLOW_MPS))
        inside, outside = [], []
        self.drive(4.5, LANE_Y, lambda: (inside if self.inside(*area) else outside).append(abs(self.robot.truth.speed)) is None)
        self.assertLess(max(inside), SLOW_MPS + FEEDBACK_MPS)
        self.assertGreater(max(inside), 0.7 * SLOW_MPS)
        self.assertGreater(max(outside), 0.6)

    def test_a_moving_robot_slows_down_without_stopping(self):
        self.go_to_speed()
        self.put(box("hall", -6.0, -3.5, 6.0, 3.5, max_speed=SLOW_MPS))
        since = self.robot.now
        speed = abs(self.robot.truth.speed)
        self.robot.run(NOTICE_S + 2.0 * (speed - SLOW_MPS) / BRAKING_MPS2)
        self.assertLess(abs(self.robot.truth.speed), SLOW_MPS + FEEDBACK_MPS)
        self.robot.run_until(self.robot.done, 60.0, "it arrives")
        self.assertEqual(self.robot.outcome()[0], "SUCCEEDED", self.robot.outcome()[1])
        driving = [abs(v) for at, v, _ in self.robot.speeds if since < at < self.robot.now - 4.0]
        self.assertGreater(min(driving), 0.1)

    def test_ahead_of_a_moving_robot(self):
        """It brakes or swerves before what is far enough ahead."""
        self.go_to_speed()
        x = self.robot.place()[0] + 2.5
        area = (x, -2.6, x + 1.0, -0.5)
        self.put(box("ahead", *area))
        self.robot.run_until(lambda: self.robot.done() or self.inside(*area, margin=RADIUS_M), 60.0, "it arrives")
        self.assertEqual(self.robot.outcome()[0], "SUCCEEDED", self.robot.report())

    def test_under_a_moving_robot(self):
        """What comes into force too near to stop before it, or where the robot is, is left, and the goal is reached."""
        self.go_to_speed()
        x = self.robot.place()[0]
        area = (x - 1.0, -2.6, x + 1.5, -0.5)
        self.put(box("here", *area))
        self.assertTrue(self.in_force[-1].exit)
        self.robot.run_until(lambda: not self.inside(*area, margin=RADIUS_M), 20.0, "it has left")
        self.robot.run_until(lambda: not self.in_force[-1].exit, 2.0, "it is shut behind it")
        self.robot.run_until(lambda: self.robot.done() or self.inside(*area, margin=RADIUS_M), 60.0, "it arrives")
        self.assertEqual(self.robot.outcome()[0], "SUCCEEDED", self.robot.report())

    def test_a_robot_without_a_goal_leaves(self):
        self.robot.arrive(0.0, LANE_Y)
        area = (-1.0, -2.6, 1.2, -0.5)
        self.put(box("parked", *area))
        self.robot.run_until(lambda: not self.inside(*area, margin=RADIUS_M) and self.robot.standing(), 30.0, "it has left")
        self.robot.run(1.0)
        self.assertFalse(self.robot.said("NO CERTIFIED MOTION", self.robot.now - 20.0))

    def test_a_paused_robot_stays(self):
        self.robot.arrive(0.0, LANE_Y)
        self.pause(True)
        self.addCleanup(self.pause, False)
        place = self.robot.place()
        self.put(box("parked", -1.0, -2.6, 1.2, -0.5))
        self.robot.run(3.0)
        self.assertLess(self.robot.distance_to(*place), 0.05)

    def test_goals_inside_are_refused(self):
        self.robot.arrive(-4.5, LANE_Y)
        self.put(box("office", 1.0, -2.6, 3.0, -0.5))
        self.robot.send(2.0, LANE_Y)
        self.robot.run_until(self.robot.done, 3.0, "it is aborted")
        self.assertEqual(self.robot.outcome()[0], "ABORTED")
        self.assertIn("lies in keep-out zone `office`", self.robot.outcome()[1])
        answer = self.plan(PoseStamped(), pose(2.0, LANE_Y))
        self.assertFalse(answer.success)
        self.assertEqual(answer.status.reason, PlannerStatus.GOAL_OCCUPIED)
        self.assertIn("`office`", answer.status.message)

    def test_a_goal_that_is_shut_is_given_up(self):
        self.go_to_speed()
        self.put(box("dock", 4.0, -2.6, 5.0, -0.5))
        self.robot.run_until(self.robot.done, 3.0, "it is aborted")
        self.assertEqual(self.robot.outcome()[0], "ABORTED")
        self.assertIn("lies in keep-out zone `dock`", self.robot.outcome()[1])
        self.robot.run_until(self.robot.standing, 5.0, "it stands")

    def test_bad_zones_leave_those_in_force(self):
        self.put(box("a", -1.0, 0.5, 0.0, 1.5))
        crossed = box("b", 0.0, 0.0, 1.0, 1.0)
        crossed.area.points[1:3] = reversed(crossed.area.points[1:3])
        for zones, why in (([crossed], "zone `b`"), ([box("c", 0, 0, 1, 1, -1.0)], "max_speed"), ([box("d", 0, 0, 1, float("nan"))], "zone `d`")):
            answer = self.set_zones("", zones)
            self.assertFalse(answer.success)
            self.assertIn(why, answer.message)
        answer = self.set_zones("/none.yaml", [])
        self.assertFalse(answer.success)
        self.assertIn("/none.yaml", answer.message)
        self.robot.run(1.0)
        self.assertEqual(self.names(), ["a"])

    def test_a_file_and_a_node_that_is_started_again(self):
        with tempfile.NamedTemporaryFile("w", suffix=".yaml") as file:
            file.write("keep_out: [{name: of_file, polygon: [[-1, 0.5], [0, 0.5], [0, 1.5]]}]")
            file.flush()
            answer = self.set_zones(file.name, [])
            self.assertTrue(answer.success, answer.message)
            self.robot.run_until(lambda: self.names() == ["of_file"], 1.0, "the file's zones are in force")
            self.rewrite(file, "of_file", "rewritten")
            self.robot.run_until(lambda: self.names() == ["rewritten"], 2.0, "what is written is in force")
            since = self.robot.now
            self.rewrite(file, "keep_out", "kept_out")
            self.robot.run_until(lambda: self.robot.said("those before stay in force: .*kept_out.*unknown key", since), 5.0, "it is said")
            self.assertEqual(self.names(), ["rewritten"])
        self.in_force.clear()
        self.robot.dead_for("perception", 0.5)
        self.robot.wait_for_node("perception")
        self.robot.run_until(lambda: self.names() == ["rewritten"], 5.0, "they are in force again")

    def rewrite(self, file, before, after):
        text = open(file.name).read().replace(before, after)
        file.seek(0)
        file.write(text)
        file.truncate()
        file.flush()


if __name__ == "__main__":
    rospy.init_node("zones_test")
    rostest.rosrun("mocha_ugv", "zones", ZonesTest, sys.argv)
