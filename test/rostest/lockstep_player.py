"""Plays a bag as the simulator would: the clock goes on when all nodes have done with a step, however long it took them."""

import importlib

import rosbag
import rosgraph
import rospy

from lockstep_clock import STEP_NS, LockstepClock
from waiting import wait_until


class LockstepPlayer:
    """`nodes` of `robot` acknowledge every step."""

    def __init__(self, path, topics, robot, nodes):
        self.messages = list(rosbag.Bag(path).read_messages(topics=topics))
        self._publishers = {}
        kinds = rosbag.Bag(path).get_type_and_topic_info(topics).topics
        for topic, kind in kinds.items():
            package, name = kind.msg_type.split("/")
            message = getattr(importlib.import_module(package + ".msg"), name)
            self._publishers[topic] = rospy.Publisher(topic, message, queue_size=1000, latch=topic == "/tf_static")
        self._clock = LockstepClock({(robot, node) for node in nodes}, self.messages[0].timestamp.to_nsec() // STEP_NS * STEP_NS)

    def _all_connected(self):
        """Nodes that answer have said at the master what they listen to."""
        listeners = dict(rosgraph.Master(rospy.get_name()).getSystemState()[1])
        return all(publisher.get_num_connections() >= max(1, len(listeners.get(topic, []))) for topic, publisher in self._publishers.items())

    def play(self):
        """To the end of the bag. Raises AssertionError where a node does not follow."""
        self._clock.start()
        wait_until(self._all_connected, "all listeners are connected")
        at = 0
        while at < len(self.messages):
            end_ns = self._clock.now_ns + STEP_NS
            while at < len(self.messages) and self.messages[at].timestamp.to_nsec() <= end_ns:
                self._publishers[self.messages[at].topic].publish(self.messages[at].message)
                at += 1
            self._clock.step()
        self._clock.settle()
