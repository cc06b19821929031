#!/usr/bin/python3
"""A robot's computer dies and is started again while both drive: the fleet goes on, and believes the newer promises."""
import os
import unittest

from hosts_needed import run_tests
from separate_fleet import ROOT, SeparateFleet

WORLD = os.path.join(ROOT, "test/worlds/crossing_paths.yaml")
GOALS = {"ugv1": (3.5, 0.0), "ugv2": (0.0, 3.5)}


class RestartTest(unittest.TestCase):
    def test_the_fleet_goes_on_when_a_robot_is_started_again(self):
        with SeparateFleet(WORLD, list(GOALS), "netns_logs/restart") as fleet:
            survivor, victim = fleet.robots
            for robot in fleet.robots:
                robot.send(*GOALS[robot.name])
            fleet.run_until(lambda: victim.truth.path_length > 1.0, 20.0, "both are on their way")
            self.assertEqual(survivor.peers[victim.name].epoch, 1)
            fleet.kill(victim.name)
            fleet.run_until(lambda: survivor.stands_at(*GOALS[survivor.name]), 60.0, "the other robot arrives")
            self.assertGreater(victim.distance_to(*GOALS[victim.name]), 4.0, "the victim drives without a computer")

            fleet.boot(victim.name)
            fleet.wait_for(victim.name)
            fleet.run_until(lambda: survivor.peers[victim.name].epoch == 2, 10.0, "the survivor believes the newer epoch")
            victim.send(*GOALS[victim.name])
            fleet.run_until(lambda: victim.stands_at(*GOALS[victim.name]), 60.0, "the victim arrives after all")
            self.assertEqual(victim.diagnosis["epoch"], "2")
            self.assertEqual([robot.truth.contacts for robot in fleet.robots], [0, 0])


if __name__ == "__main__":
    run_tests()
