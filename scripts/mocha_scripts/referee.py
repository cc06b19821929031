"""Watches the simulator's ground truth, the goals' outcomes, commands and plans, and keeps the result of a drive."""
import math
import threading

import rospy
from actionlib_msgs.msg import GoalStatus
from geometry_msgs.msg import Twist
from mocha_ugv.msg import Contact, GroundTruth, Trajectory
from move_base_msgs.msg import MoveBaseActionResult


BLAME = {Contact.OWN: "own", Contact.STANDING: "standing", Contact.UNSEEN: "unseen"}


class Reversals:
    """How often a yaw rate changes its sign: small ones in between do not count."""
    DEAD_BAND_RADPS = 0.1

    def __init__(self):
        self.count = 0
        self._turns_left = None  # the last that counted

    def add(self, yaw_rate):
        if abs(yaw_rate) <= self.DEAD_BAND_RADPS:
            return
        turns_left = yaw_rate > 0.0
        self.count += self._turns_left is not None and turns_left != self._turns_left
        self._turns_left = turns_left


class RobotResult:
    def __init__(self, name):
        self.name = name
        self.has_goal = False
        self.reached = False
        self.gave_up = None  # why, in the robot's words
        self.contacts = 0
        self.own_contacts = 0
        self.time_s = None
        self.reached_at_s = None  # [ROS time]
        self.path_m = 0.0
        self.min_clearance_m = math.inf
        self.max_speed_mps = 0.0
        self.reversals = Reversals()
        self.plans = 0  # that it was given to drive

    def on_command(self, command):
        if not self.reached:
            self.reversals.add(command.angular.z)

    def on_plan(self, plan):
        """A plan without phases says that there is nothing to drive to."""
        if not self.reached and plan.phases:
            self.plans += 1

    def update(self, truth):
        self.has_goal = truth.has_goal
        self.contacts = truth.contacts
        self.own_contacts = truth.own_contacts
        self.min_clearance_m = min(self.min_clearance_m, truth.clearance)
        self.max_speed_mps = max(self.max_speed_mps, abs(truth.speed))
        if self.reached:
            return
        self.path_m = truth.path_length
        self.reached = truth.reached
        if truth.reached:
            self.reached_at_s = truth.reached_at.to_sec()
            self.time_s = (truth.reached_at - truth.moved_at).to_sec() if truth.moved else 0.0

    def as_dict(self, started_s):
        arrival_s = None if self.reached_at_s is None else self.reached_at_s - started_s
        rounded = lambda value: None if value is None or not math.isfinite(value) else round(value, 4)
        return {"name": self.name, "reached": self.reached, "gave_up": self.gave_up, "contacts": self.contacts,
                "own_contacts": self.own_contacts, "time_s": rounded(self.time_s), "arrival_s": rounded(arrival_s),
                "path_m": rounded(self.path_m), "min_clearance_m": rounded(self.min_clearance_m),
                "max_speed_mps": rounded(self.max_speed_mps), "reversals": self.reversals.count, "replans": max(0, self.plans - 1)}


class Referee:
    """Subscribes to the simulator; read it under its lock or after the drive."""

    def __init__(self):
        self.robots = {}
        self.min_separation_m = math.inf
        self.started_s = None
        self.now_s = 0.0
        self.contacts = []
        self._lock = threading.Lock()
        rospy.Subscriber("/fleet_simulator/contacts", Contact, self._on_contact)
        rospy.Subscriber("/fleet_simulator/ground_truth", GroundTruth, self._on_truth)

    def _on_contact(self, contact):
        with self._lock:
            self.contacts.append({"time_s": round(contact.header.stamp.to_sec() - (self.started_s or 0.0), 2), "robot": contact.robot,
                                  "other": contact.other, "x": round(contact.place.x, 2), "y": round(contact.place.y, 2),
                                  "depth_m": round(contact.depth, 3), "blame": BLAME[contact.blame],
                                  "robot_mps": round(contact.robot_speed, 2), "approach_mps": round(contact.approach_speed, 2)})

    def _on_truth(self, message):
        with self._lock:
            self.now_s = message.header.stamp.to_sec()
            if self.started_s is None:
                self.started_s = self.now_s
            self.min_separation_m = min(self.min_separation_m, message.min_separation)
            for truth in message.robots:
                if truth.name not in self.robots:
                    self._watch(truth.name)
                self.robots[truth.name].update(truth)

    def _watch(self, name):
        robot = self.robots[name] = RobotResult(name)
        rospy.Subscriber(f"/{name}/move_base/result", MoveBaseActionResult, self._on_outcome, name)
        rospy.Subscriber(f"/{name}/cmd_vel", Twist, robot.on_command)
        rospy.Subscriber(f"/{name}/global_trajectory", Trajectory, robot.on_plan)

    def _on_outcome(self, message, name):
        with self._lock:
            if message.status.status in (GoalStatus.ABORTED, GoalStatus.REJECTED):
                self.robots[name].gave_up = message.status.text

    def elapsed_s(self):
        return 0.0 if self.started_s is None else self.now_s - self.started_s

    def finished(self):
        with self._lock:
            return bool(self.robots) and all(
                robot.reached or robot.gave_up is not None or not robot.has_goal for robot in self.robots.values())

    def touched(self):
        with self._lock:
            return any(robot.contacts for robot in self.robots.values())

    def results(self):
        with self._lock:
            separation = self.min_separation_m
            return {"robots": [robot.as_dict(self.started_s) for _, robot in sorted(self.robots.items())],
                    "contacts": list(self.contacts),
                    "min_separation_m": round(separation, 4) if math.isfinite(separation) else None}


def contact_text(contact):
    return "after {time_s:.2f} s {robot} touched {other} at ({x:.2f}, {y:.2f}), {depth_m:.3f} m deep, together at {approach_mps:.2f} m/s ({blame})".format(
        **contact)


def succeeded(results):
    """All robots reached their goals without contact."""
    return bool(results["robots"]) and all(robot["reached"] and robot["contacts"] == 0 for robot in results["robots"])


def table(results):
    """The results as lines for people."""
    show = lambda value, digits: "-" if value is None else f"{value:.{digits}f}"
    lines = [f"{'robot':<10}{'reached':>8}{'contacts':>10}{'time [s]':>10}{'path [m]':>10}{'clearance [m]':>15}"
             f"{'top speed [m/s]':>17}{'reversals':>11}{'replans':>9}"]
    for robot in results["robots"]:
        lines.append(f"{robot['name']:<10}{'yes' if robot['reached'] else 'no':>8}{robot['contacts']:>10}"
                     f"{show(robot['time_s'], 2):>10}{show(robot['path_m'], 2):>10}"
                     f"{show(robot['min_clearance_m'], 3):>15}{show(robot['max_speed_mps'], 2):>17}"
                     f"{robot['reversals']:>11}{robot['replans']:>9}")
    lines += [f"{robot['name']} gave its goal up: {robot['gave_up']}" for robot in results["robots"]
              if robot["gave_up"] is not None and not robot["reached"]]
    if results["min_separation_m"] is not None:
        lines.append(f"smallest separation of two robots (centre to centre): {results['min_separation_m']:.3f} m")
    return "\n".join(lines)
