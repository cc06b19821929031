#!/usr/bin/python3
"""The fleet's emergency stop over a network that loses a fifth: it reaches all, and a robot that was cut off or lost its computer learns of it."""
import os
import unittest

from hosts_needed import run_tests
from separate_fleet import ROOT, SeparateFleet, new_key

WORLD = os.path.join(ROOT, "test/worlds/crossing_paths.yaml")
LOGS = "netns_logs/emergency_stop"
GOALS = {"ugv1": (3.5, 0.0), "ugv2": (3.5, -3.5)}  # neither waits for the other on the way
NETWORK = {"delay_s": [0.02, 0.07], "loss": 0.2}
HEARD_S = 0.6  # five datagrams within 0.4 s: one in 3,000 stops takes longer
BRAKING_S = 0.7  # from full speed


class EmergencyStopTest(unittest.TestCase):
    def stop(self, fleet, name, order):
        return fleet.call(name, f"/{name}/fleet/emergency_stop", "true" if order else "false")

    def check_all(self, fleet, stopped):
        """That they say so; diagnostics come once a second."""
        fleet.run(1.5)
        says_so = lambda robot: ("emergency stop of the fleet" in robot.complaint()) == stopped
        fleet.run_until(lambda: all(map(says_so, fleet.robots)), 5.0, f"all are stopped: {stopped}")

    def restart(self, fleet, name):
        """Its power fails; so it comes back. Where it stands now."""
        fleet.kill(name)
        fleet.run(1.0)
        fleet.boot(name)
        fleet.wait_for(name)
        return fleet.robot(name).place()

    def test_the_stop_reaches_all_and_holds_until_its_reset(self):
        key = new_key("netns_logs/emergency_stop.key")
        with SeparateFleet(WORLD, list(GOALS), LOGS, dict.fromkeys(GOALS, key), NETWORK) as fleet:
            first, second = fleet.robots
            for robot in fleet.robots:
                robot.send(*GOALS[robot.name])
            fleet.run_until(lambda: all(robot.truth.speed > 0.5 for robot in fleet.robots), 20.0, "both drive")
            self.assertIn("success: True", self.stop(fleet, "ugv2", True))
            fleet.run(HEARD_S + BRAKING_S)
            self.assertTrue(first.stands() and second.stands())
            self.check_all(fleet, True)

            fleet.relay.change("ugv1", cut=True)
            fleet.run(0.2)
            self.assertIn("no emergency stop", self.stop(fleet, "ugv2", False))
            fleet.run(2.0)
            self.assertIn("emergency stop of the fleet by ugv2", first.complaint())
            # Out of reach, the other stop cannot be reset.
            self.stop(fleet, "ugv1", True)
            self.stop(fleet, "ugv2", True)
            self.stop(fleet, "ugv2", False)
            fleet.run(1.0)
            fleet.relay.change("ugv1", cut=False)
            self.check_all(fleet, True)
            self.assertIn("emergency stop of the fleet by ugv1", second.complaint())

            place = self.restart(fleet, "ugv1")
            first.send(*GOALS["ugv1"])
            self.check_all(fleet, True)
            os.remove(os.path.join(LOGS, "ugv2", "mocha_ugv", "ugv2.stops"))
            self.restart(fleet, "ugv2")
            self.check_all(fleet, True)
            self.assertLess(first.distance_to(*place), 0.02)

            self.stop(fleet, "ugv2", False)
            self.check_all(fleet, False)
            fleet.run(2.0)
            self.assertLess(first.distance_to(*place), 0.02, "sets off by itself")
            for robot in fleet.robots:
                robot.send(*GOALS[robot.name])
            fleet.run_until(lambda: all(robot.stands_at(*GOALS[robot.name]) for robot in fleet.robots), 60.0, "both arrive")
            self.assertEqual([robot.truth.contacts for robot in fleet.robots], [0, 0])


if __name__ == "__main__":
    run_tests()
