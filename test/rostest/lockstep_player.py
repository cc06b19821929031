"""Plays a bag as the simulator would: the clock goes on when all nodes have done with a step, however long it took them."""

import importlib
import threading
import time

import rosbag
import rospy
from mocha_ugv.msg import StepAck
from rosgraph_msgs.msg import Clock

STEP_NS = 20_000_000
DELIVERY_S = 0.002  # for what was published to reach everybody before the clock does
CONNECTING_S = 1.5  # for those who connect besides the first
PATIENCE_S = 20.0


class LockstepPlayer:
    """`nodes` of `robot` acknowledge every step."""

    def __init__(self, path, topics, robot, nodes):
        self._bag = rosbag.Bag(path)
        self._topics = topics
        self._awaited = {(robot, node) for node in nodes}
        self._changed = threading.Condition()
        self._handled = {}
        self._publishers = {}
        kinds = self._bag.get_type_and_topic_info(topics).topics
        for topic, kind in kinds.items():
            package, name = kind.msg_type.split("/")
            message = getattr(importlib.import_module(package + ".msg"), name)
            self._publishers[topic] = rospy.Publisher(topic, message, queue_size=1000, latch=topic == "/tf_static")
        self._clock = rospy.Publisher("/clock", Clock, queue_size=10)
        rospy.Subscriber("/fleet_simulator/acks", StepAck, self._on_ack, queue_size=1000)

    def _on_ack(self, ack):
        with self._changed:
            self._handled[(ack.robot, ack.node)] = ack.stamp.to_nsec()
            self._changed.notify_all()

    def _show(self, stamp_ns, patience_s):
        """False where somebody did not acknowledge in time."""
        self._clock.publish(Clock(rospy.Time(nsecs=stamp_ns)))
        done = lambda: all(self._handled.get(node, -1) >= stamp_ns for node in self._awaited)
        with self._changed:
            return self._changed.wait_for(done, patience_s)

    def _await_nodes(self, stamp_ns):
        """Until all nodes acknowledge, and whoever wants what is played has connected."""
        until = time.monotonic() + 2.0 * PATIENCE_S
        while not self._show(stamp_ns, 0.2):
            if time.monotonic() > until:
                raise TimeoutError(f"never there: {self._awaited - set(self._handled)}")
        while not all(publisher.get_num_connections() for publisher in self._publishers.values()):
            time.sleep(0.05)
            if time.monotonic() > until:
                raise TimeoutError("nobody listens to " + ", ".join(
                    topic for topic, publisher in self._publishers.items() if not publisher.get_num_connections()))
        time.sleep(CONNECTING_S)

    def play(self):
        """To the end of the bag. Raises TimeoutError where a node does not follow."""
        messages = list(self._bag.read_messages(topics=self._topics))
        stamp_ns = messages[0].timestamp.to_nsec() // STEP_NS * STEP_NS
        self._await_nodes(stamp_ns)
        at = 0
        while at < len(messages):
            stamp_ns += STEP_NS
            while at < len(messages) and messages[at].timestamp.to_nsec() <= stamp_ns:
                self._publishers[messages[at].topic].publish(messages[at].message)
                at += 1
            time.sleep(DELIVERY_S)
            if not self._show(stamp_ns, PATIENCE_S):
                raise TimeoutError(f"at {1e-9 * stamp_ns:.2f} s: {self._handled}")
