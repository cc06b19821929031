#!/usr/bin/python3
"""What the table of a drive counts: steering reversals and replans."""
import pathlib
import sys
import types
import unittest

ROOT = pathlib.Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "scripts"))
from mocha_scripts import referee  # noqa: E402


def command(yaw_rate):
    return types.SimpleNamespace(angular=types.SimpleNamespace(z=yaw_rate))


def plan(phases):
    return types.SimpleNamespace(phases=[None] * phases)


class RefereeTest(unittest.TestCase):
    def setUp(self):
        self.robot = referee.RobotResult("ugv1")

    def reversals(self, *yaw_rates):
        for yaw_rate in yaw_rates:
            self.robot.on_command(command(yaw_rate))
        return self.robot.reversals.count

    def test_a_reversal_is_a_change_of_sign(self):
        self.assertEqual(self.reversals(0.5, 0.3, -0.5, -0.2, 0.4), 2)

    def test_small_rates_do_not_count(self):
        self.assertEqual(self.reversals(0.5, -0.05, 0.05, -0.09, 0.5), 0)
        self.assertEqual(self.reversals(0.0, -0.5), 1)

    def test_the_first_turn_is_none(self):
        self.assertEqual(self.reversals(0.0, -0.6, -0.3), 0)

    def test_plans_after_the_first_are_replans(self):
        for phases in (0, 2, 1, 0, 3):
            self.robot.on_plan(plan(phases))
        self.assertEqual(self.robot.as_dict(0.0)["replans"], 2)

    def test_nothing_counts_after_the_arrival(self):
        self.robot.on_plan(plan(1))
        self.reversals(0.5)
        self.robot.reached = True
        self.robot.on_plan(plan(1))
        self.assertEqual(self.reversals(-0.5), 0)
        self.assertEqual(self.robot.as_dict(0.0)["replans"], 0)

    def test_the_table_has_them(self):
        self.reversals(0.5, -0.5)
        results = {"robots": [self.robot.as_dict(0.0)], "min_separation_m": None}
        head, row = referee.table(results).splitlines()
        self.assertEqual(len(head), len(row))
        self.assertTrue(head.endswith("reversals  replans"))
        self.assertEqual(row.split()[-2:], ["1", "0"])


if __name__ == "__main__":
    unittest.main()
