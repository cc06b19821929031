#!/usr/bin/python3
"""Drives the trajectory_tracker node in lockstep: this test is the base, the clock, the broadcaster and the replanner."""

import math
import os
import signal
import sys
import threading
import unittest

import rospy
import rostest
from diagnostic_msgs.msg import DiagnosticArray
from geometry_msgs.msg import TransformStamped, Twist
from mocha_ugv.msg import Lease, MotionPhase, StepAck, Trajectory
from nav_msgs.msg import Odometry
from rosgraph_msgs.msg import Clock
from tf2_msgs.msg import TFMessage

from lockstep_clock import Acks
from node_process import pid_of
from waiting import wait_until

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
        self.values = {}
        self.diagnosed_s = 0.0
        self.answers = Acks()
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
                self.diagnosed_s = array.header.stamp.to_sec()
                self.values = {value.key: value.value for value in status.values}
                self.diagnosis = status.message + " " + " ".join(self.values.values())

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

    def settle(self):
        """Until the tracker has taken what was published; simulated time stands."""
        self.answers.settle(self.clock_pub, rospy.Time.from_sec(self.t).to_nsec(), {("ugv1", "trajectory_tracker")})

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
        cls.sequence = 0
        cls.wait_for_node()

    @classmethod
    def next_sequence(cls):
        cls.sequence += 1
        return cls.sequence

    @classmethod
    def wait_for_node(cls):
        """Until the tracker hears everything and answers; simulated time goes on meanwhile."""
        publishers = [cls.base.clock_pub, cls.base.odom_pub, cls.base.tf_pub, cls.trajectories, cls.leases]
        wait_until(lambda: all(p.get_num_connections() > 0 for p in publishers) and cls.base.step(0.5), "the tracker answers", 30.0)

    def setUp(self):
        """It stands on the x axis."""
        self.base.y = self.base.yaw = self.base.speed = self.base.yaw_rate = 0.0

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
        self.base.settle()

    def hear(self, words):
        """Until diagnostics say so, which come every second of simulated time."""
        wait_until(lambda: words in self.base.diagnosis, lambda: words + "; " + self.base.diagnosis, 30.0)

    def refused(self):
        """How many messages, by diagnostics of now."""
        since = self.base.t
        self.run_for(1.2)
        wait_until(lambda: self.base.diagnosed_s >= since, "diagnostics", 30.0)
        return int(self.base.values["refused messages"])

    def drive_to_half(self, distance=2.0):
        """Commits a drive and stops in the middle of it, at full speed; where it began."""
        x = self.base.x
        sequence = self.next_sequence()
        self.commit(straight(self.base.t + 0.2, self.base.t, sequence, x, x + distance, 2.5 * distance))
        self.run_for(0.2 + 1.25 * distance, lease_of=sequence)
        self.assertGreater(self.base.speed, 0.6)
        return x

    def test_without_a_motion_it_commands_zero(self):
        self.assertEqual(self.run_for(0.5), 0.0)

    def test_malformed_messages_are_refused_and_counted(self):
        before = self.refused()
        x = self.base.x
        bad = straight(self.base.t, self.base.t, self.next_sequence(), x, x + 2.0, 5.0)
        bad.phases[0].x[1] = float("nan")
        self.commit(bad)
        bad = straight(self.base.t, self.base.t, self.next_sequence(), x, x + 2.0, 5.0)
        bad.agent = "ugv2"
        self.commit(bad)
        self.leases.publish(Lease(epoch=1, sequence=self.next_sequence(), valid_until=rospy.Time.from_sec(self.base.t + 3600.0)))
        self.base.settle()
        self.assertEqual(self.run_for(2.5), 0.0)
        self.hear("more than max_lease")
        self.assertEqual(self.refused(), before + 3)

    def test_drives_a_committed_motion(self):
        x = self.drive_to_half()
        self.run_for(4.0, lease_of=self.sequence)
        self.assertAlmostEqual(self.base.x - x, 2.0, delta=0.02)
        self.assertAlmostEqual(self.base.y, 0.0, delta=0.02)
        self.assertAlmostEqual(self.base.speed, 0.0, delta=1e-3)

    def test_brakes_when_the_lease_ends_and_stays(self):
        x = self.drive_to_half(6.0)  # without braking, 3 m more
        self.run_for(4.0)
        braked = self.base.x - x - 3.0
        speed = 1.875 * 6.0 / 15.0
        self.assertLess(braked, speed * 0.5 + speed ** 2 / (2.0 * 0.6 * 0.8) + 0.2 * speed + 0.05)
        self.assertAlmostEqual(self.base.speed, 0.0, delta=1e-3)
        self.assertLess(self.run_for(1.0, lease_of=self.sequence), 1e-3, "a lease alone does not resume")
        self.hear("the lease ended")

    def test_stops_without_odometry(self):
        self.drive_to_half()
        self.base.odometry_on = False
        self.run_for(1.8, lease_of=self.sequence)
        self.assertLess(abs(self.base.speed), 1e-2)
        self.run_for(1.5, lease_of=self.sequence)
        self.hear("no odometry on /ugv1/odom for")
        self.base.odometry_on = True
        self.assertLess(self.run_for(1.0, lease_of=self.sequence), 0.3, "the motion has gone on without the robot")
        self.run_for(2.0)
        self.assertAlmostEqual(self.base.speed, 0.0, delta=1e-3)

    def test_a_respawned_tracker_waits_for_a_new_motion(self):
        self.drive_to_half()
        os.kill(pid_of(NODE), signal.SIGINT)
        wait_until(lambda: self.trajectories.get_num_connections() == 0, "the tracker ends", 30.0)
        wait_until(lambda: self.base.command.linear.x == 0.0, "the last command is a stop", 5.0)
        self.base.speed = 0.0
        self.wait_for_node()
        self.base.settle()
        x = self.base.x
        self.run_for(1.0)
        self.assertAlmostEqual(self.base.x, x, delta=1e-3)
        self.drive_to_half()
        self.run_for(4.0, lease_of=self.sequence)
        self.assertAlmostEqual(self.base.x - x, 2.0, delta=0.03)


if __name__ == "__main__":
    rospy.init_node("tracker_test", disable_rostime=True)
    rostest.rosrun("mocha_ugv", "tracker", TrackerTest, sys.argv)
