"""What the nodes of a ROS session have consumed so far, from the kernel and from the nodes themselves; nothing is subscribed to."""
import os
import xmlrpc.client

import rosgraph
import rosnode

TICKS_PER_S = os.sysconf("SC_CLK_TCK")
_CALLER = "/consumption"
_COUNTERS = 2 ** 32  # roscpp's run over there


class Node:
    """One process: a node, or what has no publications, like the master."""

    def __init__(self, name, pid, uri=None):
        self.name = name
        self._pid = pid
        self._proxy = xmlrpc.client.ServerProxy(uri) if uri else None

    def cpu_s(self):
        """Of all its threads [s]."""
        with open(f"/proc/{self._pid}/stat") as file:
            fields = file.read().rsplit(")", 1)[1].split()
        return (int(fields[11]) + int(fields[12])) / TICKS_PER_S

    def peak_mib(self):
        with open(f"/proc/{self._pid}/status") as file:
            return next(int(line.split()[1]) for line in file if line.startswith("VmHWM")) / 1024.0

    def share_mib(self):
        """Resident now, what several processes share divided among them."""
        with open(f"/proc/{self._pid}/smaps_rollup") as file:
            return next(int(line.split()[1]) for line in file if line.startswith("Pss:")) / 1024.0

    def sent(self):
        """topic -> {connection: (bytes, messages)}"""
        if self._proxy is None:
            return {}
        publications = self._proxy.getBusStats(_CALLER)[0]  # roscpp's answer comes without code and text
        return {topic: {number: (size, count) for number, size, _, count, *_ in connections} for topic, connections in publications}


def master():
    uri = rosgraph.get_master_uri()
    return Node("rosmaster", xmlrpc.client.ServerProxy(uri).getPid(_CALLER)[2])


def node(full_name):
    """The node of that name, with its last part as name."""
    uri = rosnode.get_api_uri(rosgraph.Master(_CALLER), full_name)
    return Node(full_name.rsplit("/", 1)[1], xmlrpc.client.ServerProxy(uri).getPid(_CALLER)[2], uri)


def traffic(before, after):
    """Messages and bytes sent between two `Node.sent()`, each counted once for every subscriber."""
    messages = size = 0
    for topic, connections in after.items():
        for number, (bytes_after, count_after) in connections.items():
            bytes_before, count_before = before.get(topic, {}).get(number, (0, 0))
            size += (bytes_after - bytes_before) % _COUNTERS
            messages += (count_after - count_before) % _COUNTERS
    return messages, size
