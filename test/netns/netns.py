"""Several hosts on one machine: a network namespace for a simulator and one for each robot, joined as a real fleet is.

The robots' `eth0` (10.76.0.1, .2 ...) meet at a bridge, which stands with the relay (relay.py) in a namespace of its own; between
a robot and the bridge nothing passes but what the relay carries. A link of its own joins the simulator (10.77.N.1) with the N-th robot
(10.77.N.2): for what simulates its sensors and wheels, and for recording.

Run as a program, it says why this machine does not let it (exit status 77), or nothing."""
import contextlib
import ctypes
import itertools
import os
import re
import shutil
import signal
import socket
import subprocess
import sys
import time

SIMULATOR = "simulator"
FLEET = "fleet"
SKIPPED = 77  # exit status of a test that cannot run here
MULTICAST = "224.0.0.0/4"
_PREFIX = "mocha"
_NAMESPACES = "/run/netns"
_CLONE_NEWNET = 0x40000000
_RUNS = itertools.count(1)  # of this process


class HostsError(Exception):
    """Namespaces or links could not be made; the message is the tool's own."""


def why_not():
    """Why this machine cannot be several hosts, in words; empty where it can."""
    if os.geteuid() != 0:
        return "network namespaces need root (CAP_NET_ADMIN and CAP_SYS_ADMIN)"
    missing = [tool for tool in ("ip", "ethtool") if shutil.which(tool) is None]
    if missing:
        return f"{' and '.join(missing)} not found (packages iproute2, ethtool)"
    try:
        with Hosts(["probe"]) as hosts, hosts.inside(FLEET):
            socket.socket(socket.AF_PACKET, socket.SOCK_RAW).close()  # what the relay needs
        return ""
    except (HostsError, OSError) as error:
        return f"network namespaces cannot be made here: {error}"


class Hosts:
    """The namespaces, from `with` to its end, however it ends; processes in them end with them. For the main thread, as signals are.

    Names carry the id of this process, so that two runs do not meet; what a killed run has left behind is removed at the next start."""

    def __init__(self, robots):
        self.robots = list(robots)
        run = f"{_PREFIX}{os.getpid()}-{next(_RUNS)}"
        self._names = {host: f"{run}-{host}" for host in [FLEET, SIMULATOR, *self.robots]}
        self._children = []
        self._handlers = {}

    def __enter__(self):
        self._handlers = {number: signal.signal(number, _leave) for number in (signal.SIGTERM, signal.SIGHUP)}
        try:
            _remove_leftovers()
            self._build()
        except BaseException:
            self.close()
            raise
        return self

    def __exit__(self, *_):
        self.close()

    def close(self):
        for name in self._names.values():
            _remove(name)
        for child in self._children:
            child.wait()
            for pipe in filter(None, (child.stdin, child.stdout, child.stderr)):
                pipe.close()
        for number, handler in self._handlers.items():
            signal.signal(number, handler)

    def popen(self, host, command, **options):
        """Starts a command on a host, like subprocess.Popen, in a session of its own."""
        child = subprocess.Popen(self.command(host, command), start_new_session=True, **options)
        self._children.append(child)
        return child

    def command(self, host, command):
        """The words that run a command on a host."""
        return ["ip", "netns", "exec", self._names[host], *command]

    def enter(self, host):
        """Moves this thread, and those that it starts from now on, to a host. Before rospy, whose threads are to follow."""
        _enter(os.path.join(_NAMESPACES, self._names[host]))

    @contextlib.contextmanager
    def inside(self, host):
        """Meanwhile this thread is on a host; sockets made there stay there."""
        with open("/proc/thread-self/ns/net") as here:
            self.enter(host)
            try:
                yield
            finally:
                _enter(f"/proc/self/fd/{here.fileno()}")

    def kill(self, host):
        """Every process on a host at once, as when its power fails."""
        _kill_all(self._names[host])

    def processes(self, host):
        """Ids of what runs on a host."""
        return _processes(self._names[host])

    def fleet_address(self, robot):
        return f"10.76.0.{1 + self.robots.index(robot)}"

    def management_addresses(self, robot):
        """Of the link between the simulator and a robot: (the simulator's, the robot's)."""
        network = f"10.77.{1 + self.robots.index(robot)}"
        return network + ".1", network + ".2"

    def relay_links(self):
        """For relay.py, which runs on the host `fleet`: robot -> (the interface to it, the one to the bridge)."""
        return {robot: (f"robot{number}", f"relay{number}") for number, robot in enumerate(self.robots, 1)}

    def _build(self):
        for name in self._names.values():
            _ip(f"netns add {name}")
        for host, name in self._names.items():
            with self.inside(host):
                _no_ipv6()
            _ip("link set lo up", name)
        fleet, simulator = self._names[FLEET], self._names[SIMULATOR]
        # No snooping: there is no querier here that would keep tables of the listeners.
        _ip("link add bridge0 type bridge stp_state 0 mcast_snooping 0\nlink set bridge0 up", fleet)
        for number, robot in enumerate(self.robots, 1):
            name = self._names[robot]
            near, far = self.management_addresses(robot)
            _ip(f"link add eth0 netns {name} type veth peer name robot{number} netns {fleet}\n"
                f"link add relay{number} netns {fleet} type veth peer name port{number} netns {fleet}\n"
                f"link add robot{number} netns {simulator} type veth peer name management netns {name}")
            _ip("".join(f"link set {link}{number} up\n" for link in ("robot", "relay", "port")) +
                f"link set port{number} master bridge0", fleet)
            _ip(f"addr add {near}/24 dev robot{number}\nlink set robot{number} up", simulator)
            _ip(f"addr add {self.fleet_address(robot)}/24 dev eth0\nlink set eth0 up\nroute add {MULTICAST} dev eth0\n"
                f"addr add {far}/24 dev management\nlink set management up", name)
            # Checksums are left to the hardware otherwise, which is not there: the relay would carry frames without.
            _run(self.command(robot, ["ethtool", "-K", "eth0", "tx", "off"]))


def _enter(path):
    libc = ctypes.CDLL(None, use_errno=True)
    with open(path) as namespace:
        if libc.setns(namespace.fileno(), _CLONE_NEWNET) != 0:
            raise HostsError(f"cannot enter {path}: {os.strerror(ctypes.get_errno())}")


def _no_ipv6():
    """It would chat on every link; so only what the robots send is there to be lost."""
    for interfaces in ("all", "default"):
        with contextlib.suppress(OSError), open(f"/proc/sys/net/ipv6/conf/{interfaces}/disable_ipv6", "w") as switch:
            switch.write("1")


def _leave(number, _):
    raise KeyboardInterrupt(signal.Signals(number).name)  # which test runners let pass


def _run(command, text=None):
    done = subprocess.run(command, input=text, capture_output=True, text=True)
    if done.returncode != 0:
        raise HostsError((done.stderr or done.stdout).strip().splitlines()[0] if done.stderr or done.stdout
                         else f"{' '.join(command)}: exit status {done.returncode}")
    return done.stdout


def _ip(lines, namespace=None):
    _run(["ip", *(["-netns", namespace] if namespace else []), "-batch", "-"], lines + "\n")


def _processes(name):
    done = subprocess.run(["ip", "netns", "pids", name], capture_output=True, text=True)
    return [int(word) for word in done.stdout.split() if int(word) != os.getpid()]


def _kill_all(name, patience_s=10.0):
    until = time.monotonic() + patience_s
    while running(processes := _processes(name)) and time.monotonic() < until:
        for process in processes:
            try:
                os.kill(process, signal.SIGKILL)
            except ProcessLookupError:
                pass
        time.sleep(0.02)


def running(processes):
    """Whether one of them does more than wait for its parent to take note of its end."""
    for process in processes:
        try:
            with open(f"/proc/{process}/stat") as file:
                if file.read().rsplit(")", 1)[1].split()[0] != "Z":
                    return True
        except OSError:
            pass
    return False


def _remove(name):
    if os.path.exists(os.path.join(_NAMESPACES, name)):
        _kill_all(name)
        subprocess.run(["ip", "netns", "delete", name], capture_output=True)


def _remove_leftovers():
    for name in os.listdir(_NAMESPACES) if os.path.isdir(_NAMESPACES) else []:
        owner = re.fullmatch(_PREFIX + r"(\d+)-.+", name)
        if owner and not os.path.exists("/proc/" + owner[1]):
            _remove(name)


if __name__ == "__main__":
    reason = why_not()
    if reason:
        print("this machine cannot play several hosts:", reason)
    sys.exit(SKIPPED if reason else 0)
