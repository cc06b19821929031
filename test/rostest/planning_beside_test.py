#!/usr/bin/python3
"""A large maze, in which a plan takes long: the planner hears what it is told in the meantime, and says what planning took."""

import random
import sys
import unittest

import actionlib
import rospy
import rostest
import tf2_ros
from diagnostic_msgs.msg import DiagnosticArray
from geometry_msgs.msg import TransformStamped
from mocha_ugv.msg import Candidates, MotionPhase, PlannerStatus, PlanningEffort, Trajectory
from move_base_msgs.msg import MoveBaseAction, MoveBaseGoal
from nav_msgs.msg import OccupancyGrid, Odometry
from std_msgs.msg import Bool
from std_srvs.srv import SetBool

from waiting import wait_until

CELL_M = 0.05
PITCH = 48  # cells from wall to wall
ROOMS = 40  # along a side
WALL = 3  # cells
MIDDLE_M = CELL_M * (PITCH + WALL) / 2.0
FAR_M = CELL_M * PITCH * (ROOMS - 1) + MIDDLE_M


def maze():
    """Rooms that hang together, with a loop here and there, as a map."""
    random.seed(1)
    side = ROOMS * PITCH + WALL
    cells = [bytearray(side) for _ in range(side)]

    def fill(x0, y0, x1, y1, value):
        for y in range(y0, y1):
            cells[y][x0:x1] = bytes([value]) * (x1 - x0)

    for i in range(ROOMS + 1):
        fill(i * PITCH, 0, i * PITCH + WALL, side, 100)
        fill(0, i * PITCH, side, i * PITCH + WALL, 100)
    seen, front = {(0, 0)}, [(0, 0)]
    while front:
        x, y = front[-1]
        ways = [(dx, dy) for dx, dy in ((1, 0), (-1, 0), (0, 1), (0, -1)) if 0 <= x + dx < ROOMS and 0 <= y + dy < ROOMS]
        fresh = [(dx, dy) for dx, dy in ways if (x + dx, y + dy) not in seen]
        if not fresh:
            front.pop()
            if random.random() > 0.2:
                continue
        dx, dy = random.choice(fresh or ways)
        left, low = PITCH * (x + max(dx, 0)), PITCH * (y + max(dy, 0))
        fill(left + (WALL if dy else 0), low + (WALL if dx else 0), left + (PITCH if dy else WALL), low + (PITCH if dx else WALL), 0)
        if fresh:
            seen.add((x + dx, y + dy))
            front.append((x + dx, y + dy))
    grid = OccupancyGrid()
    grid.header.frame_id = "map"
    grid.info.resolution = CELL_M
    grid.info.width = grid.info.height = side
    grid.info.origin.orientation.w = 1.0
    grid.data = [value for row in cells for value in row]
    return grid


def standing():
    motion = Trajectory(state=Trajectory.COMMITTED, agent="ugv1", epoch=1, sequence=1, footprint_radius=0.2, deceleration=0.5,
                        max_acceleration=0.8, start=rospy.Time.now(), s=3)
    motion.header.frame_id = "map"
    motion.phases = [MotionPhase(kind=MotionPhase.STAND, durations=[0.1], x=[MIDDLE_M], y=[MIDDLE_M])]
    return motion


class PlanningBesideTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.candidates, cls.statuses, cls.fed_back, cls.diagnosed = [], [], [], {}
        transform = TransformStamped(child_frame_id="ugv1/odom")
        transform.header.frame_id = "map"
        transform.transform.rotation.w = 1.0
        cls.tf = tf2_ros.StaticTransformBroadcaster()
        cls.tf.sendTransform(transform)
        cls.odometry = rospy.Publisher("/ugv1/odom", Odometry, queue_size=1)
        cls.committed = rospy.Publisher("/ugv1/committed_trajectory", Trajectory, queue_size=1, latch=True)
        cls.stop = rospy.Publisher("/ugv1/emergency_stop", Bool, queue_size=1)
        cls.maps = rospy.Publisher("/ugv1/map", OccupancyGrid, queue_size=1, latch=True)
        rospy.Subscriber("/ugv1/candidates", Candidates, cls.candidates.append)
        rospy.Subscriber("/ugv1/planner_status", PlannerStatus, cls.statuses.append)
        rospy.Subscriber("/diagnostics", DiagnosticArray, cls.on_diagnostics)
        cls.pause = rospy.ServiceProxy("/ugv1/pause", SetBool)
        cls.pause.wait_for_service(30.0)
        cls.timer = rospy.Timer(rospy.Duration(0.05), cls.be_there)
        cls.committed.publish(standing())
        cls.maps.publish(maze())
        cls.client = actionlib.SimpleActionClient("/ugv1/move_base", MoveBaseAction)
        cls.client.wait_for_server(rospy.Duration(30.0))

    @classmethod
    def be_there(cls, _):
        odometry = Odometry(child_frame_id="ugv1/base_link")
        odometry.header.stamp = rospy.Time.now()
        odometry.header.frame_id = "ugv1/odom"
        odometry.pose.pose.position.x = odometry.pose.pose.position.y = MIDDLE_M
        odometry.pose.pose.orientation.w = 1.0
        cls.odometry.publish(odometry)

    @classmethod
    def on_diagnostics(cls, message):
        for status in message.status:
            if status.name.endswith("planning"):
                cls.diagnosed = {each.key: each.value for each in status.values}

    def send(self):
        """Returns as soon as it plans to the far corner."""
        goal = MoveBaseGoal()
        goal.target_pose.header.frame_id = "map"
        goal.target_pose.pose.position.x = goal.target_pose.pose.position.y = FAR_M
        del self.fed_back[:], self.candidates[:], self.statuses[:]
        self.client.send_goal(goal, feedback_cb=self.fed_back.append)
        wait_until(lambda: self.fed_back, "it has the goal", 60.0)

    def wait_for_plan(self):
        wait_until(lambda: any(each.selected for each in (self.candidates[-1].candidates if self.candidates else [])), "a plan", 60.0)

    def test_1_is_told_to_pause_before_the_plan_is_there(self):
        self.send()
        self.assertTrue(self.pause(True).success)
        wait_until(lambda: any(each.reason == PlannerStatus.PAUSED for each in self.statuses), "it pauses", 20.0)
        self.assertEqual(self.candidates, [])
        self.pause(False)
        self.wait_for_plan()

    def test_2_an_emergency_stop_ends_planning(self):
        self.send()
        self.stop.publish(True)
        self.assertTrue(self.client.wait_for_result(rospy.Duration(20.0)))
        self.assertIn("emergency stop", self.client.get_goal_status_text())
        self.assertEqual(self.candidates, [])

    def test_3_says_what_planning_took(self):
        def efforts():
            return [each.effort for each in self.statuses if each.effort.plans > 0]

        wait_until(efforts, "a status after a plan", 20.0)
        effort = efforts()[-1]
        self.assertGreater(effort.time, 0.0)
        self.assertGreaterEqual(effort.time_longest, effort.time_95)
        self.assertGreaterEqual(effort.time_95, effort.time_median)
        self.assertGreater(effort.classes, 0)
        self.assertGreater(effort.evaluations, 0)
        self.assertIn(effort.parameterisation, (PlanningEffort.CAMOUFLAGE, PlanningEffort.WAYPOINTS))
        wait_until(lambda: self.diagnosed.get("plans made") == str(effort.plans), "diagnostics", 20.0)
        self.assertAlmostEqual(float(self.diagnosed["planning time, last (s)"]), effort.time, places=3)
        self.assertIn(self.diagnosed["parameterisation of the last plan"], ("camouflage", "waypoints"))
        falls_back = [each for each in effort.fallbacks if each.in_last_plan]
        self.assertEqual(any("plain waypoints" in each.message for each in falls_back), effort.parameterisation == PlanningEffort.WAYPOINTS)
        self.assertEqual(set(self.diagnosed["the last plan fell back on"].split("; ")), {each.message for each in falls_back} or {"nothing"})


if __name__ == "__main__":
    rospy.init_node("planning_beside_test")
    rostest.rosrun("mocha_ugv", "planning_beside", PlanningBesideTest, sys.argv)
