"""Simulated time for tests that play the simulator: it goes on when all nodes have done with a step, however long it took them."""

import threading
import time

import rospy
from mocha_ugv.msg import StepAck
from rosgraph_msgs.msg import Clock

STEP_NS = 20_000_000
PATIENCE_S = 30.0  # wall time for a step, and for nodes to come
ROUNDS = 5  # from the test through a broadcaster and its team-mate's to whatever listens to that, and one to spare


class Acks:
    """What the nodes say of the steps that they have done with."""

    def __init__(self):
        self.changed = threading.Condition()
        self.stamps_ns = {}  # (robot, node) -> the newest
        self.counts = {}
        rospy.Subscriber("/fleet_simulator/acks", StepAck, self._on_ack, queue_size=1000, tcp_nodelay=True)

    def _on_ack(self, ack):
        with self.changed:
            node = (ack.robot, ack.node)
            self.stamps_ns[node] = ack.stamp.to_nsec()
            self.counts[node] = self.counts.get(node, 0) + 1
            self.changed.notify_all()

    def show(self, clock, stamp_ns, nodes, patience_s):
        """Publishes the stamp; False where one of the nodes did not acknowledge it in time, also a second time where it is shown again."""
        with self.changed:
            before = dict(self.counts)
            clock.publish(Clock(rospy.Time(nsecs=stamp_ns)))
            return self.changed.wait_for(
                lambda: all(self.stamps_ns.get(node, -1) >= stamp_ns and self.counts[node] > before.get(node, 0) for node in nodes), patience_s)

    def settle(self, clock, stamp_ns, nodes):
        """Until what was published has been taken by all nodes, and what they then published, too; simulated time stands. A node takes
        what has arrived before it answers: so each round carries it one node further."""
        deadline = time.monotonic() + PATIENCE_S
        rounds = 0
        while rounds < ROUNDS:
            if time.monotonic() > deadline:
                raise AssertionError("no answer from all of %s" % sorted(nodes))
            rounds += self.show(clock, stamp_ns, nodes, 1.0)


class LockstepClock:
    """`nodes`: pairs of a robot and the name of a node, which acknowledge every step."""

    def __init__(self, nodes, start_ns=100_000_000_000):
        self.nodes = set(nodes)
        self.now_ns = start_ns
        self._acks = Acks()
        self.after_step = []  # called when all nodes have done with a step
        self._clock = rospy.Publisher("/clock", Clock, queue_size=10, tcp_nodelay=True)

    @property
    def now_s(self):
        return 1e-9 * self.now_ns

    def stamp(self):
        return rospy.Time(nsecs=self.now_ns)

    def start(self):
        """Until all nodes answer."""
        deadline = time.monotonic() + PATIENCE_S
        while not self._acks.show(self._clock, self.now_ns, self.nodes, 0.2):
            if time.monotonic() > deadline:
                raise AssertionError("never there: %s" % sorted(self.nodes - set(self._acks.stamps_ns)))

    def step(self):
        self.now_ns += STEP_NS
        deadline = time.monotonic() + PATIENCE_S
        while not self._acks.show(self._clock, self.now_ns, self.nodes, 1.0):  # one that is being started anew may miss it
            if time.monotonic() > deadline:
                raise AssertionError("at %.2f s: one of %s did not answer: %s" % (self.now_s, sorted(self.nodes), self._acks.stamps_ns))
        for call in self.after_step:
            call()

    def settle(self):
        self._acks.settle(self._clock, self.now_ns, self.nodes)

    def run(self, seconds):
        for _ in range(round(1e9 * seconds / STEP_NS)):
            self.step()

    def run_until(self, condition, limit_s, what):
        """Lets simulated time go on until the condition holds; `what` is words, or makes them then."""
        end_s = self.now_s + limit_s
        while not condition():
            if self.now_s > end_s:
                raise AssertionError("not within %.1f s: %s" % (limit_s, what() if callable(what) else what))
            self.step()
