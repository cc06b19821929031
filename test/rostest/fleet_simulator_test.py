#!/usr/bin/python3
"""The fleet_simulator node: its clock in lockstep with a node that this test plays, its sensors, and what it refuses."""

import math
import os
import subprocess
import sys
import tempfile
import threading
import time
import unittest

import rospkg
import rospy
import rostest
from diagnostic_msgs.msg import DiagnosticArray
from geometry_msgs.msg import Twist
from mocha_ugv.msg import GroundTruth, StepAck
from nav_msgs.msg import Odometry
from rosgraph_msgs.msg import Clock
from sensor_msgs.msg import LaserScan
from tf2_msgs.msg import TFMessage

from waiting import wait_until

START_S = 1.0
STEP_S = 0.02
ACK_TIMEOUT_S = 1.0  # as in fleet_simulator.test


class Driver:
    """The node `driver` of ugv1: commands a speed at each step and acknowledges the step, up to a time."""

    def __init__(self):
        self.changed = threading.Condition()
        self.clocks = []  # [s]
        self.came = {}  # wall time [s] at which a clock came first
        self.stamp = None
        self.until = 0.0
        self.twist = None
        self.truth = []
        self.scans = []
        self.odometry = []
        self.transforms = set()
        self.diagnosis = ""
        self.commands = rospy.Publisher("/ugv1/cmd_vel", Twist, queue_size=1, tcp_nodelay=True)
        self.acks = rospy.Publisher("/fleet_simulator/acks", StepAck, queue_size=10, tcp_nodelay=True)
        self.subscribers = [rospy.Subscriber(topic, kind, handle, tcp_nodelay=True) for topic, kind, handle in (
            ("/fleet_simulator/ground_truth", GroundTruth, self.truth.append), ("/ugv1/scan", LaserScan, self.scans.append),
            ("/ugv1/odom", Odometry, self.odometry.append), ("/tf", TFMessage, self.on_transforms),
            ("/tf_static", TFMessage, self.on_transforms), ("/diagnostics", DiagnosticArray, self.on_diagnostics),
            ("/clock", Clock, self.on_clock))]

    def on_transforms(self, message):
        for transform in message.transforms:
            self.transforms.add((transform.header.frame_id, transform.child_frame_id))

    def on_diagnostics(self, message):
        for status in message.status:
            if status.name.startswith("fleet_simulator"):
                self.diagnosis = status.message

    def on_clock(self, message):
        with self.changed:
            self.stamp = message.clock
            self.clocks.append(self.stamp.to_sec())
            self.came.setdefault(self.step_of(self.stamp.to_sec()), time.monotonic())
            self.answer()
            self.changed.notify_all()

    def answer(self):
        if self.stamp is None or self.clocks[-1] > self.until + 1e-6:
            return
        if self.twist is not None:
            self.commands.publish(self.twist)
        self.acks.publish(StepAck(robot="ugv1", node="driver", stamp=self.stamp))

    @staticmethod
    def step_of(clock_s):
        return round((clock_s - START_S) / STEP_S)

    def waited_s(self, clock_s):
        """For how long the simulator waited there, on the wall's clock, before it went on without any node; steps may then be missed here."""
        step = self.step_of(clock_s)
        wait_until(lambda: max(self.came) > step, "it goes on from %.2f s" % clock_s, 30.0)
        return min(wall_s for later, wall_s in list(self.came.items()) if later > step) - self.came[step]

    def connected(self):
        return all(each.get_num_connections() > 0 for each in (self.acks, self.commands, *self.subscribers))

    def rejoin(self, seconds, twist=None):
        """Answers whatever comes until the simulator waits for it again, and then for so long. Until when."""
        with self.changed:
            self.until, self.twist = math.inf, twist
            self.answer()
            begun = len(self.clocks)
            steady = lambda: len(self.clocks) > begun + 50 and self.clocks[-1] - self.clocks[-50] < 49.5 * STEP_S
            assert self.changed.wait_for(steady, 30.0), self.clocks[-5:]
            until = START_S + STEP_S * (self.step_of(self.clocks[-1]) + round(seconds / STEP_S))
        self.run_until(until, twist)
        return until

    def run_until(self, until, twist=None):
        with self.changed:
            self.until, self.twist = until, twist
            self.answer()
            assert self.changed.wait_for(lambda: self.clocks and self.clocks[-1] > until - 1e-6, 30.0), self.clocks[-1:]


def forward(speed):
    twist = Twist()
    twist.linear.x = speed
    return twist


class FleetSimulatorTest(unittest.TestCase):
    def test_drives_in_lockstep(self):
        driver = Driver()
        with driver.changed:  # the start is shown again and again, and nothing else
            self.assertTrue(driver.changed.wait_for(lambda: len(driver.clocks) >= 5 and driver.connected(), 20.0))
            self.assertEqual(set(driver.clocks), {START_S})
        self.assertEqual(len(driver.truth), 0)

        driver.run_until(3.0, forward(0.5))
        self.assertGreater(driver.waited_s(3.0 + STEP_S), 0.5 * ACK_TIMEOUT_S)  # for this test
        steps = sorted({clock for clock in list(driver.clocks) if clock < 3.0 + 1.5 * STEP_S})
        self.assertTrue(all(abs(b - a - STEP_S) < 1e-6 for a, b in zip(steps, steps[1:])))
        self.check_sensors(driver, 3.0 + STEP_S)
        self.check_missing_and_back(driver)
        self.check_refused_command(driver)

    def check_sensors(self, driver, end_s):
        """Of the drive up to then."""
        drive = lambda messages: [message for message in list(messages) if message.header.stamp.to_sec() < end_s + 0.5 * STEP_S]
        truth, odometries, scans = drive(driver.truth), drive(driver.odometry), drive(driver.scans)
        robot = truth[-1].robots[0]
        self.assertEqual((robot.name, robot.contacts, robot.has_goal, robot.reached), ("ugv1", 0, True, False))
        self.assertAlmostEqual(robot.speed, 0.5, places=3)
        self.assertGreater(robot.path_length, 0.8)
        self.assertAlmostEqual(robot.path_length, robot.pose.x + 3.0, places=3)
        self.assertAlmostEqual(robot.clearance, 5.0 - 0.3 - max(abs(robot.pose.x), 0.0), places=3)
        self.assertEqual(len(odometries), len(truth))
        odometry = odometries[-1]
        self.assertEqual((odometry.header.frame_id, odometry.child_frame_id), ("ugv1/odom", "ugv1/base_link"))
        self.assertAlmostEqual(odometry.twist.twist.linear.x, 0.5, places=3)
        self.assertAlmostEqual(odometry.pose.pose.position.x, robot.path_length, delta=0.06)
        stamps = [scan.header.stamp.to_sec() for scan in scans]
        for count, stamp in enumerate(stamps):
            self.assertAlmostEqual(stamp, START_S + 0.1 * count, places=6)
        self.assertGreaterEqual(len(stamps), 19)
        scan = scans[0]  # from (-3, 0), looking along x, in a room of 10 m
        self.assertEqual((scan.header.frame_id, len(scan.ranges)), ("ugv1/laser", 720))
        self.assertAlmostEqual(scan.angle_min + 720 * scan.angle_increment, scan.angle_min + 2.0 * math.pi, places=4)
        for beam, expected in ((360, 8.0), (180, 5.0), (540, 5.0)):
            self.assertAlmostEqual(scan.ranges[beam], expected, delta=0.06)
        self.assertEqual(driver.transforms, {("map", "ugv1/odom"), ("ugv1/odom", "ugv1/base_link"),
                                             ("ugv1/base_link", "ugv1/laser")})

    def check_missing_and_back(self, driver):
        wait_until(lambda: "missing: ugv1/driver" in driver.diagnosis, lambda: "it is missed; " + driver.diagnosis, 10.0)
        wait_until(lambda: driver.clocks[-1] > 10.0, "it goes on as fast as possible")
        self.assertEqual(driver.truth[-1].robots[0].speed, 0.0)  # the last command is stale
        until = driver.rejoin(10.0)
        self.assertGreater(driver.waited_s(until + STEP_S), 0.5 * ACK_TIMEOUT_S)  # again

    def check_refused_command(self, driver):
        driver.rejoin(2.0, forward(float("nan")))
        self.assertEqual(driver.truth[-1].robots[0].speed, 0.0)
        wait_until(lambda: "refused" in driver.diagnosis, lambda: "the refusal is told; " + driver.diagnosis, 10.0)

    def test_refuses_what_it_cannot_use(self):
        worlds = os.path.join(rospkg.RosPack().get_path("mocha_ugv"), "config", "worlds")
        with tempfile.NamedTemporaryFile("w", suffix=".yaml") as bad:
            bad.write("bounds: {min: [0, 0], max: [1, .nan]}\n")
            bad.flush()
            self.expect_fatal("world` is not set")
            self.expect_fatal("/no/such.yaml: cannot be read", "_world:=/no/such.yaml")
            self.expect_fatal("bounds.max[1] = .nan", "_world:=" + bad.name)
        empty = "_world:=" + os.path.join(worlds, "empty.yaml")
        self.expect_fatal("unknown parameter `rat`", empty, "_rat:=1.0")
        self.expect_fatal("rate = -1", empty, "_rate:=-1.0")

    def expect_fatal(self, message, *arguments):
        name = "refusing_%d" % time.monotonic_ns()
        result = subprocess.run(["rosrun", "mocha_ugv", "fleet_simulator", "__name:=" + name, *arguments],
                                stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, timeout=20.0)
        self.assertEqual(result.returncode, 1, result.stdout)
        self.assertIn(message, result.stdout)
        self.assertEqual(result.stdout.count("FATAL"), 1, result.stdout)


if __name__ == "__main__":
    rospy.init_node("fleet_simulator_test")
    rostest.rosrun("mocha_ugv", "fleet_simulator_test", FleetSimulatorTest, sys.argv)
