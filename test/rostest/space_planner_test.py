#!/usr/bin/python3
"""The node space_planner from outside: plans by its service and by clicks, and what it says of bad input."""
import math
import sys
import unittest

import rospy
import rostest
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
from geometry_msgs.msg import Point, PointStamped, Vector3
from mocha_ugv.msg import MovingBall, PlannerStatus, SpaceTrajectory
from mocha_ugv.srv import PlanInSpace
from nav_msgs.msg import Path
from sensor_msgs.msg import PointCloud2
from visualization_msgs.msg import Marker, MarkerArray

from waiting import wait_until

START, GOAL = Point(2.0, 2.0, 1.2), Point(10.0, 8.0, 4.4)


class SpacePlanner(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        rospy.init_node("space_planner_test")
        cls.words, cls.latest = {}, {}
        rospy.Subscriber("/diagnostics", DiagnosticArray, cls.on_diagnostics)
        for topic, kind in (("space_path", Path), ("space_trajectory", SpaceTrajectory), ("space_markers", MarkerArray), ("space_cells", PointCloud2)):
            rospy.Subscriber(f"/{topic}", kind, lambda message, topic=topic: cls.latest.__setitem__(topic, message))
        rospy.wait_for_service("/plan_in_space", 60)
        cls.plan = staticmethod(rospy.ServiceProxy("/plan_in_space", PlanInSpace))

    @classmethod
    def on_diagnostics(cls, message):
        for status in message.status:
            cls.words[status.name] = status

    def test_plans_all_classes_and_publishes_the_cheapest(self):
        found = self.plan(START, GOAL, 0, [])
        self.assertTrue(found.success, found.message)
        self.assertEqual(found.status.reason, PlannerStatus.SOLVED)
        self.assertEqual(len(found.candidates), 4)
        self.assertEqual(len({tuple(each.signature) for each in found.candidates}), 4)
        costs = [each.cost for each in found.candidates]
        self.assertEqual(costs, sorted(costs))
        self.assertTrue(all(each.certified for each in found.candidates))
        first, last = found.trajectory.points[0], found.trajectory.points[-1]
        self.assertLess(math.dist((first.x, first.y, first.z), (2.0, 2.0, 1.2)), 1e-6)
        self.assertLess(math.dist((last.x, last.y, last.z), (10.0, 8.0, 4.4)), 1e-6)
        self.assertAlmostEqual(sum(found.trajectory.durations), found.candidates[0].duration, places=6)
        wait_until(lambda: self.latest.keys() >= {"space_path", "space_trajectory", "space_markers", "space_cells"}, "what is published")
        wait_until(lambda: self.latest["space_trajectory"].points == found.trajectory.points, "the trajectory on its topic")
        kinds = [marker.ns for marker in self.latest["space_markers"].markers]
        self.assertEqual((kinds.count("candidates"), kinds.count("costs"), kinds.count("curves")), (4, 4, 3))
        self.assertGreater(self.latest["space_cells"].width, 1000)

    def test_as_many_classes_as_are_asked_for(self):
        self.assertEqual(len(self.plan(START, GOAL, 2, []).candidates), 2)
        self.assertTrue(self.plan(START, GOAL, 4000000000, []).success)

    def test_bad_input_is_refused_with_the_reason(self):
        for start, goal, reason in ((Point(math.nan, 1.0, 1.0), GOAL, PlannerStatus.INVALID_INPUT),
                                    (START, START, PlannerStatus.INVALID_INPUT),
                                    (Point(1e300, 1.0, 1.0), GOAL, PlannerStatus.START_OCCUPIED),
                                    (START, Point(6.0, 5.0, 1.0), PlannerStatus.GOAL_OCCUPIED),
                                    (START, Point(10.0, 8.0, 60.0), PlannerStatus.GOAL_OCCUPIED)):
            found = self.plan(start, goal, 0, [])
            self.assertFalse(found.success)
            self.assertEqual(found.status.reason, reason, found.message)
            self.assertTrue(found.message)
            self.assertFalse(found.trajectory.points or found.candidates)
        self.assertTrue(self.plan(START, GOAL, 0, []).success)

    def test_plans_past_what_moves_and_refuses_what_is_no_ball(self):
        ball = MovingBall(position=Point(2.0, 6.0, 1.8), velocity=Vector3(0.0, -0.3, 0.0), radius=0.4)
        self.assertTrue(self.plan(START, GOAL, 0, [ball]).success)
        for spoilt in (MovingBall(radius=-1.0), MovingBall(velocity=Vector3(math.nan, 0.0, 0.0))):
            found = self.plan(START, GOAL, 0, [ball, spoilt])
            self.assertFalse(found.success)
            self.assertEqual(found.status.reason, PlannerStatus.INVALID_INPUT, found.message)

    def test_as_many_balls_as_it_says_and_no_more(self):
        balls = [MovingBall(position=Point(9.0, 1.0 + 0.02 * i, 1.0), radius=0.2) for i in range(100)]
        self.assertTrue(self.plan(START, GOAL, 0, balls).success)
        wait_until(lambda: self.shown() == {True}, "the plan on its topics")
        found = self.plan(START, GOAL, 0, balls + balls[:1])
        self.assertEqual(found.status.reason, PlannerStatus.INVALID_INPUT, found.message)
        self.assertIn("100", found.message)
        wait_until(lambda: self.shown() == {False}, "no plan on its topics")
        wait_until(lambda: self.counted("refused: moving: more than") == "1", "the refusal in diagnostics")

    def test_diagnostics_warn_of_plans_that_were_not_solved(self):
        for goal, level, says in ((START, DiagnosticStatus.WARN, "invalid input"), (Point(6.0, 5.0, 1.0), DiagnosticStatus.WARN, "goal occupied"),
                                  (GOAL, DiagnosticStatus.OK, "solved")):
            self.plan(START, goal, 0, [])
            wait_until(lambda: self.status().message.startswith(says), f"'{says}' in diagnostics")
            status = self.status()
            self.assertEqual(status.level, level)
            counts = {each.key: int(each.value) for each in status.values if each.key in ("plans", "solved") or each.key.startswith("not solved: ")}
            self.assertGreater(counts[says if level == DiagnosticStatus.OK else f"not solved: {says}"], 0)
            self.assertEqual(2 * counts["plans"], sum(counts.values()))

    def test_two_clicks_are_a_plan_and_others_are_refused(self):
        clicks = rospy.Publisher("/clicked_point", PointStamped, queue_size=5)
        wait_until(lambda: clicks.get_num_connections() > 0, "the node to listen")

        def click(x, y, z, frame="map"):
            message = PointStamped(point=Point(x, y, z))
            message.header.frame_id = frame
            clicks.publish(message)
        click(3.0, 3.0, 1.0, frame="odom")
        click(math.nan, 3.0, 1.0)
        click(3.0, 3.0, 1.0)
        click(3.0, 6.0, 1.5)
        wait_until(lambda: self.latest.get("space_path") is not None and self.latest["space_path"].poses
                   and math.dist(self.end_of_path(), (3.0, 6.0, 1.5)) < 1e-6, "the plan between the clicks")
        wait_until(lambda: self.counted("refused: clicked_point") == "2", "two refusals in diagnostics")

    def end_of_path(self):
        end = self.latest["space_path"].poses[-1].pose.position
        return end.x, end.y, end.z

    def shown(self):
        """Whether there is something on the topics of the last plan: {True}, {False}, or both while they change."""
        path, trajectory, markers = map(self.latest.get, ("space_path", "space_trajectory", "space_markers"))
        return path and trajectory and markers and {bool(path.poses), bool(trajectory.points), any(each.action == Marker.ADD for each in markers.markers)}

    def status(self):
        return next((status for status in self.words.values() if status.name.lstrip("/") == "space_planner: planning in space"), DiagnosticStatus())

    def counted(self, key):
        return next((each.value for each in self.status().values if each.key.startswith(key)), None)

    def test_a_map_that_is_none_is_said(self):
        wait_until(lambda: any("space_planner.yaml" in status.message for status in self.words.values()), "what is wrong with the other's map")


if __name__ == "__main__":
    rostest.rosrun("mocha_ugv", "planning_in_space", SpacePlanner, sys.argv)
