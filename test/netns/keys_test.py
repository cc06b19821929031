#!/usr/bin/python3
"""Two robots with different keys on one network are strangers: neither heeds the other, and both say why."""
import os
import unittest

from hosts_needed import run_tests
from separate_fleet import ROOT, SeparateFleet, new_key

WORLD = os.path.join(ROOT, "test/worlds/crossing_paths.yaml")
GOALS = {"ugv1": (-2.0, 1.0), "ugv2": (1.0, -2.0)}  # far from each other


class KeysTest(unittest.TestCase):
    def test_robots_with_different_keys_ignore_each_other_and_say_why(self):
        keys = {name: new_key(f"netns_logs/{name}.key") for name in GOALS}
        with SeparateFleet(WORLD, list(GOALS), "netns_logs/keys", keys) as fleet:
            for robot in fleet.robots:
                robot.send(*GOALS[robot.name])
            fleet.run_until(lambda: all(robot.stands_at(*GOALS[robot.name]) for robot in fleet.robots), 30.0, "both arrive")
            fleet.run(2.0)
            for robot in fleet.robots:
                self.assertEqual(robot.peers, {})
                self.assertFalse([line for line in robot.diagnosis if line.startswith("peer ")], robot.report())
                self.assertIn("without this fleet's key", robot.complaint())
                self.assertGreater(int(robot.diagnosis["datagrams of another key"]), 10)
                self.assertEqual(robot.diagnosis["datagrams heard"], "0")


if __name__ == "__main__":
    run_tests()
