#!/usr/bin/python3
"""Goals by every road: action, rviz, waypoints, service; and goals that cannot be reached."""

import math
import sys
import unittest

import rospy
import rostest
from geometry_msgs.msg import PoseStamped
from mocha_ugv.msg import PlannerStatus
from mocha_ugv.srv import PlanTrajectory
from nav_msgs.msg import Path
from nav_msgs.srv import GetPlan
from std_srvs.srv import Empty, SetBool

from map_listener import MapListener
from simulated_robot import SimulatedRobot, pose, wrap

LANE_Y = -1.5  # free from end to end
ENDS = (-4.5, 4.5)  # of the lane, x
REACTION_S = 0.3  # from the word to the wheels
ACCELERATION_MPS2 = 0.48  # 0.6 of max_acceleration, with which robots brake


class GoalsTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.robot = SimulatedRobot()
        cls.waypoints = rospy.Publisher("/ugv1/waypoints", Path, queue_size=1)
        cls.plan = rospy.ServiceProxy("/ugv1/plan", PlanTrajectory)
        cls.patrols = rospy.Publisher("/ugv1/patrol", Path, queue_size=1)
        cls.make_plan = rospy.ServiceProxy("/ugv1/move_base/make_plan", GetPlan)
        cls.clear_costmaps = rospy.ServiceProxy("/ugv1/move_base/clear_costmaps", Empty)
        cls.statuses = []
        rospy.Subscriber("/ugv1/planner_status", PlannerStatus, cls.statuses.append)
        cls.maps = MapListener()
        cls.pause = rospy.ServiceProxy("/ugv1/pause", SetBool)
        cls.robot.start()

    def tearDown(self):
        self.assertEqual(self.robot.truth.contacts, 0)

    def go_to_speed(self):
        """Sends it to the far end of the lane, and returns that and where it set out when it is fast."""
        far, near = sorted(ENDS, key=lambda end: -self.robot.distance_to(end, LANE_Y))
        self.robot.send(far, LANE_Y)
        self.robot.run_until(lambda: abs(self.robot.truth.speed) > 0.6, 20.0, "it is driving")
        return far, near

    def check_stands(self, seconds=2.0):
        place = self.robot.place()
        self.robot.run(seconds)
        self.assertLess(self.robot.distance_to(*place), 0.03)

    def test_plan_service_answers_without_driving(self):
        plan = self.plan
        place = self.robot.place()
        answer = plan(PoseStamped(), pose(0.0, LANE_Y))
        self.assertTrue(answer.success, answer.status.message)
        self.assertEqual(answer.status.reason, PlannerStatus.SOLVED)
        self.assertRegex(answer.message, r"^reaches \(0\.0, -1\.5\): \d+\.\d m in \d+\.\d s; classes of paths: \d+, certified: \d+")
        phases = answer.trajectory.phases
        self.assertLess(math.dist((phases[0].x[0], phases[0].y[0]), place), 0.1)
        self.assertLess(math.dist((phases[-1].x[-1], phases[-1].y[-1]), (0.0, LANE_Y)), 0.1)

        from_elsewhere = plan(pose(-4.5, 2.5, 0.0), pose(-4.5, -2.5))
        self.assertTrue(from_elsewhere.success, from_elsewhere.status.message)
        refused = plan(PoseStamped(), pose(float("nan"), 0.0))
        self.assertFalse(refused.success)
        self.assertEqual(refused.status.reason, PlannerStatus.INVALID_INPUT)
        self.assertRegex(refused.message, "^no plan: invalid input: .*not finite")
        self.check_stands()

    def test_services_of_move_base(self):
        place = self.robot.place()
        path = self.make_plan(PoseStamped(), pose(0.0, LANE_Y), 0.0).plan
        self.assertEqual(path.header.frame_id, "map")
        ends = [(each.pose.position.x, each.pose.position.y) for each in (path.poses[0], path.poses[-1])]
        self.assertLess(math.dist(ends[0], place), 0.1)
        self.assertLess(math.dist(ends[1], (0.0, LANE_Y)), 0.1)
        self.assertEqual(self.make_plan(PoseStamped(), pose(float("nan"), 0.0), 0.0).plan.poses, [])
        before = len(self.maps.grids)
        self.clear_costmaps()
        self.robot.run_until(lambda: len(self.maps.grids) > before, 3.0, "a cleared map is published")
        self.check_stands()

    def test_patrol_until_there_is_another_goal(self):
        places = [(-3.0, -2.5), (-4.2, -1.0)]
        path = Path(poses=[pose(*place) for place in places])
        path.header.frame_id = "map"
        self.patrols.publish(path)
        for lap in (1, 2):
            for i, place in enumerate(places):
                self.robot.run_until(lambda: self.robot.distance_to(*place) < 0.15 and self.robot.standing(), 30.0,
                                     "waypoint %d of lap %d" % (i + 1, lap))
                self.robot.run(0.5)
        self.assertTrue(self.robot.said("reached waypoint 2 of 2, lap 2"))
        named = [(status.waypoint, status.waypoints, status.lap) for status in self.statuses]
        for each in ((1, 2, 1), (2, 2, 1), (1, 2, 2), (2, 2, 2)):
            self.assertIn(each, named)
        self.assertTrue(any(status.message.startswith("waypoint 2 of 2, lap 2: ") for status in self.statuses))
        self.patrols.publish(Path())
        self.robot.run_until(self.robot.standing, 5.0, "it stands")
        self.check_stands()
        self.assertEqual(self.statuses[-1].waypoint, 0)
        self.patrols.publish(Path(header=path.header, poses=path.poses[:1]))
        self.robot.run_until(lambda: self.robot.said("a patrol needs at least two waypoints"), 3.0, "it is refused")
        self.check_stands()

    def test_goal_with_heading(self):
        self.robot.arrive(-3.0, LANE_Y, math.pi / 2)
        self.assertLess(abs(wrap(self.robot.truth.pose.theta - math.pi / 2)), 0.15)

    def test_goal_in_another_frame(self):
        """Nothing is wrong with it, and nothing is said to be."""
        since = self.robot.now
        ahead = pose(0.4, 0.0, frame="ugv1/base_link")
        place, heading = self.robot.place(), self.robot.truth.pose.theta
        self.robot.simple_goals.publish(ahead)
        goal = place[0] + 0.4 * math.cos(heading), place[1] + 0.4 * math.sin(heading)
        self.robot.run_until(lambda: self.robot.distance_to(*goal) < 0.2 and self.robot.standing(), 20.0, "it is 0.4 m farther")
        self.assertFalse(self.robot.said("lookupTransform with a timeout", since), self.robot.report())

    def test_goal_of_rviz(self):
        self.robot.simple_goals.publish(pose(-1.5, LANE_Y, 0.0))
        self.robot.run_until(lambda: self.robot.distance_to(-1.5, LANE_Y) < 0.15 and self.robot.standing(), 30.0,
                             "the goal of rviz is reached")
        self.robot.run_until(lambda: abs(wrap(self.robot.truth.pose.theta)) < 0.15, 10.0, "it looks along x")

    def test_waypoints_in_their_order(self):
        places = [(-2.0, -2.5), (-3.5, -2.5), (-3.5, -0.5)]
        path = Path(poses=[pose(*place) for place in places])
        path.header.frame_id = "map"
        self.waypoints.publish(path)
        for i, place in enumerate(places):
            others = [other for other in places[i + 1:]]
            self.robot.run_until(
                lambda: self.robot.distance_to(*place) < 0.15 and self.robot.standing(), 30.0, "waypoint %d" % i)
            self.assertTrue(all(self.robot.distance_to(*other) > 0.5 for other in others))

    def test_cancel_while_driving(self):
        x, _ = self.go_to_speed()
        self.robot.client.cancel_goal()
        begun = self.robot.now
        self.robot.run_until(self.robot.standing, 4.0, "it stands after the cancel")
        self.robot.run_until(self.robot.done, 2.0, "the client knows")
        self.assertEqual(self.robot.outcome()[0], "PREEMPTED")
        self.assertGreater(self.robot.distance_to(x, LANE_Y), 2.0)
        self.assertLess(begun, self.robot.now)
        self.check_stands()

    def stopping_distance(self):
        """[m] of the rover that speeds up for another REACTION_S at most and brakes then, both at ACCELERATION_MPS2."""
        speed = abs(self.robot.truth.speed) + ACCELERATION_MPS2 * REACTION_S
        return REACTION_S * speed + speed * speed / (2.0 * ACCELERATION_MPS2)

    def test_cancel_stops_at_once(self):
        self.go_to_speed()
        place, allowed = self.robot.place(), self.stopping_distance()
        self.robot.client.cancel_goal()
        self.robot.run_until(self.robot.standing, 4.0, "it stands after the cancel")
        self.assertLess(self.robot.distance_to(*place), allowed)
        self.check_stands()

    def test_cancelled_at_rest_it_does_not_set_off(self):
        self.robot.arrive(-3.0, LANE_Y, 0.0)
        for after_s in (0.1, 0.2, 0.3, 0.4):
            place = self.robot.place()
            self.robot.send(3.0, LANE_Y)
            self.robot.run_until(lambda: not self.robot.done(), 2.0, "the goal is taken")
            self.robot.run(after_s)
            self.robot.client.cancel_goal()
            self.robot.run_until(self.robot.done, 2.0, "the client knows")
            self.check_stands()
            self.assertLess(self.robot.distance_to(*place), 0.02)

    def test_pause_and_resume(self):
        x, _ = self.go_to_speed()
        place, allowed = self.robot.place(), self.stopping_distance()
        self.assertEqual(self.pause(True).message, "paused")
        self.addCleanup(self.pause, False)
        self.robot.run_until(self.robot.standing, 4.0, "it stands after the pause")
        self.assertLess(self.robot.distance_to(*place), allowed)
        self.check_stands()
        self.assertFalse(self.robot.done())
        self.assertEqual(self.robot.last_reason(), PlannerStatus.PAUSED)
        self.pause(False)
        self.robot.run_until(self.robot.done, 60.0, "it goes on")
        self.assertEqual(self.robot.outcome()[0], "SUCCEEDED")
        self.assertLess(self.robot.distance_to(x, LANE_Y), 0.2)

    def test_a_new_goal_replaces_the_one_before(self):
        since = self.robot.now
        _, x = self.go_to_speed()
        self.robot.arrive(x, LANE_Y)
        self.assertFalse(self.robot.said("stopped off the path", since))

    def test_a_goal_that_is_no_number(self):
        self.robot.send(float("nan"), 1.0)
        self.robot.run_until(self.robot.done, 3.0, "it is aborted")
        self.assertEqual(self.robot.outcome()[0], "ABORTED")
        self.assertIn("not finite", self.robot.outcome()[1])
        refused = lambda: int(self.robot.values["ugv1/global_planner: planning"]["messages refused"])
        self.robot.run(1.2)  # diagnostics come every second
        before = refused()
        self.robot.simple_goals.publish(pose(1.0, float("inf")))
        self.robot.run_until(lambda: refused() > before, 5.0, "it is counted")
        self.check_stands()

    def test_a_goal_in_a_wall(self):
        """In a thin one nothing around the goal is free; into a thick one there is no way, once it is seen from all sides."""
        for x, y, reason in ((-3.0, 2.0, PlannerStatus.GOAL_OCCUPIED), (2.0, 2.0, PlannerStatus.NO_PATH)):
            since = self.robot.now
            self.robot.send(x, y)
            self.robot.run_until(lambda: self.robot.reported(reason, since), 30.0, "the planner says why")
            self.robot.run_until(self.robot.standing, 10.0, "it stands")
            place = self.robot.place()
            self.robot.run_until(self.robot.done, 10.0, "the goal (%.0f, %.0f) is given up" % (x, y))
            self.assertLess(self.robot.distance_to(*place), 0.1)
            status, text = self.robot.outcome()
            self.assertEqual(status, "ABORTED")
            self.assertIn("(%.2f, %.2f)" % (x, y), text)
            self.assertEqual(self.robot.last_reason(), reason)
            self.assertEqual(self.plan(PoseStamped(), pose(x, y)).status.reason, reason)
        self.robot.arrive(-4.5, LANE_Y)

    def test_a_bad_goal_while_driving_stops_it(self):
        self.go_to_speed()
        self.robot.send(float("nan"), 1.0)
        self.robot.run_until(self.robot.standing, 4.0, "it stands")
        self.assertEqual(self.robot.outcome()[0], "ABORTED")
        self.check_stands()


if __name__ == "__main__":
    rospy.init_node("goals_test")
    rostest.rosrun("mocha_ugv", "goals", GoalsTest, sys.argv)
