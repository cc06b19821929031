#!/usr/bin/python3
"""Emergency stops of a robot and of the fleet, at full speed: within one control period, whatever else is dead, and until the reset."""

import math
import os
import shutil
import sys
import unittest

import rospy
import rostest
from geometry_msgs.msg import Twist
from mocha_ugv.msg import EmergencyStopState, FleetTrajectories, PlannerStatus
from std_msgs.msg import Bool
from std_srvs.srv import SetBool
from visualization_msgs.msg import MarkerArray

from node_process import is_connected
from simulated_robot import NODES, SimulatedRobot, pose
from waiting import wait_until

ENDS = (-4.5, 4.5)  # of the lanes, x
LANES = {"ugv1": -1.5, "ugv2": 1.5}  # y
PERIOD_S = 0.02  # of control
WHEEL_ACCELERATION = 2.5  # [m/s^2] of the rover
STANDS_S = 0.9 / WHEEL_ACCELERATION + 0.3  # from the order on: wheels of 0.05 s lag, and a step or two
STANDS_M = 0.9 * 0.9 / (2.0 * WHEEL_ACCELERATION) + 0.15 * 0.9


class Robot(SimulatedRobot):
    """With what there is about emergency stops."""

    def __init__(self, name):
        super().__init__(name)
        self.command = Twist()
        self.state = None
        self.peers = {}
        self.labels = []  # in rviz
        rospy.Subscriber("/%s/cmd_vel" % name, Twist, self.on_command, tcp_nodelay=True)
        rospy.Subscriber("/%s/emergency_stop_state" % name, EmergencyStopState, self.on_state)
        rospy.Subscriber("/%s/fleet/trajectories" % name, FleetTrajectories, self.on_fleet)
        rospy.Subscriber("/%s/motion_markers" % name, MarkerArray, self.on_markers)
        self.topics = {scope: rospy.Publisher("/%s/%semergency_stop" % (name, scope), Bool, queue_size=1) for scope in ("", "fleet/")}

    def on_command(self, twist):
        self.command = twist

    def on_state(self, state):
        self.state = state

    def on_fleet(self, message):
        self.peers = {trajectory.agent: trajectory for trajectory in message.trajectories}

    def on_markers(self, drawing):
        self.labels = [marker.text for marker in drawing.markers if marker.text]

    def call(self, stop, scope=""):
        """The answer of the service."""
        service = "/%s/%semergency_stop" % (self.name, scope)
        rospy.wait_for_service(service, 30.0)
        return rospy.ServiceProxy(service, SetBool)(stop)

    def tell(self, stop, scope=""):
        self.topics[scope].publish(Bool(stop))

    def faster_wheel(self):
        """Of the newest command [m/s]."""
        return abs(self.command.linear.x) + 0.5 * 0.4 * abs(self.command.angular.z)

    def off_lane_m(self):
        return abs(self.place()[1] - LANES[self.name])


class EmergencyStopTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.store = os.path.splitext(rospy.get_param("/ugv1/trajectory_broadcaster/epoch_file"))[0] + ".stops"
        cls.robots = cls.first, cls.second = Robot("ugv1"), Robot("ugv2")
        cls.second._until = math.inf  # the first keeps the time
        cls.first.start()
        cls.reset_all()  # of a run that was broken off

    @classmethod
    def reset_all(cls):
        for robot in cls.robots:
            robot.call(False)
        cls.first.call(False, "fleet/")
        cls.first.run(2.0)

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(os.path.dirname(cls.store))

    def tearDown(self):
        self.reset_all()
        self.assertEqual([robot.truth.contacts for robot in self.robots], [0, 0])

    # --- steps ---

    def run_for(self, seconds):
        self.first.run(seconds)

    def settle(self, *dead):
        """Lets what was published arrive everywhere but at nodes that are dead; simulated time stands."""
        self.first.settle(set.union(*(robot.pairs() for robot in self.robots)) - set(dead))

    def drive_to_speed(self, *robots):
        for robot in robots:
            robot.send(max(ENDS, key=lambda end: robot.distance_to(end, LANES[robot.name])), LANES[robot.name])
        at_speed = lambda robot: robot.truth.speed > 0.85 and abs(robot.place()[0]) < 3.0
        self.first.run_until(lambda: all(map(at_speed, robots)), 20.0, "they drive at full speed")
        self.settle()

    def check_stop(self, order, *robots):
        """Whether what `order()` says stops these robots within a control period, and then within their limits."""
        before = {robot: (robot.faster_wheel(), robot.place()) for robot in robots}
        order()
        self.settle()
        ordered_s = self.first.now
        self.run_for(PERIOD_S)
        self.settle()
        for robot, (speed, _) in before.items():
            self.assertLess(robot.faster_wheel(), speed - 0.9 * WHEEL_ACCELERATION * PERIOD_S, "%s goes on" % robot.name)
            self.assertGreater(robot.faster_wheel(), 0.5 * speed, "%s lurches" % robot.name)
        self.run_for(STANDS_S + 1.0)
        for robot, (_, place) in before.items():
            self.assertTrue(robot.stood_at(ordered_s + STANDS_S), robot.report())
            self.assertLess(math.dist(robot.place(), place), STANDS_M)
            self.assertLess(robot.off_lane_m(), 0.1)
            self.assertEqual(robot.outcome()[0], "ABORTED", robot.report())
            self.assertTrue(robot.reported(PlannerStatus.EMERGENCY_STOP, ordered_s), robot.reasons[-5:])

    def check_stopped(self, robot):
        """And that it takes no goal."""
        self.settle()
        place = robot.place()
        robot.send(0.0, LANES[robot.name])
        robot.simple_goals.publish(pose(0.0, LANES[robot.name]))
        self.run_for(2.0)
        self.assertEqual(robot.outcome()[0], "ABORTED", robot.report())
        self.assertEqual(robot.last_reason(), PlannerStatus.EMERGENCY_STOP, (robot.name, robot.now, robot.reasons[-8:], robot.outcome(), robot.state))
        self.assertLess(math.dist(robot.place(), place), 0.02)
        self.assertEqual(robot.faster_wheel(), 0.0)
        self.assertTrue(robot.state.stopped)
        self.assertTrue(robot.said("trajectory_broadcaster: emergency stop: emergency stop of .*rosservice call /%s" % robot.name, self.first.now - 2.0),
                        robot.report())

    def check_reset(self, *robots):
        """That they stand until they get a goal, and then go there."""
        places = [robot.place() for robot in robots]
        self.run_for(3.0)
        for robot, place in zip(robots, places):
            self.assertLess(math.dist(robot.place(), place), 0.02, "%s has set off by itself" % robot.name)
            self.assertFalse(robot.state.stopped)
        for robot in robots:
            robot.send(0.0, LANES[robot.name])
        self.first.run_until(lambda: all(robot.done() for robot in robots), 30.0, "they go to their goals")
        self.assertEqual({robot.outcome()[0] for robot in robots}, {"SUCCEEDED"})

    def await_node(self, robot, node):
        """Until it takes part again, and all have heard what it keeps for late joiners."""
        robot.wait_for_node(node, self.run_for)
        wait_until(lambda: is_connected("/%s/%s" % (robot.name, node)), node + " is connected")
        self.settle()

    # --- tests ---

    def test_a_robot_by_service(self):
        self.drive_to_speed(*self.robots)
        self.check_stop(lambda: self.first.call(True), self.first)
        self.first.run_until(self.second.done, 30.0, "the other one arrives")
        self.assertEqual(self.second.outcome()[0], "SUCCEEDED")
        self.assertEqual((self.first.state.robot, self.first.state.fleet, self.first.state.by), (True, False, ["ugv1"]))
        self.assertIn("called by " + rospy.get_name(), self.first.state.message)
        self.assertIn("ugv1: EMERGENCY STOP", self.first.labels)
        # Its team-mate knows where it stands.
        promise = self.second.peers["ugv1"].phases[-1]
        self.assertLess(math.dist((promise.x[-1], promise.y[-1]), self.first.place()), 0.06)
        self.check_stopped(self.first)
        self.first.tell(False)
        self.first.tell(False, "fleet/")
        self.settle()
        self.check_stopped(self.first)
        self.assertTrue(self.first.call(False, "fleet/").success)
        self.assertIn("still holds: emergency stop of ugv1", self.first.call(False, "fleet/").message)
        self.check_stopped(self.first)
        self.assertEqual(self.first.call(False).message, "no emergency stop")
        self.check_reset(self.first)
        self.assertIn("ugv1", self.first.labels)

    def test_a_robot_by_topic(self):
        self.drive_to_speed(self.second)
        self.check_stop(lambda: self.second.tell(True), self.second)
        self.assertFalse(self.first.state.stopped)
        self.second.tell(False)
        self.check_stopped(self.second)
        self.second.call(False)
        self.check_reset(self.second)

    def test_the_fleet_by_service(self):
        self.drive_to_speed(*self.robots)
        self.check_stop(lambda: self.second.call(True, "fleet/"), *self.robots)
        for robot in self.robots:
            self.assertEqual((robot.state.robot, robot.state.fleet, robot.state.by), (False, True, ["ugv2"]))
            self.check_stopped(robot)
        self.assertIn("still holds: emergency stop of the fleet by ugv2", self.first.call(False).message)
        self.first.call(True)
        self.first.call(False, "fleet/")  # not where it was ordered
        self.run_for(1.0)
        self.assertFalse(self.second.state.stopped)
        self.assertEqual((self.first.state.robot, self.first.state.fleet), (True, False))
        self.first.call(False)
        self.check_reset(*self.robots)

    def test_the_fleet_by_topic(self):
        self.drive_to_speed(*self.robots)
        self.check_stop(lambda: self.first.tell(True, "fleet/"), *self.robots)
        self.first.tell(False, "fleet/")
        self.settle()
        for robot in self.robots:
            self.check_stopped(robot)
        self.second.call(False, "fleet/")
        self.run_for(1.0)
        self.check_reset(*self.robots)

    def test_whoever_dies_it_stays_stopped(self):
        self.drive_to_speed(*self.robots)
        self.first.call(True)
        self.second.call(True, "fleet/")
        self.run_for(1.5)
        self.first.call(False, "fleet/")
        self.run_for(0.5)
        place = self.first.place()
        for node in NODES:
            with self.subTest(node):
                self.first.dead_for(node, 0.5)
                self.await_node(self.first, node)
                self.check_stopped(self.first)
                self.assertLess(math.dist(self.first.place(), place), 0.02)
        self.first.call(False)
        self.check_reset(self.first)

    def test_the_fleet_is_stopped_by_who_dies_and_comes_back(self):
        self.second.call(True, "fleet/")
        self.run_for(1.0)
        for robot in self.robots:
            robot.dead_for("trajectory_broadcaster", 0.5, self.run_for)
            self.await_node(robot, "trajectory_broadcaster")
            for each in self.robots:
                self.check_stopped(each)
        self.first.call(False, "fleet/")
        self.run_for(1.0)
        self.check_reset(*self.robots)

    def test_the_tracker_stops_without_the_broadcaster(self):
        self.drive_to_speed(self.first)
        dead = self.first.pairs(["trajectory_broadcaster"])

        def stop(seconds):
            speed = self.first.faster_wheel()
            self.first.tell(True)
            self.settle(*dead)
            self.run_for(PERIOD_S)
            self.settle(*dead)
            self.assertLess(self.first.faster_wheel(), speed - 0.9 * WHEEL_ACCELERATION * PERIOD_S)
            self.run_for(seconds)
            self.assertTrue(self.first.standing())
        self.first.dead_for("trajectory_broadcaster", STANDS_S, stop)
        self.await_node(self.first, "trajectory_broadcaster")
        place = self.first.place()
        self.run_for(2.0)
        self.assertFalse(self.first.state.stopped, "it cannot know")
        self.assertTrue(self.first.said("trajectory_tracker: .*has not said anything yet; to reset it: rosservice call /ugv1/emergency_stop false",
                                        self.first.now - 1.5), self.first.report())
        self.first.send(0.0, LANES["ugv1"])
        self.run_for(2.0)
        self.assertLess(math.dist(self.first.place(), place), 0.02)
        self.assertEqual(self.first.last_reason(), PlannerStatus.EMERGENCY_STOP)
        self.first.call(False)
        self.check_reset(self.first)

    def test_what_cannot_be_read_counts_as_stopped(self):
        self.first.call(True)
        self.first.call(False)
        with open(self.store, "w") as file:
            file.write("nonsense")
        self.first.dead_for("trajectory_broadcaster", 0.5)
        self.await_node(self.first, "trajectory_broadcaster")
        self.check_stopped(self.first)
        self.assertIn(self.store + " cannot be read", self.first.state.message)
        self.first.call(False)
        self.check_reset(self.first)

    def test_what_cannot_be_kept_is_said_and_tried_again(self):
        store = self.store
        os.remove(store)
        os.makedirs(store + "/in_the_way")
        self.assertIn("BUT: emergency stops are not kept over a restart: " + store, self.first.call(True).message)
        since = self.first.now
        self.run_for(2.0)
        self.assertTrue(self.first.said("trajectory_broadcaster: emergency stop: .*not kept over a restart", since))
        shutil.rmtree(store)
        self.run_for(2.0)
        with open(store) as file:
            self.assertIn("robot 1", file.read())


if __name__ == "__main__":
    rospy.init_node("emergency_stop_test")
    rostest.rosrun("mocha_ugv", "emergency_stop", EmergencyStopTest, sys.argv)
