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


def served_by(publisher):
    """Which nodes it sends each of its topics to."""
    served = {}
    for _, other, direction, _, topic, up, *_ in proxy_of(publisher).getBusInfo(rospy.get_name())[2]:
        if direction == "o" and up:
            served.setdefault(topic, set()).add(other)
    return served


def is_connected(node):
    """Whether a node hears all that publish what it subscribes to, and is heard by all that subscribe to what it publishes, as far as
    the master knows of them. The publishers are asked: a subscriber counts a connection before anything is sent on it."""
    publishers, subscribers, _ = rosgraph.Master(rospy.get_name()).getSystemState()
    listeners = dict(subscribers)
    wanted = {}
    for topic, names in publishers:
        for publisher in names:
            for listener in listeners.get(topic, []):
                if node in (publisher, listener) and publisher != listener:
                    wanted.setdefault(publisher, set()).add((topic, listener))
    try:
        return all(listener in served.get(topic, ()) for publisher, pairs in wanted.items()
                   for served in [served_by(publisher)] for topic, listener in pairs)
    except (OSError, rosnode.ROSNodeIOException):
        return False  # one of them is just being started again
