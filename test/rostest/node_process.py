"""The process behind a node, and what it is connected to."""

import os
import xmlrpc.client

import rosgraph
import rosnode
import rospy

from waiting import wait_until


def proxy_of(node):
    return xmlrpc.client.ServerProxy(rosnode.get_api_uri(rosgraph.Master(rospy.get_name()), node, skip_cache=True))


def pid_of(node):
    return proxy_of(node).getPid(rospy.get_name())[2]


def is_running(pid):
    try:
        with open("/proc/%d/stat" % pid) as file:
            return file.read().rsplit(")", 1)[1].split()[0] != "Z"
    except OSError:
        return False


def end(node, signal):
    """Sends its process a signal that ends it, and waits until it has."""
    pid = pid_of(node)
    os.kill(pid, signal)
    wait_until(lambda: not is_running(pid), node + " has ended", 30.0)


def is_connected(node):
    """Whether a node is connected to all that listen to it, and to all that it listens to, as far as the master knows of them."""
    publishers, subscribers, _ = rosgraph.Master(rospy.get_name()).getSystemState()
    connected = {}
    for _, other, direction, _, topic, up, *_ in proxy_of(node).getBusInfo(rospy.get_name())[2]:
        if up:
            connected.setdefault((direction, topic), set()).add(other)
    inward = {topic: [name for name in names if name != node] for topic, names in publishers}
    outward = {topic: [name for name in names if name != node] for topic, names in subscribers}
    wanted = [(("i", topic), len(inward.get(topic, []))) for topic, names in subscribers if node in names]
    wanted += [(("o", topic), len(outward.get(topic, []))) for topic, names in publishers if node in names]
    return all(len(connected.get(way, ())) >= count for way, count in wanted)
