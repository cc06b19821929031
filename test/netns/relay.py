"""Carries Ethernet frames between pairs of interfaces, late and not all of them: the links between robots and their network.

Each link joins the interface towards a robot with that towards the bridge. What is for the robot is delayed and lost as set, independently
of other robots; what it sends passes at once, so that a frame between two robots pays once. A link that is cut carries nothing. Frames
overtake each other where delays vary. Time is the machine's, or with --told-time what is said to be the time, so that delays last
as long in a simulation whatever its speed.

Orders come as JSON, one a line, to standard input: {"link": NAME, "delay_s": [least, most], "loss": share, "cut": yes} changes what it
names, {"time_s": t} tells the time. Each is answered, when it is done, by a line with the robots' frames so far:
{NAME: {"sent": n, "delivered": n, "lost": n}}.
Ends with its input. Needs CAP_NET_RAW."""
import argparse
import heapq
import json
import os
import random
import selectors
import socket
import subprocess
import sys
import threading
import time

_ALL_PROTOCOLS = 0x0003
_LARGEST_FRAME = 65536
_BUFFER_BYTES = 8 << 20


class Link:
    """One robot's link. Delay, loss and cut may be changed at any time; a cut also ends what is on its way."""

    def __init__(self, name, robot_interface, network_interface, seed):
        self.name = name
        self.robot = _open(robot_interface)
        self.network = _open(network_interface)
        self.delay_s = (0.0, 0.0)
        self.loss = 0.0
        self.cut = False
        self.counts = {"sent": 0, "delivered": 0, "lost": 0}
        self._random = random.Random(f"{seed} {name}")

    def change(self, delay_s=None, loss=None, cut=None):
        """Throws ValueError for what cannot be."""
        if delay_s is not None:
            least, most = delay_s
            if not 0.0 <= least <= most:
                raise ValueError(f"{self.name}: delay_s: [{least}, {most}] is no range of delays")
            self.delay_s = (least, most)
        if loss is not None:
            if not 0.0 <= loss <= 1.0:
                raise ValueError(f"{self.name}: loss: {loss} is not between 0 and 1")
            self.loss = loss
        if cut is not None:
            self.cut = bool(cut)

    def delay(self):
        """Of the next frame to the robot [s]; None: it is lost."""
        if self.cut or self._random.random() < self.loss:
            return None
        return self._random.uniform(*self.delay_s)

    def send(self, frame):
        """What comes from the robot."""
        self._pass(frame, self.network, "sent")

    def deliver(self, frame):
        """What is for the robot, when its delay is over."""
        self._pass(frame, self.robot, "delivered")

    def _pass(self, frame, to, what):
        try:
            if not self.cut:
                to.send(frame)
            self.counts["lost" if self.cut else what] += 1
        except OSError:  # larger than the interface takes, or the other end is going down
            self.counts["lost"] += 1


class Relay:
    """All links, and the frames on their way."""

    def __init__(self, links, clock):
        """`clock()`: the time [s]."""
        self._links = {link.name: link for link in links}
        self._clock = clock
        self._due = []  # (when, order of arrival, link, frame)
        self._arrivals = 0

    def change(self, link, **settings):
        self._links[link].change(**settings)

    def take(self):
        """Reads what has arrived."""
        for link in self._links.values():
            for frame in _arrived(link.robot):
                link.send(frame)
            for frame in _arrived(link.network):
                self._accept(link, frame)

    def _accept(self, link, frame):
        delay_s = link.delay()
        if delay_s is None:
            link.counts["lost"] += 1
            return
        self._arrivals += 1
        heapq.heappush(self._due, (self._clock() + delay_s, self._arrivals, link, frame))

    def release(self):
        """Passes on what is due. Returns how long nothing else will be [s]; None: for ever."""
        now = self._clock()
        while self._due and self._due[0][0] <= now:
            _, _, link, frame = heapq.heappop(self._due)
            link.deliver(frame)
        return self._due[0][0] - now if self._due else None

    def counts(self):
        return {link.name: link.counts for link in self._links.values()}

    def sockets(self):
        return [end for link in self._links.values() for end in (link.robot, link.network)]


def _open(interface):
    end = socket.socket(socket.AF_PACKET, socket.SOCK_RAW, socket.htons(_ALL_PROTOCOLS))
    end.bind((interface, _ALL_PROTOCOLS))
    end.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, _BUFFER_BYTES)
    end.setblocking(False)
    return end


def _arrived(end):
    """What has come in since the last look; a raw socket also shows what goes out, which is not for us."""
    while True:
        try:
            frame, (_, _, kind, *_) = end.recvfrom(_LARGEST_FRAME)
        except BlockingIOError:
            return
        if kind != socket.PACKET_OUTGOING:
            yield frame


class ToldTime:
    """The time as it was told last."""

    def __init__(self):
        self.now_s = 0.0

    def __call__(self):
        return self.now_s


def serve(relay, told_time):
    """Until the end of standard input. `told_time`: None where the machine's clock rules."""
    selector = selectors.DefaultSelector()
    for end in relay.sockets():
        selector.register(end, selectors.EVENT_READ)
    orders = sys.stdin.buffer.raw
    selector.register(orders, selectors.EVENT_READ, "orders")
    text = b""
    wait_s = None
    while True:
        ready = selector.select(None if told_time else wait_s)
        relay.take()
        wait_s = relay.release()
        if all(key.data is None for key, _ in ready):
            continue
        received = orders.read(65536)
        if not received:
            return
        *lines, text = (text + received).split(b"\n")
        for line in lines:
            order = json.loads(line)
            relay.take()  # what was sent before the order is not subject to it
            if "time_s" in order:
                told_time.now_s = order["time_s"]
            else:
                relay.change(**order)
            wait_s = relay.release()
            print(json.dumps(relay.counts()), flush=True)


class RelayProcess:
    """A relay that runs for netns.Hosts, and gives its orders."""

    def __init__(self, hosts, seed=1, told_time=False):
        command = [sys.executable, os.path.abspath(__file__), "--seed", str(seed)] + ["--told-time"] * told_time
        command += [":".join((robot, *interfaces)) for robot, interfaces in hosts.relay_links().items()]
        self._process = hosts.popen("fleet", command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
        self._lock = threading.Lock()

    def change(self, link, **settings):
        """As Link.change(); of the robot's link."""
        return self._order({"link": link, **settings})

    def tell(self, time_s):
        """The time; what is due has been passed on when this returns."""
        return self._order({"time_s": time_s})

    def _order(self, order):
        with self._lock:
            self._process.stdin.write(json.dumps(order) + "\n")
            self._process.stdin.flush()
            answer = self._process.stdout.readline()
        if not answer:
            raise RuntimeError(f"the relay has ended at the order {order}")
        return json.loads(answer)


def main(arguments):
    parser = argparse.ArgumentParser(prog="relay", description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("links", nargs="+", metavar="NAME:ROBOT_INTERFACE:BRIDGE_INTERFACE")
    parser.add_argument("--seed", type=int, default=1, help="of delays and losses (default 1)")
    parser.add_argument("--told-time", action="store_true", help="time passes only as told by orders")
    options = parser.parse_args(arguments)
    told_time = ToldTime() if options.told_time else None
    links = [Link(*link.split(":"), options.seed) for link in options.links]
    serve(Relay(links, told_time or time.monotonic), told_time)


if __name__ == "__main__":
    main(sys.argv[1:])
