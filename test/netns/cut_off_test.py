#!/usr/bin/python3
"""A robot is cut off from the network while it drives: what it promised last holds, and then the place where that ended is taken."""
import math
import os
import unittest

from hosts_needed import run_tests
from separate_fleet import ROOT, SeparateFleet

WORLD = os.path.join(ROOT, "test/worlds/crossing_paths.yaml")
MIDDLE = (0.0, 0.0)
WEST, EAST, NORTH = (-3.5, 0.0), (3.5, 0.0), (0.0, 3.0)
SEPARATION_M = 0.8  # two radii of 0.3 m, and peer_clearance of config/robot.yaml
ON_ITS_WAY_S = 0.2  # a promise that arrived before the cut is known to the whole stack by then


def end_of(trajectory):
    return trajectory.phases[-1].x[-1], trajectory.phases[-1].y[-1]


def number_of(trajectory):
    return trajectory.epoch, trajectory.sequence


class CutOffTest(unittest.TestCase):
    def drive(self, fleet, robot, goal):
        """Drives there; the smallest distance to the middle on the way."""
        robot.send(*goal)
        nearest = [math.inf]

        def there():
            nearest.append(robot.distance_to(*MIDDLE))
            return robot.stands_at(*goal)
        fleet.run_until(there, 60.0, f"{robot.name} arrives at {goal}")
        return min(nearest)

    def test_the_last_promise_of_a_robot_that_is_cut_off_holds(self):
        with SeparateFleet(WORLD, ["ugv1", "ugv2"], "netns_logs/cut_off") as fleet:
            passer, lost = fleet.robots
            lost.send(*MIDDLE)
            promised = lambda: lost.name in passer.peers and math.dist(end_of(passer.peers[lost.name]), MIDDLE) < 0.2
            fleet.run_until(lambda: promised() and lost.truth.speed > 0.5, 20.0, "the passer knows where the other one will stand")
            fleet.relay.change(lost.name, cut=True)
            fleet.run(ON_ITS_WAY_S)
            promise = number_of(passer.peers[lost.name])

            self.assertGreater(lost.distance_to(*MIDDLE), 0.8)
            self.assertGreaterEqual(self.drive(fleet, passer, EAST), SEPARATION_M)  # for which the lost one may step aside
            self.assertRegex(passer.complaint(), f"{lost.name} is out of reach; its last promise still counts")

            self.drive(fleet, lost, NORTH)  # nothing is in the middle now, and the passer sees that
            self.assertGreaterEqual(self.drive(fleet, passer, WEST), SEPARATION_M)
            self.assertEqual(number_of(passer.peers[lost.name]), promise)

            fleet.relay.change(lost.name, cut=False)
            fleet.run_until(lambda: not promised(), 5.0, "the passer hears of the new promise")
            self.assertLess(self.drive(fleet, passer, EAST), 0.3)
            self.assertEqual([robot.truth.contacts for robot in fleet.robots], [0, 0])


if __name__ == "__main__":
    run_tests()
