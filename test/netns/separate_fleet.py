"""A simulated fleet of which every robot is a host of its own: its own roscore and stack, promises by LCM over a network that loses and
delays. Simulated time goes on only as far as the test lets it, and the network keeps that time."""
import contextlib
import math
import os
import shutil
import subprocess
import sys
import threading

import rosgraph
import rospy
from diagnostic_msgs.msg import DiagnosticArray
from geometry_msgs.msg import PoseStamped
from mocha_ugv.msg import FleetTrajectories, GroundTruth, PlannerStatus, StepAck
from rosgraph_msgs.msg import Clock

from hosts_needed import netns, wait_until
from relay import RelayProcess

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))

LCM_URL = "udpm://239.255.76.67:7667?ttl=1"
DELTA_DC_S = 0.25  # longer than any message takes in these tests
ACK_TIMEOUT_S = 3.0  # [wall] after which the simulator goes on without a robot
STACK_NODES = ("perception", "global_planner", "local_replanner", "trajectory_broadcaster", "trajectory_tracker")
CHUNK_S = 0.1  # of simulated time between two looks at a condition
STUCK_WALL_S = 60.0
STANDING_MPS, STANDING_RADPS = 0.03, 0.05
ARRIVED_M = 0.2


def new_key(path):
    """Makes a fleet key there; its absolute path."""
    os.makedirs(os.path.dirname(path), exist_ok=True)
    with contextlib.suppress(FileNotFoundError):
        os.remove(path)
    subprocess.run([os.path.join(ROOT, "scripts/fleet_key"), path], check=True, stdout=subprocess.DEVNULL)
    return os.path.abspath(path)


class Robot:
    """What is known of one robot: its true state, and what it reports."""

    def __init__(self, name):
        self.name = name
        self.truth = None
        self.peers = {}  # name -> newest binding Trajectory that it knows
        self.diagnosis = {}  # of its broadcaster
        self.complaints = {}  # subject -> summary, of its broadcaster
        self.planner = ""
        self._goal = None  # sent, but its planner has said nothing since
        self._acked = dict.fromkeys(STACK_NODES, 0.0)  # newest step that each has done
        self._goals = rospy.Publisher(f"/{name}/move_base_simple/goal", PoseStamped, queue_size=10)
        rospy.Subscriber(f"/{name}/fleet/trajectories", FleetTrajectories, self._on_fleet)
        rospy.Subscriber(f"/{name}/planner_status", PlannerStatus, self._on_planner)

    def _on_fleet(self, message):
        self.peers = {trajectory.agent: trajectory for trajectory in message.trajectories}

    def _on_planner(self, status):
        self.planner = status.message
        self._goal = None

    def on_ack(self, ack):
        if ack.node in self._acked:
            self._acked[ack.node] = ack.stamp.to_sec()

    @property
    def acked_s(self):
        """The newest step that its whole stack has done."""
        return min(self._acked.values())

    def on_diagnostics(self, status):
        self.diagnosis.update({value.key: value.value for value in status.values})
        self.complaints[status.name] = status.message

    def send(self, x, y):
        """A goal with any heading."""
        goal = PoseStamped()
        goal.header.frame_id = "map"
        goal.pose.position.x, goal.pose.position.y = x, y
        self._goal = goal
        self._goals.publish(goal)

    def send_again(self):
        """The goal, if it was lost: it passes the adapter, and a subscriber beyond that may have come late."""
        if self._goal is not None:
            self._goals.publish(self._goal)

    def place(self):
        return self.truth.pose.x, self.truth.pose.y

    def distance_to(self, x, y):
        return math.dist(self.place(), (x, y))

    def stands(self):
        return abs(self.truth.speed) < STANDING_MPS and abs(self.truth.yaw_rate) < STANDING_RADPS

    def stands_at(self, x, y):
        return self.stands() and self.distance_to(x, y) < ARRIVED_M

    def complaint(self):
        return "; ".join(self.complaints.values())

    def report(self):
        place = "nowhere yet" if self.truth is None else "at (%.2f, %.2f), %.2f m/s, %d contacts" % (
            *self.place(), self.truth.speed, self.truth.contacts)
        return f"{self.name} {place}; planner: {self.planner!r}; broadcaster: {self.complaint()!r} {self.diagnosis}"


class SeparateFleet:
    """From `with` to its end. The process that makes it stands on the simulator's host from then on; one fleet a process.

    `keys`: robot -> path of its fleet key. `network`: delay_s and loss of every robot's link, as relay has them. Logs go to
    the directory `out`, which is emptied first."""

    def __init__(self, world, names, out, keys=None, network=None):
        self.now = 0.0  # [s] simulated
        self.min_separation_m = math.inf
        self._world, self._names, self._out, self._keys = world, names, os.path.abspath(out), keys or {}
        self._network = network or {}
        self._hosts = netns.Hosts(names)
        self._adapters = {}
        self._changed = threading.Condition()
        self._stamp = None
        self._until = 0.0

    def __enter__(self):
        shutil.rmtree(self._out, ignore_errors=True)
        self._hosts.__enter__()
        try:
            self._start()
        except BaseException:
            self._hosts.close()
            raise
        return self

    def __exit__(self, *failure):
        if failure[0] is not None:
            print("at %.2f s: %s\nlogs: %s" % (self.now, "\n".join(robot.report() for robot in self.robots), self._out))
        rospy.signal_shutdown("the test is over")
        self._hosts.close()

    def _start(self):
        self.relay = RelayProcess(self._hosts, told_time=True)
        for name in self._names:
            self.relay.change(name, **self._network)
        self._popen(netns.SIMULATOR, ["roslaunch", os.path.join(ROOT, "test/rostest/stack.launch"), "world:=" + self._world,
                                      f"ack_timeout:={ACK_TIMEOUT_S}"])
        for name in self._names:
            self.boot(name)
        self._hosts.enter(netns.SIMULATOR)
        os.environ.update(self._environment(netns.SIMULATOR))
        wait_until(rosgraph.is_master_online, "the roscore of the simulator", STUCK_WALL_S)
        for name in self._names:
            self._adapter("simulator", name, netns.SIMULATOR)
        rospy.init_node("judge", disable_signals=True, disable_rostime=True)
        self.robots = [Robot(name) for name in self._names]
        self._acks = rospy.Publisher("/fleet_simulator/acks", StepAck, queue_size=100, tcp_nodelay=True)
        rospy.Subscriber("/fleet_simulator/ground_truth", GroundTruth, self._on_truth, tcp_nodelay=True)
        rospy.Subscriber("/fleet_simulator/acks", StepAck, self._on_ack, tcp_nodelay=True)
        rospy.Subscriber("/diagnostics", DiagnosticArray, self._on_diagnostics)
        rospy.Subscriber("/clock", Clock, self._on_clock, tcp_nodelay=True)
        wait_until(lambda: self._stamp is not None and self._acks.get_num_connections() > 0, "the simulator", STUCK_WALL_S)
        self.run(3.0)
        for name in self._names:
            self.wait_for(name)

    # --- hosts ---

    def boot(self, name):
        """Starts a robot's stack, and its end of the adapter."""
        key = ["fleet_key:=" + self._keys[name]] if name in self._keys else []
        self._popen(name, ["roslaunch", os.path.join(ROOT, "test/netns/stack_alone.launch"), "robot:=" + name,
                           f"delta_dc:={DELTA_DC_S}", "lcm_url:=" + LCM_URL, *key])
        self.attach(name)

    def kill(self, name):
        """All that runs on a robot, at once."""
        self._hosts.kill(name)

    def call(self, name, service, *words):
        """What a service on a robot's host answers."""
        command = self._hosts.command(name, ["rosservice", "call", service, *words])
        return subprocess.run(command, env={**os.environ, **self._environment(name)}, check=True, capture_output=True, text=True,
                              timeout=STUCK_WALL_S).stdout

    def attach(self, name):
        """Joins a robot with the simulator."""
        self._adapters[name] = self._adapter("robot", name, name)

    def detach(self, name):
        """Time, sensors and wheels of a robot are gone; its stack runs on."""
        self._adapters[name].kill()

    def _adapter(self, end, name, host):
        return self._popen(host, [sys.executable, os.path.join(ROOT, "test/netns/adapter.py"), end, name,
                                  self._hosts.management_addresses(name)[0]], "adapter-" + name)

    def _popen(self, host, command, log=None):
        home = os.path.join(self._out, host)
        os.makedirs(home, exist_ok=True)
        with open(os.path.join(home, (log or "roslaunch") + ".log"), "a") as file:
            return self._hosts.popen(host, command, stdout=file, stderr=subprocess.STDOUT, stdin=subprocess.DEVNULL,
                                     env={**os.environ, **self._environment(host)})

    def _environment(self, host):
        home = os.path.join(self._out, host)
        return {"ROS_MASTER_URI": "http://localhost:11311", "ROS_HOSTNAME": "localhost", "ROS_HOME": home,
                "ROS_LOG_DIR": os.path.join(home, "log"), "ROSCONSOLE_STDOUT_LINE_BUFFERED": "1"}

    # --- what comes in ---

    def robot(self, name):
        return next(robot for robot in self.robots if robot.name == name)

    def _on_truth(self, message):
        self.min_separation_m = min(self.min_separation_m, message.min_separation)
        for truth in message.robots:
            self.robot(truth.name).truth = truth

    def _on_ack(self, ack):
        self.robot(ack.robot).on_ack(ack)

    def _on_diagnostics(self, message):
        for status in message.status:
            if "trajectory_broadcaster" in status.name and status.hardware_id in self._names:
                self.robot(status.hardware_id).on_diagnostics(status)

    def _on_clock(self, message):
        with self._changed:
            self._stamp = message.clock
            self.now = message.clock.to_sec()
            self.relay.tell(self.now)
            self._answer()
            self._changed.notify_all()

    def _answer(self):
        if self._stamp is not None and self.now <= self._until:
            for name in self._names:
                self._acks.publish(StepAck(robot=name, node="judge", stamp=self._stamp))

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
                raise AssertionError(f"not within {limit_s:.1f} s: {what}")
            self.run(CHUNK_S)
            if self.now > end - 0.5 * limit_s:
                for robot in self.robots:
                    robot.send_again()

    def wait_for(self, name):
        """Lets a little time go on until the robot's whole stack takes part, or does so again."""
        since = self.now

        def takes_part():
            self.run(0.02)
            return self.robot(name).acked_s > since

        wait_until(takes_part, f"{name} takes part", STUCK_WALL_S)
