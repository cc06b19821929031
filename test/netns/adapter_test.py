#!/usr/bin/python3
"""A robot on a host of its own drives by what the adapter brings, and stands when that is lost."""
import os
import unittest

from hosts_needed import run_tests
from separate_fleet import ROOT, SeparateFleet

GOAL = (4.5, -1.5)


class AdapterTest(unittest.TestCase):
    def test_a_robot_drives_through_the_adapter_and_stands_without(self):
        with SeparateFleet(os.path.join(ROOT, "test/worlds/hall.yaml"), ["ugv1"], "netns_logs/adapter") as fleet:
            rover = fleet.robot("ugv1")
            rover.send(*GOAL)
            fleet.run_until(lambda: rover.truth.speed > 0.75, 20.0, "it drives at speed")
            fleet.detach("ugv1")
            fleet.run(2.0)
            self.assertTrue(rover.stands(), "it moves without commands")
            self.assertGreater(rover.distance_to(*GOAL), 1.0, "it was there before the adapter was lost")
            fleet.attach("ugv1")
            fleet.wait_for("ugv1")
            fleet.run_until(lambda: rover.stands_at(*GOAL), 40.0, "it goes on when the adapter is back")
            self.assertEqual(rover.truth.contacts, 0)


if __name__ == "__main__":
    run_tests()
