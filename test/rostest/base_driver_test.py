#!/usr/bin/python3
"""Drives the emulated base through base_driver and a serial line, and breaks one thing after another: each time the vehicle
has to stop within its limits, and to go on when the cause is gone. What the vehicle does is the emulator's truth, not
what the driver believes."""

import json
import math
import os
import random
import signal
import sys
import threading
import time
import unittest

import rospy
import rostest
from diagnostic_msgs.msg import DiagnosticArray
from geometry_msgs.msg import Twist
from mocha_ugv.msg import EmergencyStopState
from nav_msgs.msg import Odometry
from sensor_msgs.msg import BatteryState, Imu
from std_msgs.msg import Bool
from std_srvs.srv import Trigger
from tf2_msgs.msg import TFMessage

from node_process import end, pid_of
from serial_line import SerialLine
from waiting import wait_until

SPEED = 0.4
HEARTBEAT_S = 0.3
COMMAND_AGE_S = 0.3
FEEDBACK_TIMEOUT_S = 0.3
# From the order to stand: the ramp of 2 m/s^2, the wheels' lag of 0.1 s, and this machine, which others use, too.
BRAKING_S = SPEED / 2.0 + 0.5
SCHEDULING_S = 0.3
STANDING = 0.02
FRICTION_PWM, PWM_PER_SPEED = 35.0, 169.0  # the driver's
CATCH_UP = 0.15  # m/s: what it may add at once for a wheel that stalls, or is behind
TOPICS = {"/ugv1/base_emulator/truth": Odometry, "/ugv1/odom": Odometry, "/ugv1/imu": Imu, "/ugv1/battery": BatteryState, "/tf": TFMessage}


def heading_of(pose):
    return 2.0 * math.atan2(pose.orientation.z, pose.orientation.w)


def since(begun, now):
    """Where a pose is, as seen from the one before: x, y [m] and yaw [rad]."""
    x, y, yaw = now.position.x - begun.position.x, now.position.y - begun.position.y, heading_of(begun)
    return (math.cos(yaw) * x + math.sin(yaw) * y, math.cos(yaw) * y - math.sin(yaw) * x, heading_of(now) - yaw)


def speed_of(twist):
    return abs(twist.linear.x) + 0.1 * abs(twist.angular.z)


class Watch:
    """The newest messages, by topic."""

    def __init__(self):
        self.lock = threading.Lock()
        self.newest = {}
        self.speeds = []  # (time [s], speed) of the truth
        self.rates = []  # [rad/s] by the gyroscope
        self.diagnosis = {}
        self.diagnosed_s = 0.0
        for topic, kind in TOPICS.items():
            rospy.Subscriber(topic, kind, self.on, callback_args=topic, tcp_nodelay=True)
        rospy.Subscriber("/diagnostics", DiagnosticArray, self.on_diagnostics)

    def on(self, message, topic):
        with self.lock:
            self.newest[topic] = message
            if topic.endswith("truth"):
                self.speeds.append((message.header.stamp.to_sec(), speed_of(message.twist.twist)))
            if topic.endswith("imu"):
                self.rates.append(message.angular_velocity.z)

    def on_diagnostics(self, array):
        for status in array.status:
            self.diagnosis[status.name] = status
            if status.name.endswith("base_driver: base"):
                self.diagnosed_s = array.header.stamp.to_sec()

    def truth(self):
        return self.newest["/ugv1/base_emulator/truth"]

    def speed(self):
        return self.speeds[-1][1]

    def odometry(self):
        return self.newest["/ugv1/odom"]

    def base(self):
        """What diagnostics say of the base: message and values."""
        for name, status in self.diagnosis.items():
            if name.endswith("base_driver: base"):
                return status.message, {value.key: value.value for value in status.values}
        return "", {}


class Commander:
    """Publishes velocities at 50 Hz, unless it is told to be silent."""

    def __init__(self):
        self.publisher = rospy.Publisher("/ugv1/cmd_vel", Twist, queue_size=1, tcp_nodelay=True)
        self.twist = None
        rospy.Timer(rospy.Duration(0.02), self.publish)

    def publish(self, _):
        twist = self.twist
        if twist is not None:
            self.publisher.publish(twist)

    def drive(self, speed, yaw_rate=0.0):
        twist = Twist()
        twist.linear.x, twist.angular.z = speed, yaw_rate
        self.twist = twist

    def be_silent(self):
        self.twist = None


class BaseDriverTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        base, port = rospy.get_param("/ugv1/base_emulator/link"), rospy.get_param("/ugv1/base_driver/port")
        wait_until(lambda: os.path.exists(base), "the emulator is there", 30.0)
        cls.line = SerialLine(base, port)
        cls.watch = Watch()
        cls.commander = Commander()
        cls.state = rospy.Publisher("/ugv1/emergency_stop_state", EmergencyStopState, queue_size=1, latch=True)
        cls.order = rospy.Publisher("/ugv1/emergency_stop", Bool, queue_size=1)
        cls.resets = 0

    @classmethod
    def tearDownClass(cls):
        cls.commander.be_silent()
        if os.path.islink(cls.line.link):
            os.unlink(cls.line.link)

    def setUp(self):
        self.line.damage = None
        if self.line.end is None:
            self.line.plug()
        self.reset()

    def reset(self):
        """What trajectory_broadcaster says after an emergency stop."""
        BaseDriverTest.resets += 1
        self.state.publish(stopped=False, resets=self.resets)

    def stop(self):
        """What it says of one."""
        self.state.publish(stopped=True, resets=self.resets, message="a button")

    def wait(self, condition, timeout_s, what):
        wait_until(condition, lambda: f"{what}; base: {self.watch.base()}", timeout_s)

    def watch_for(self, duration_s):
        """The speeds that the base had for so long, by its own clock."""
        begun_s = self.watch.truth().header.stamp.to_sec()
        self.wait(lambda: self.watch.speeds[-1][0] >= begun_s + duration_s, 10.0 * duration_s + 10.0, "the base lives")
        return [speed for at_s, speed in list(self.watch.speeds) if at_s > begun_s]

    def driver_lives_for(self, duration_s):
        """Until the driver has gone on for so long, by its diagnostics."""
        begun_s = self.watch.diagnosed_s
        self.wait(lambda: self.watch.diagnosed_s >= begun_s + duration_s, 10.0 * duration_s + 10.0, "the driver lives")

    def drive(self, timeout_s=15.0):
        """Until the vehicle really drives, and the driver says so, too."""
        self.commander.drive(SPEED)
        self.wait(lambda: "/ugv1/base_emulator/truth" in self.watch.newest and self.watch.speed() > 0.9 * SPEED, timeout_s,
                  "the vehicle drives")
        self.wait(lambda: self.watch.odometry().twist.twist.linear.x > 0.8 * SPEED, 2.0, "odometry says so")

    def stands_within(self, limit_s):
        self.wait(lambda: self.watch.speed() < STANDING, limit_s + BRAKING_S + SCHEDULING_S, "the vehicle stands")

    def stays_standing(self, duration_s):
        self.assertLess(max(self.watch_for(duration_s)), STANDING)

    def test_stands_without_a_command_and_answers(self):
        self.commander.be_silent()
        self.wait(lambda: set(self.watch.newest) == set(TOPICS), 20.0, "the driver says all that it knows")
        self.stands_within(COMMAND_AGE_S)
        self.stays_standing(0.5)
        odometry = self.watch.odometry()
        self.assertEqual(odometry.header.frame_id, "ugv1/odom")
        self.assertEqual(odometry.child_frame_id, "ugv1/base_link")
        self.assertLess(abs(odometry.header.stamp.to_sec() - time.time()), 0.3)
        for place in (0, 7, 35):
            self.assertGreater(odometry.pose.covariance[place], 0.0)
            self.assertGreater(odometry.twist.covariance[place], 0.0)
        self.assertAlmostEqual(self.watch.newest["/ugv1/imu"].linear_acceleration.z, 9.81, delta=0.05)
        self.assertAlmostEqual(self.watch.newest["/ugv1/battery"].voltage, 11.85, delta=0.01)
        transforms = [t for t in self.watch.newest["/tf"].transforms if t.child_frame_id == "ugv1/base_link"]
        self.assertEqual(transforms[0].header.frame_id, "ugv1/odom")

    def test_drives_and_knows_how_far(self):
        self.drive()
        self.commander.drive(0.0)
        self.stands_within(0.0)
        self.stays_standing(0.2)
        before = self.watch.truth().pose.pose, self.watch.odometry().pose.pose
        self.commander.drive(0.3, 0.6)
        self.watch_for(1.0)
        turning = len(self.watch.rates)
        self.watch_for(3.0)
        rates = self.watch.rates[turning:]
        self.assertAlmostEqual(sum(rates) / len(rates), 0.6, delta=0.05)
        self.commander.drive(0.0)
        self.stands_within(0.0)
        self.stays_standing(0.2)
        stood = self.watch.truth().header.stamp
        self.wait(lambda: self.watch.odometry().header.stamp > stood, 3.0, "odometry")
        truth, odometry = [since(begun, now.pose.pose) for begun, now in zip(before, (self.watch.truth(), self.watch.odometry()))]
        self.assertGreater(math.hypot(truth[0], truth[1]), 0.5)
        self.assertLess(math.hypot(truth[0] - odometry[0], truth[1] - odometry[1]), 0.05)
        self.assertLess(abs(math.remainder(truth[2] - odometry[2], 2.0 * math.pi)), 0.06)

    def test_only_what_is_under_the_heartbeat_is_sent_and_ramped(self):
        self.drive()
        end("/ugv1/base_driver", signal.SIGKILL)
        mark = len(self.line.from_computer)
        self.stands_within(HEARTBEAT_S)
        self.drive(timeout_s=20.0)  # another driver does
        self.watch_for(0.5)
        sent = [json.loads(line) for line in bytes(self.line.from_computer[mark:]).split(b"\n")[1:-1] if line]
        self.assertNotIn(13, {line["T"] for line in sent})
        self.assertEqual(sent[0], {"T": 136, "cmd": 300}, "the heartbeat comes first")
        left = [line["L"] for line in sent if line["T"] == 11]
        self.assertGreater(max(left), FRICTION_PWM + 0.3 * PWM_PER_SPEED)
        steps = [abs(b - a) for a, b in zip(left, left[1:]) if a * b != 0]  # but for what friction takes
        self.assertLess(max(steps), PWM_PER_SPEED * (2.0 * 0.1 + CATCH_UP), "no step beyond the ramp")
        self.assertLess(sorted(steps)[int(0.98 * len(steps)) - 2], PWM_PER_SPEED * 2.0 * 0.06)

    def battery(self):
        return next((status for name, status in self.watch.diagnosis.items() if name.endswith("base_driver: battery")), None)

    def test_a_low_battery_is_reported_and_an_empty_one_is_an_error(self):
        self.drive()
        for level, reading, words in ((0, b"1185", "11.85 V"), (1, b"950", "9.50 V: low"), (2, b"880", "8.80 V: empty")):
            self.line.damage = lambda said, reading=reading: said.replace(b'"v":1185', b'"v":' + reading)
            self.wait(lambda: self.battery() and self.battery().message == words, 5.0, words)
            self.assertEqual(self.battery().level, level)
        self.line.damage = None
        self.drive()

    def test_stops_when_commands_stay_away(self):
        self.drive()
        self.commander.be_silent()
        self.stands_within(COMMAND_AGE_S)
        self.stays_standing(0.5)
        self.drive()

    def test_refuses_commands_that_are_not_finite(self):
        self.drive()
        refused = lambda: int(self.watch.base()[1].get("refused commands", 0))  # noqa: E731
        before = refused()
        self.commander.drive(float("nan"))
        self.stands_within(COMMAND_AGE_S)
        self.wait(lambda: refused() > before, 3.0, "refused commands are counted")
        self.drive()

    def test_a_pulled_port_stops_it_and_it_goes_on_when_plugged_in(self):
        self.drive()
        self.line.pull()
        self.stands_within(HEARTBEAT_S)
        self.wait(lambda: "lost" in self.watch.base()[0], 3.0, "diagnostics say so")
        self.stays_standing(1.5)
        self.line.plug()
        self.drive(timeout_s=5.0)
        self.assertGreaterEqual(int(self.watch.base()[1]["port lost"]), 1)

    def test_garbage_is_counted_and_it_drives_on(self):
        self.drive()
        garbage = lambda: int(self.watch.base()[1].get("lines refused: garbage", 0))  # noqa: E731
        before = garbage()
        noise = random.Random(1)
        for _ in range(100):
            self.line.inject(bytes(noise.randrange(256) for _ in range(noise.randrange(1, 60))) + b"\n")
            self.assertGreater(min(self.watch_for(0.02)), 0.5 * SPEED)
        self.wait(lambda: garbage() > before + 20, 3.0, "garbage is counted")
        self.drive()

    def test_nothing_but_garbage_stops_it(self):
        self.drive()
        noise = random.Random(2)
        self.line.damage = lambda said: bytes(noise.randrange(256) for _ in said)
        self.stands_within(FEEDBACK_TIMEOUT_S)
        self.wait(lambda: "no feedback" in self.watch.base()[0], 3.0, "diagnostics say so")
        self.line.damage = None
        self.drive(timeout_s=5.0)

    def test_half_lines_are_counted_and_the_whole_ones_used(self):
        self.drive()
        garbage = lambda: int(self.watch.base()[1].get("lines refused: garbage", 0))  # noqa: E731
        before = garbage()
        cut = random.Random(3)

        def lose_some(said):
            return b"" if cut.random() < 0.1 else said[:cut.randrange(len(said))] if cut.random() < 0.2 else said

        self.line.damage = lose_some
        self.assertGreater(min(self.watch_for(3.0)), 0.5 * SPEED)
        self.line.damage = None
        self.wait(lambda: garbage() > before + 5, 3.0, "half lines are counted")
        self.drive()

    def test_nothing_but_half_lines_stops_it(self):
        self.drive()
        self.line.damage = lambda said: said[:len(said) // 2] + b"\n"
        self.stands_within(FEEDBACK_TIMEOUT_S)
        self.line.damage = None
        self.drive(timeout_s=5.0)

    def test_a_line_without_end_does_not_hurt(self):
        self.drive()
        self.line.damage = lambda said: said.replace(b"\n", b"x")
        self.stands_within(FEEDBACK_TIMEOUT_S)
        self.line.damage = None
        self.drive(timeout_s=5.0)
        self.wait(lambda: int(self.watch.base()[1]["lines refused: without end"]) >= 1, 3.0, "counted")

    def test_a_frozen_base_is_noticed_and_does_not_run_off_when_it_thaws(self):
        self.drive()
        pid = pid_of("/ugv1/base_emulator")
        os.kill(pid, signal.SIGSTOP)
        try:
            self.wait(lambda: "no feedback" in self.watch.base()[0], FEEDBACK_TIMEOUT_S + 3.0, "noticed")
            self.commander.be_silent()
            self.driver_lives_for(1.0)
        finally:
            os.kill(pid, signal.SIGCONT)
        self.stands_within(HEARTBEAT_S)
        self.stays_standing(1.0)
        self.drive(timeout_s=5.0)

    def test_a_frozen_base_goes_on_by_itself_when_commands_go_on(self):
        self.drive()
        pid = pid_of("/ugv1/base_emulator")
        os.kill(pid, signal.SIGSTOP)
        try:
            self.driver_lives_for(1.0)
        finally:
            os.kill(pid, signal.SIGCONT)
        self.drive(timeout_s=5.0)

    def test_a_killed_driver_is_stopped_by_the_heartbeat(self):
        self.drive()
        os.kill(pid_of("/ugv1/base_driver"), signal.SIGKILL)
        self.stands_within(HEARTBEAT_S)  # within its respawn delay
        self.drive(timeout_s=20.0)

    def test_a_frozen_driver_is_stopped_by_the_heartbeat(self):
        self.drive()
        pid = pid_of("/ugv1/base_driver")
        os.kill(pid, signal.SIGSTOP)
        try:
            self.stands_within(HEARTBEAT_S)
            self.stays_standing(1.0)
        finally:
            os.kill(pid, signal.SIGCONT)
        self.drive(timeout_s=5.0)

    def test_a_driver_that_is_told_to_end_stops_the_base_itself(self):
        self.drive()
        mark = len(self.line.from_computer)
        os.kill(pid_of("/ugv1/base_driver"), signal.SIGTERM)
        self.stands_within(0.0)
        last = bytes(self.line.from_computer[mark:]).split(b"\n")[-2]
        self.assertEqual(json.loads(last), {"T": 11, "L": 0, "R": 0})
        self.drive(timeout_s=20.0)

    def test_a_base_that_restarts_gets_its_heartbeat_again(self):
        self.drive()
        before = self.watch.odometry().pose.pose.position
        rospy.ServiceProxy("/ugv1/base_emulator/restart", Trigger)()
        self.watch_for(1.5)
        after = self.watch.odometry().pose.pose.position
        self.assertLess(math.hypot(after.x - before.x, after.y - before.y), 1.5, "odometry does not jump")
        self.drive()
        os.kill(pid_of("/ugv1/base_driver"), signal.SIGKILL)
        self.stands_within(HEARTBEAT_S)
        self.drive(timeout_s=20.0)

    def said_since(self, mark):
        """What the driver has told the base: numbers of the commands."""
        return [json.loads(line)["T"] for line in bytes(self.line.from_computer[mark:]).split(b"\n")[1:-1] if line]

    def test_an_emergency_stop_is_ramped_and_holds_until_its_reset(self):
        self.drive()
        mark = len(self.line.from_computer)
        self.stop()
        self.stands_within(0.0)
        self.stays_standing(1.0)
        self.wait(lambda: self.watch.base()[0] == "a button", 3.0, "diagnostics say so")
        lines = [json.loads(line) for line in bytes(self.line.from_computer[mark:]).split(b"\n")[1:-1] if line]
        held = [line["T"] for line in lines].index(0)
        ramp = [line["L"] for line in lines[:held] if line["T"] == 11]
        self.assertEqual(ramp[-1], 0)
        steps = [abs(b - a) for a, b in zip(ramp, ramp[1:]) if a * b != 0]
        self.assertLess(max(steps), PWM_PER_SPEED * (2.0 * 0.1 + CATCH_UP), "no step beyond the ramp")
        mark = len(self.line.from_computer)
        self.reset()
        self.drive()
        self.assertIn(999, self.said_since(mark))

    def test_an_emergency_stop_on_the_topic_needs_nobody_else(self):
        self.drive()
        self.order.publish(True)
        self.stands_within(0.0)
        self.order.publish(False)
        self.state.publish(stopped=False, resets=self.resets)  # of before
        self.stays_standing(1.0)
        self.wait(lambda: "emergency stop by" in self.watch.base()[0], 3.0, "diagnostics say so")
        self.reset()
        self.drive()

    def test_a_driver_that_is_started_again_stays_stopped(self):
        self.drive()
        self.stop()
        self.stands_within(0.0)
        self.wait(lambda: self.watch.base()[0] == "a button", 3.0, "diagnostics say so")
        mark = len(self.line.from_computer)
        os.kill(pid_of("/ugv1/base_driver"), signal.SIGKILL)
        self.wait(lambda: 0 in self.said_since(mark), 20.0, "the new driver has the base held, too")
        self.stays_standing(3.0)
        self.assertNotIn(999, self.said_since(mark))
        self.reset()
        self.drive()


if __name__ == "__main__":
    rospy.init_node("base_driver_test")
    rostest.rosrun("mocha_ugv", "base_driver", BaseDriverTest, sys.argv)
