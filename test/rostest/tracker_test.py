#!/usr/bin/python3
"""Drives the trajectory_tracker node in lockstep: this test is the base, the clock, the broadcaster and the replanner."""

import math
import os
import signal
import sys
import threading
import time
import unittest

import rospy
import rostest
from diagnostic_msgs.msg import DiagnosticArray
from geometry_msgs.msg import TransformStamped, Twist
from mocha_ugv.msg import Lease, MotionPhase, StepAck, Trajectory
from nav_msgs.msg import Odometry
from rosgraph_msgs.msg import Clock
from tf2_msgs.msg import TFMessage

from node_process import pid_of

STEP_S = 0.02
LAG_S = 0.05
NODE = "/ugv1/trajectory_tracker"


class Base:
    """A unicycle with lag that runs in steps, each acknowledged by the tracker."""

    def __init__(self):
        self.t = 100.0
        self.x = self.y = self.yaw = self.speed = self.yaw_rate = 0.0
        self.command = Twist()
        self.commands = 0
        self.odometry_on = True
        self.diagnosis = ""
        self.acked = threading.Condition()
        self.ack_stamp = 0.0
        self.clock_pub = rospy.Publisher("/clock", Clock, queue_size=10, tcp_nodelay=True)
        self.odom_pub = rospy.Publisher("/ugv1/odom", Odometry, queue_size=10, tcp_nodelay=True)
        self.tf_pub = rospy.Publisher("/tf", TFMessage, queue_size=10, tcp_nodelay=True)
        rospy.Subscriber("/ugv1/cmd_vel", Twist, self.on_command, tcp_nodelay=True)
        rospy.Subscriber("/fleet_simulator/acks", StepAck, self.on_ack, tcp_nodelay=True)
        rospy.Subscriber("/diagnostics", DiagnosticArray, self.on_diagnostics)

    def on_command(self, command):
        with self.acked:
            self.command = command
            self.commands += 1
            self.acked.notify()

    def on_ack(self, ack):
        with self.acked:
            self.ack_stamp = ack.stamp.to_sec()
            self.acked.notify()

    def on_diagnostics(self, array):
        for status in array.status:
            if "tracking" in status.name:
                self.diagnosis = status.message + " " + " ".join(v.value for v in status.values)

    def publish(self):
        stamp = rospy.Time.from_sec(self.t)
        odom = Odometry()
        odom.header.stamp = stamp
        odom.header.frame_id = "ugv1/odom"
        odom.child_frame_id = "ugv1/base_link"
        odom.pose.pose.position.x, odom.pose.pose.position.y = self.x, self.y
        odom.pose.pose.orientation.z = math.sin(0.5 * self.yaw)
        odom.pose.pose.orientation.w = math.cos(0.5 * self.yaw)
        odom.twist.twist.linear.x, odom.twist.twist.angular.z = self.speed, self.yaw_rate
        transform = TransformStamped()
        transform.header.stamp = stamp
        transform.header.frame_id = "map"
        transform.child_frame_id = "ugv1/odom"
        transform.transform.rotation.w = 1.0
        self.tf_pub.publish(TFMessage([transform]))
        if self.odometry_on:
            self.odom_pub.publish(odom)
        self.clock_pub.publish(Clock(stamp))

    def step(self, timeout_s=10.0):
        """One step of simulated time; False if the tracker did not answer."""
        self.t += STEP_S
        with self.acked:
            before = self.commands
            self.publish()
            done = self.acked.wait_for(
                lambda: self.commands > before and self.ack_stamp > self.t - 1e-4, timeout_s)
        share = 1.0 - math.exp(-STEP_S / LAG_S)
        self.speed += share * (self.command.linear.x - self.speed)
        self.yaw_rate += share * (self.command.angular.z - self.yaw_rate)
        self.yaw += STEP_S * self.yaw_rate
        self.x += STEP_S * self.speed * math.cos(self.yaw)
        self.y += STEP_S * self.speed * math.sin(self.yaw)
        return done


def straight(start_time, stamp, sequence, x0, x1, duration):
    """A committed drive along the x axis from rest to rest."""
    phase = MotionPhase(kind=MotionPhase.DRIVE, direction=1, durations=[duration], x=[x0, x1], y=[0.0, 0.0],
                        start_derivatives=[0.0] * 4, end_derivatives=[0.0] * 4)
    message = Trajectory(state=Trajectory.COMMITTED, agent="ugv1", epoch=1, sequence=sequence, s=3,
                         start=rospy.Time.from_sec(start_time), phases=[phase])
    message.header.frame_id = "map"
    message.header.stamp = rospy.Time.from_sec(stamp)
    return message


class TrackerTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.base = Base()
        cls.trajectories = rospy.Publisher("/ugv1/committed_trajectory", Trajectory, queue_size=5, latch=True)
        cls.leases = rospy.Publisher("/ugv1/lease", Lease, queue_size=5)
        cls.wait_for_node()

    @classmethod
    def wait_for_node(cls):
        """Until the tracker hears everything and answers; simulated time goes on meanwhile."""
        publishers = [cls.base.clock_pub, cls.base.odom_pub, cls.base.tf_pub, cls.trajectories, cls.leases]
        deadline = time.monotonic() + 30.0
        while time.monotonic() < deadline:
            if all(p.get_num_connections() > 0 for p in publishers) and cls.base.step(0.5):
                return
            time.sleep(0.1)
        raise AssertionError("the tracker does not answer")

    def run_for(self, duration, lease_of=None):
        """Runs the base; with `lease_of` a sequence whose lease is renewed at 10 Hz. The highest speed on the way."""
        fastest = 0.0
        for i in range(round(duration / STEP_S)):
            if lease_of is not None and i % 5 == 0:
                lease = Lease(epoch=1, sequence=lease_of, valid_until=rospy.Time.from_sec(self.base.t + 0.5))
                lease.header.stamp = rospy.Time.from_sec(self.base.t)
                self.leases.publish(lease)
            self.assertTrue(self.base.step(), "no answer to a step")
            fastest = max(fastest, abs(self.base.speed))
        return fastest

    def commit(self, message):
        """Publishes and lets it arrive: it travels on another connection than the clock."""
        self.trajectories.publish(message)
        time.sleep(0.3)

    def drive_to_half(self, sequence, distance=2.0):
        """Commits a drive and stops in the middle of it, at full speed."""
        x = self.base.x
        self.commit(straight(self.base.t + 0.2, self.base.t, sequence, x, x + distance, 2.5 * distance))
        self.run_for(0.2 + 1.25 * distance, lease_of=sequence)
        self.assertGreater(self.base.speed, 0.6)
        return x

    def test_1_without_a_motion_it_commands_zero(self):
        self.assertEqual(self.run_for(0.5), 0.0)

    def test_2_malformed_messages_are_refused_and_counted(self):
        bad = straight(self.base.t, self.base.t, 1, 0.0, 2.0, 5.0)
        bad.phases[0].x[1] = float("nan")
        self.commit(bad)
        bad = straight(self.base.t, self.base.t, 2, 0.0, 2.0, 5.0)
        bad.agent = "ugv2"
        self.commit(bad)
        self.leases.publish(Lease(epoch=1, sequence=3, valid_until=rospy.Time.from_sec(self.base.t + 3600.0)))
        time.sleep(0.3)
        self.assertEqual(self.run_for(2.5), 0.0)
        time.sleep(0.3)
        self.assertIn("more than max_lease", self.base.diagnosis)
        self.assertIn(" 3 ", self.base.diagnosis)

    def test_3_drives_a_committed_motion(self):
        x = self.drive_to_half(10)
        self.run_for(4.0, lease_of=10)
        self.assertAlmostEqual(self.base.x - x, 2.0, delta=0.02)
        self.assertAlmostEqual(self.base.y, 0.0, delta=0.02)
        self.assertAlmostEqual(self.base.speed, 0.0, delta=1e-3)

    def test_4_brakes_when_the_lease_ends_and_stays(self):
        x = self.drive_to_half(20)
        self.run_for(4.0)
        braked = self.base.x - x - 1.0
        speed = 1.875 * 2.0 / 5.0
        self.assertLess(braked, speed * 0.5 + speed ** 2 / (2.0 * 0.8) + 0.2 * speed + 0.05)
        self.assertAlmostEqual(self.base.speed, 0.0, delta=1e-3)
        self.assertLess(self.run_for(1.0, lease_of=20), 1e-3, "a lease alone does not resume")
        self.assertIn("the lease ended", self.base.diagnosis)

    def test_5_stops_without_odometry(self):
        self.drive_to_half(30)
        self.base.odometry_on = False
        self.run_for(1.8, lease_of=30)
        self.assertLess(abs(self.base.speed), 1e-2)
        self.run_for(1.5, lease_of=30)
        time.sleep(0.3)
        self.assertIn("no odometry on /ugv1/odom for", self.base.diagnosis)
        self.base.odometry_on = True
        self.assertLess(self.run_for(1.0, lease_of=30), 0.3, "the motion has gone on without the robot")
        self.run_for(2.0)
        self.assertAlmostEqual(self.base.speed, 0.0, delta=1e-3)

    def test_6_a_respawned_tracker_waits_for_a_new_motion(self):
        self.drive_to_half(40)
        os.kill(pid_of(NODE), signal.SIGINT)
        deadline = time.monotonic() + 30.0
        while self.trajectories.get_num_connections() > 0 and time.monotonic() < deadline:
            time.sleep(0.05)
        self.assertEqual(self.base.command.linear.x, 0.0, "the last command has to be a stop")
        self.base.speed = 0.0
        self.wait_for_node()
        time.sleep(0.3)
        x = self.base.x
        self.run_for(1.0)
        self.assertAlmostEqual(self.base.x, x, delta=1e-3)
        self.drive_to_half(41)
        self.run_for(4.0, lease_of=41)
        self.assertAlmostEqual(self.base.x - x, 2.0, delta=0.03)


if __name__ == "__main__":
    rospy.init_node("tracker_test", disable_rostime=True)
    rostest.rosrun("mocha_ugv", "tracker", TrackerTest, sys.argv)
