#!/usr/bin/python3
"""The network between separate hosts: what crosses it, how late, and how much is lost. Its time is told, so that no test depends on how
busy the machine is."""
import os
import socket
import struct
import subprocess
import sys
import unittest

from hosts_needed import netns, run_tests, wait_until
from relay import RelayProcess

GROUP, PORT = "239.255.76.67", 7667
BATCH = 50  # fewer than a socket's buffer holds
ROBOTS = ["ugv1", "ugv2", "ugv3"]


class Station:
    """A robot's socket in the group of the fleet, and one of its own."""

    def __init__(self, hosts, name):
        self.address = hosts.fleet_address(name)
        with hosts.inside(name):
            self.group = self._socket(GROUP)
            self.own = self._socket(self.address)
        member = struct.pack("4s4s", socket.inet_aton(GROUP), socket.inet_aton(self.address))
        self.group.setsockopt(socket.IPPROTO_IP, socket.IP_ADD_MEMBERSHIP, member)
        self.own.setsockopt(socket.IPPROTO_IP, socket.IP_MULTICAST_LOOP, 0)

    @staticmethod
    def _socket(address):
        made = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        made.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 1 << 20)
        made.bind((address, PORT))
        made.setblocking(False)
        return made

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.group.close()
        self.own.close()

    def send(self, text, to=GROUP):
        self.own.sendto(text.encode(), (to, PORT))

    def heard(self):
        """What has come since the last look, in order."""
        texts = []
        for end in (self.group, self.own):
            while True:
                try:
                    texts.append(end.recv(2048).decode())
                except BlockingIOError:
                    break
        return texts


class RelayTest(unittest.TestCase):
    def setUp(self):
        self.hosts = self.enterContext(netns.Hosts(ROBOTS))
        self.relay = RelayProcess(self.hosts, told_time=True)
        self.relay.tell(0.0)
        self.stations = [self.enterContext(Station(self.hosts, name)) for name in ROBOTS]

    def test_multicast_crosses_to_everybody_else(self):
        for number, station in enumerate(self.stations):
            station.send(f"from {number}")
        self.relay.tell(0.0)
        for number, station in enumerate(self.stations):
            self.assertEqual(sorted(station.heard()), [f"from {other}" for other in range(len(ROBOTS)) if other != number])

    def test_one_robot_can_be_addressed(self):
        self.stations[0].send("to you", self.stations[1].address)  # asks for its hardware address first
        for _ in range(3):
            self.relay.tell(0.0)
        self.assertEqual([station.heard() for station in self.stations], [[], ["to you"], []])

    def test_the_largest_datagram_of_the_fleet_crosses(self):
        self.stations[0].send("x" * 1400)
        self.relay.tell(0.0)
        self.assertEqual(self.stations[1].heard(), ["x" * 1400])

    def arrivals(self, sent, step_s):
        """Sends at time 0, and lets time go on in steps: when the second station heard what."""
        when = {}
        for first in range(0, sent, BATCH):
            for number in range(first, first + BATCH):
                self.stations[0].send(str(number))
            self.relay.tell(0.0)
        for step in range(round(0.2 / step_s)):
            self.relay.tell(step * step_s)
            when.update({text: step * step_s for text in self.stations[1].heard()})
        return when

    def test_delays_fill_their_range(self):
        self.relay.change("ugv2", delay_s=[0.05, 0.1])
        delays = list(self.arrivals(500, 0.001).values())
        self.assertEqual(len(delays), 500)
        self.assertTrue(0.05 <= min(delays) < 0.052 and 0.098 < max(delays) <= 0.1011, (min(delays), max(delays)))
        self.assertAlmostEqual(sum(delays) / len(delays), 0.0755, delta=0.002)

    def test_each_robot_loses_its_share(self):
        self.relay.change("ugv2", loss=0.1)
        self.relay.change("ugv3", loss=0.1)
        heard = set(self.arrivals(2000, 0.1))
        also_heard = set(self.stations[2].heard())
        self.assertAlmostEqual(len(heard) / 2000, 0.9, delta=0.02)
        self.assertAlmostEqual(len(also_heard) / 2000, 0.9, delta=0.02)
        self.assertAlmostEqual(len(heard | also_heard) / 2000, 0.99, delta=0.01)  # independent losses

    def test_a_cut_link_carries_nothing_until_it_is_healed(self):
        self.relay.change("ugv2", delay_s=[0.05, 0.05])
        self.stations[0].send("on its way at the cut")
        self.relay.change("ugv2", cut=True)
        self.stations[0].send("while cut")
        self.stations[1].send("while cut")
        self.relay.tell(1.0)
        self.assertEqual([station.heard() for station in self.stations], [[], [], ["on its way at the cut", "while cut"]])
        self.relay.change("ugv2", cut=False)
        self.stations[0].send("healed")
        self.stations[1].send("healed")
        self.relay.tell(1.1)
        self.assertEqual([station.heard() for station in self.stations[:2]], [["healed"], ["healed"]])

    def test_the_same_seed_loses_the_same(self):
        def one_run():
            with netns.Hosts(["ugv1", "ugv2"]) as hosts:
                relay = RelayProcess(hosts, seed=7, told_time=True)
                relay.change("ugv2", loss=0.5)
                with Station(hosts, "ugv1") as sender, Station(hosts, "ugv2") as listener:
                    for number in range(BATCH):
                        sender.send(str(number))
                    relay.tell(1.0)
                    return listener.heard()
        first, second = one_run(), one_run()
        self.assertEqual(first, second)
        self.assertTrue(10 < len(first) < 40, first)


class HostsTest(unittest.TestCase):
    def names(self):
        return [name for name in subprocess.run(["ip", "netns", "list"], capture_output=True, text=True).stdout.split()
                if name.startswith(f"mocha{os.getpid()}-")]

    def test_hosts_and_their_processes_end_together_even_after_a_failure(self):
        with self.assertRaises(ZeroDivisionError):
            with netns.Hosts(["ugv1"]) as hosts:
                sleeper = hosts.popen("ugv1", ["sleep", "1000"])
                self.assertEqual(len(self.names()), 3)
                1 / 0
        self.assertEqual(self.names(), [])
        self.assertIsNotNone(sleeper.poll())

    def test_what_a_killed_run_left_behind_is_removed(self):
        program = ("import subprocess, sys, time; sys.path.insert(0, sys.argv[1]); from netns import Hosts\n"
                   "with Hosts(['ugv1']) as hosts:\n"
                   "  print(hosts.popen('ugv1', ['sleep', '1000'], stdout=subprocess.DEVNULL).pid, flush=True)\n"
                   "  time.sleep(1000)")
        folder = os.path.dirname(os.path.abspath(netns.__file__))
        killed = subprocess.Popen([sys.executable, "-c", program, folder], stdout=subprocess.PIPE, text=True)
        sleeper = int(killed.stdout.readline())
        namespace = f"mocha{killed.pid}-1-ugv1"
        wait_until(lambda: self.is_in_namespace(sleeper, namespace), "the program in its namespace")
        killed.kill()
        killed.communicate()
        with netns.Hosts(["ugv1"]):
            left = subprocess.run(["ip", "netns", "list"], capture_output=True, text=True).stdout
        self.assertNotIn(f"mocha{killed.pid}-", left)
        self.assertFalse(netns.running([sleeper]))

    def is_in_namespace(self, process, name):
        return str(process) in subprocess.run(["ip", "netns", "pids", name], capture_output=True, text=True).stdout.split()


if __name__ == "__main__":
    run_tests()
