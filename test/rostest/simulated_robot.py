"""One robot with its whole stack in the simulator, whose clock goes on only as far as the test lets it."""

import math
import os
import re
import signal
import threading

import actionlib
import rospy
from actionlib_msgs.msg import GoalStatus
from diagnostic_msgs.msg import DiagnosticArray
from geometry_msgs.msg import PoseStamped
from mocha_ugv.msg import GroundTruth, PlannerStatus, StepAck
from move_base_msgs.msg import MoveBaseAction, MoveBaseGoal
from rosgraph_msgs.msg import Clock, Log

from lockstep_clock import Acks
from waiting import wait_until

ROLLS_OUT_S = 0.5  # the wheels lag, and so does the word of where it is
STANDING_MPS = 0.03
STANDING_RADPS = 0.05
CHUNK_S = 0.1  # of simulated time between two looks at a condition
STUCK_WALL_S = 60.0
NODES = ("perception", "global_planner", "local_replanner", "trajectory_broadcaster", "trajectory_tracker")


def wrap(angle):
    return math.atan2(math.sin(angle), math.cos(angle))


def pose(x, y, yaw=None, frame="map"):
    """A pose; without yaw, the quaternion of zeros means any heading."""
    stamped = PoseStamped()
    stamped.header.frame_id = frame
    stamped.pose.position.x, stamped.pose.position.y = x, y
    if yaw is not None:
        stamped.pose.orientation.z, stamped.pose.orientation.w = math.sin(0.5 * yaw), math.cos(0.5 * yaw)
    return stamped


class SimulatedRobot:
    """Plays the lockstep node `judge` of a robot, so that simulated time stands while the test thinks."""

    def __init__(self, name="ugv1"):
        self.name = name
        self.now = 0.0  # [s] simulated
        self.truth = None
        self.heard = []  # (time, words) of diagnostics and log
        self.values = {}  # of the newest diagnostics: name -> key -> value
        self.speeds = []  # (time, speed, yaw rate), ground truth
        self.reasons = []  # (time, reason), of the planner's status
        self._changed = threading.Condition()
        self._stamp = None
        self._until = 0.0
        self._acks = rospy.Publisher("/fleet_simulator/acks", StepAck, queue_size=100, tcp_nodelay=True)
        self._answers = Acks()
        self._clock = rospy.Publisher("/clock", Clock, queue_size=10, tcp_nodelay=True)
        self.client = actionlib.SimpleActionClient("/%s/move_base" % name, MoveBaseAction)
        self.simple_goals = rospy.Publisher("/%s/move_base_simple/goal" % name, PoseStamped, queue_size=1)
        rospy.Subscriber("/fleet_simulator/ground_truth", GroundTruth, self._on_truth, tcp_nodelay=True)
        rospy.Subscriber("/%s/planner_status" % name, PlannerStatus, self._on_status)
        rospy.Subscriber("/diagnostics", DiagnosticArray, self._on_diagnostics)
        rospy.Subscriber("/rosout", Log, self._on_log)
        rospy.Subscriber("/clock", Clock, self._on_clock, tcp_nodelay=True)

    # --- what comes in ---

    def _on_truth(self, message):
        for robot in message.robots:
            if robot.name == self.name:
                self.truth = robot
                self.speeds.append((message.header.stamp.to_sec(), robot.speed, robot.yaw_rate))

    def _on_status(self, status):
        self.reasons.append((self.now, status.reason))

    def _on_diagnostics(self, message):
        for status in message.status:
            self.heard.append((self.now, status.name + ": " + status.message))
            self.values[status.name] = {value.key: value.value for value in status.values}

    def _on_log(self, message):
        self.heard.append((self.now, message.name + ": " + message.msg))

    def _on_clock(self, message):
        with self._changed:
            self._stamp = message.clock
            self.now = message.clock.to_sec()
            self._answer()
            self._changed.notify_all()

    def _answer(self):
        if self._stamp is not None and self.now <= self._until:
            self._acks.publish(StepAck(robot=self.name, node="judge", stamp=self._stamp))

    # --- time ---

    def run(self, seconds):
        """Lets simulated time go on."""
        with self._changed:
            self._until = self.now + seconds - 1e-6
            self._answer()
            if not self._changed.wait_for(lambda: self.now > self._until, STUCK_WALL_S):
                raise AssertionError("simulated time stands at %.2f s" % self.now)

    def run_until(self, condition, limit_s, what):
        """Lets simulated time go on until the condition holds."""
        end = self.now + limit_s
        while not condition():
            if self.now > end:
                raise AssertionError("not within %.1f s: %s; %s" % (limit_s, what, self.report()))
            self.run(CHUNK_S)

    def start(self):
        """Until the whole stack is up and has promised to stand."""
        wait_until(lambda: self._stamp is not None and self._acks.get_num_connections() > 0, "the simulator is there", STUCK_WALL_S)
        self.run(3.0)

    def pairs(self, nodes=NODES):
        return {(self.name, node) for node in nodes}

    def settle(self, nodes=None):
        """Until what was published has been taken by these nodes, its own unless others are given; simulated time stands."""
        self._answers.settle(self._clock, self._stamp.to_nsec(), nodes or self.pairs())

    # --- what the robot does ---

    def place(self):
        return self.truth.pose.x, self.truth.pose.y

    def distance_to(self, x, y):
        return math.dist(self.place(), (x, y))

    def standing(self):
        return abs(self.truth.speed) < STANDING_MPS and abs(self.truth.yaw_rate) < STANDING_RADPS

    def stood_at(self, moment):
        """Whether it stood at that moment, and since."""
        later = [entry for entry in self.speeds if entry[0] >= moment]
        return bool(later) and all(abs(v) < STANDING_MPS and abs(w) < STANDING_RADPS for _, v, w in later)

    def said(self, pattern, since=0.0):
        """Whether a node said so, in diagnostics or in the log."""
        return any(at >= since and re.search(pattern, words) for at, words in list(self.heard))

    def last_reason(self):
        """Why the planner's newest planning, or refusal to plan, ended as it did."""
        return self.reasons[-1][1]

    def reported(self, reason, since):
        """Whether the planner has said that its planning ended so."""
        return any(at >= since and said == reason for at, said in list(self.reasons))

    def report(self):
        state = "no truth yet" if self.truth is None else "at (%.2f, %.2f, %.2f), %.2f m/s, %d contacts" % (
            *self.place(), self.truth.pose.theta, self.truth.speed, self.truth.contacts)
        newest = dict(words.split(": ", 1) for _, words in self.heard[-200:] if ": " in words)
        return "at %.2f s %s; last words: %s" % (self.now, state, newest)

    # --- goals ---

    def send(self, x, y, yaw=None):
        self.client.wait_for_server()
        self.client.send_goal(MoveBaseGoal(target_pose=pose(x, y, yaw)))

    def done(self):
        return self.client.get_state() not in (GoalStatus.PENDING, GoalStatus.ACTIVE)

    def outcome(self):
        return GoalStatus.to_string(self.client.get_state()), self.client.get_goal_status_text()

    def arrive(self, x, y, yaw=None, limit_s=60.0):
        """Drives there."""
        self.send(x, y, yaw)
        self.run_until(self.done, limit_s, "the goal (%.1f, %.1f) is reached" % (x, y))
        if self.outcome()[0] != "SUCCEEDED" or self.distance_to(x, y) > 0.2:
            raise AssertionError("%s: %s; %s" % (*self.outcome(), self.report()))
        self.run_until(self.standing, ROLLS_OUT_S, "it stands at the goal")

    # --- its processes ---

    def process(self, node):
        """The id of a node's process, or None."""
        mine = ("ROS_MASTER_URI=" + os.environ["ROS_MASTER_URI"]).encode()
        for entry in os.listdir("/proc"):
            if not entry.isdigit():
                continue
            try:
                with open("/proc/%s/cmdline" % entry, "rb") as file:
                    words = file.read().split(b"\0")
                with open("/proc/%s/environ" % entry, "rb") as file:
                    environment = file.read().split(b"\0")
            except OSError:
                continue
            if words[0].endswith(b"/" + node.encode()) and mine in environment and (
                    ("ROS_NAMESPACE=/" + self.name).encode() in environment):
                return int(entry)
        return None

    def dead_for(self, node, seconds, meanwhile=None):
        """Kills a node and, for that much simulated time, whatever is started in its place; `meanwhile` lets the time go on."""
        over = threading.Event()
        killed = threading.Event()

        def reap():
            while not over.is_set():
                process = self.process(node)
                if process is not None:
                    os.kill(process, signal.SIGKILL)
                    killed.set()
                over.wait(0.05)

        reaper = threading.Thread(target=reap)
        reaper.start()
        try:
            if not killed.wait(5.0):
                raise AssertionError("no process of " + node)
            (meanwhile or self.run)(seconds)
        finally:
            over.set()
            reaper.join()

    def wait_for_node(self, node, run=None):
        """Until the node takes part again. Simulated time goes on a step at a time, or the simulator would give up this test, too; `run`
        lets it go on where another robot keeps the time."""

        def back():
            if self._answers.show(self._clock, self._stamp.to_nsec(), self.pairs([node]), 0.2):
                return True
            (run or self.run)(0.02)
            return False

        wait_until(back, lambda: node + " has come back; " + self.report(), STUCK_WALL_S)
