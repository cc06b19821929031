#!/usr/bin/python3
"""A robot with a lidar only gets past a person that heeds no robot; without usable predictions it stands, says why, and goes on with them."""

import math
import sys
import unittest

import rospy
import rostest
from diagnostic_msgs.msg import DiagnosticArray
from mocha_ugv.msg import PredictedObstacle, PredictedObstacles, Trajectory
from visualization_msgs.msg import MarkerArray

from simulated_robot import SimulatedRobot

LEFT, RIGHT = (-4.5, 0.0), (4.5, 0.0)  # m
WALKER_X = 1.5  # m, as in test/worlds/people.yaml
# Promised times, as in config/ [s].
PREDICTION_AGE_S = 0.6
LEASE_S = 0.5
BRAKING_S = 1.0 / 0.8  # from full speed
SLACK_S = 0.4  # actuator lag, and the periods of the nodes
STOP_S = PREDICTION_AGE_S + LEASE_S + BRAKING_S + SLACK_S
PATIENCE_S = 60.0  # simulated time for goals to be reached, and for words to come round
BLIND = "local_replanner: .*people: no usable word from perception"


class PeopleTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.followed = []
        cls.drawn = set()  # namespaces
        cls.values = {}  # of the newest diagnostics of detours
        rospy.Subscriber("/ugv1/local_trajectory", Trajectory, cls.followed.append)
        rospy.Subscriber("/ugv1/local_markers", MarkerArray, cls.on_markers)
        rospy.Subscriber("/diagnostics", DiagnosticArray, cls.on_diagnostics)
        cls.stranger = rospy.Publisher("/ugv1/predicted_obstacles", PredictedObstacles, queue_size=10)
        cls.robot = SimulatedRobot()
        cls.robot.start()

    @classmethod
    def on_markers(cls, message):
        cls.drawn.update(marker.ns for marker in message.markers)

    @classmethod
    def on_diagnostics(cls, message):
        for status in message.status:
            if status.name == "ugv1/local_replanner: detours":
                cls.values = {value.key: value.value for value in status.values}

    def setUp(self):
        self.contacts = self.robot.truth.contacts

    def tearDown(self):
        self.assertEqual(self.robot.truth.contacts, self.contacts, self.robot.report())

    def refused(self):
        return int(self.values.get("predictions refused", 0))

    def stopped_since(self, moment):
        """Whether it stood somewhere between its ends."""
        return any(at > moment and abs(speed) < 0.03 for at, speed, _ in self.robot.speeds)

    def drive_to_speed(self):
        """From the left end; it can still stop before it is where the person walks."""
        self.robot.arrive(*LEFT, limit_s=PATIENCE_S)
        self.robot.send(*RIGHT)
        self.robot.run_until(lambda: self.robot.truth.speed > 0.75, PATIENCE_S, "it drives at speed")
        self.assertLess(self.robot.place()[0], WALKER_X - 3.5)

    def check_stop(self, since):
        self.assertTrue(self.robot.stood_at(since + STOP_S), "it still moves; " + self.robot.report())
        self.assertLess(self.robot.place()[0], WALKER_X - 1.0)
        self.assertTrue(self.robot.said(BLIND, since), self.robot.report())
        self.assertFalse(self.robot.done(), self.robot.outcome())

    def check_arrival(self, why):
        self.robot.run_until(self.robot.done, PATIENCE_S, why)
        self.assertEqual(self.robot.outcome()[0], "SUCCEEDED", self.robot.report())
        self.assertLess(self.robot.distance_to(*RIGHT), 0.2)

    def test_it_swerves_or_stops_and_arrives(self):
        yielded = False
        self.robot.arrive(*LEFT, limit_s=PATIENCE_S)
        for goal in (RIGHT, LEFT, RIGHT, LEFT):
            begun, plans = self.robot.now, len(self.followed)
            self.robot.send(*goal)
            self.robot.run_until(lambda: not self.robot.standing(), PATIENCE_S, "it sets out")
            moved = self.robot.now
            self.robot.run_until(lambda: self.robot.distance_to(*goal) < 1.0 or self.robot.done(), PATIENCE_S, "it is nearly there")
            yielded = yielded or self.stopped_since(moved) or len(self.followed) > plans
            self.robot.run_until(self.robot.done, PATIENCE_S, "it arrives")
            self.assertEqual(self.robot.outcome()[0], "SUCCEEDED", self.robot.report())
            self.assertLess(self.robot.distance_to(*goal), 0.2)
            self.assertGreater(self.robot.now, begun + 9.0)
        self.assertTrue(yielded, "it neither swerved nor stopped at any crossing")
        self.robot.run_until(lambda: any("moving thing" in name for name in self.drawn), PATIENCE_S, "predictions are drawn")

    def test_perception_dies_while_somebody_walks(self):
        self.drive_to_speed()
        killed = self.robot.now
        self.robot.dead_for("perception", STOP_S + 1.0)
        self.check_stop(killed)
        self.robot.wait_for_node("perception")
        self.check_arrival("it goes on after the respawn of perception")

    def message(self, obstacles):
        message = PredictedObstacles()
        message.header.frame_id = "map"
        message.header.stamp = rospy.Time.from_sec(self.robot.now)
        message.obstacles = obstacles
        return message

    def nonsense(self):
        """Not a number, and more things than there can be."""
        wrong = PredictedObstacle(id=1, radius=0.3)
        wrong.position.x = math.nan
        return self.message([wrong]), self.message([PredictedObstacle(id=i, radius=0.3) for i in range(10000)])

    def shout(self, seconds):
        end = self.robot.now + seconds
        while self.robot.now < end:
            for message in self.nonsense():
                self.stranger.publish(message)
            self.robot.run(0.2)

    def test_a_stranger_publishes_nonsense(self):
        self.robot.arrive(*LEFT, limit_s=PATIENCE_S)
        process, before = self.robot.process("local_replanner"), self.refused()
        self.robot.send(*RIGHT)
        self.shout(3.0)
        self.robot.run_until(lambda: self.refused() > before, PATIENCE_S, "what is refused is counted")
        self.check_arrival("perception is heard all the same")
        self.assertEqual(self.robot.process("local_replanner"), process, "it died")

    def test_nothing_but_nonsense(self):
        self.drive_to_speed()
        process, killed = self.robot.process("local_replanner"), self.robot.now
        self.robot.dead_for("perception", STOP_S + 1.0, meanwhile=self.shout)
        self.check_stop(killed)
        self.assertEqual(self.robot.process("local_replanner"), process, "it died")
        self.robot.wait_for_node("perception")
        self.check_arrival("it goes on with perception")


if __name__ == "__main__":
    rospy.init_node("people_test")
    rostest.rosrun("mocha_ugv", "people", PeopleTest, sys.argv)
