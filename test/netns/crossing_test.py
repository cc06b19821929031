#!/usr/bin/python3
"""Two robots on separate hosts, whose paths cross, keep apart by promises that come late or never."""
import os
import unittest

from hosts_needed import run_tests
from separate_fleet import ROOT, SeparateFleet, new_key

WORLD = os.path.join(ROOT, "test/worlds/crossing_paths.yaml")
GOALS = {"ugv1": (3.5, 0.0), "ugv2": (0.0, 3.5)}
# 50 to 100 ms, and the simulator's step of 20 ms, which the relay's time may lag behind the robots'.
NETWORK = {"delay_s": [0.07, 0.12], "loss": 0.1}
SEPARATION_M = 0.8  # two radii of 0.3 m, and peer_clearance of config/robot.yaml


class CrossingTest(unittest.TestCase):
    def test_robots_that_cross_keep_apart(self):
        key = new_key("netns_logs/fleet.key")
        with SeparateFleet(WORLD, list(GOALS), "netns_logs/crossing", dict.fromkeys(GOALS, key), NETWORK) as fleet:
            pairs = (fleet.robots, fleet.robots[::-1])
            fleet.run_until(lambda: all(peer.name in robot.peers for robot, peer in pairs), 10.0, "they hear each other")
            for robot, _ in pairs:
                robot.send(*GOALS[robot.name])
            fleet.run_until(lambda: all(robot.stands_at(*GOALS[robot.name]) for robot in fleet.robots), 60.0, "both arrive")
            self.assertEqual([robot.truth.contacts for robot in fleet.robots], [0, 0])
            self.assertGreaterEqual(fleet.min_separation_m, SEPARATION_M)
            fleet.run(3.0)
            for robot, peer in pairs:
                self.assertEqual(str(robot.peers[peer.name].sequence), peer.diagnosis["binding sequence"])
            for name, count in fleet.relay.tell(fleet.now).items():
                self.assertAlmostEqual(count["lost"] / (count["lost"] + count["delivered"]), NETWORK["loss"], delta=0.05, msg=name)


if __name__ == "__main__":
    run_tests()
