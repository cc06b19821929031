#!/usr/bin/python3
"""The capacity of a door, which scripts/bench deadlock holds its times against."""
import math
import pathlib
import sys
import unittest

TEST = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(TEST))
from benchmarks import door_capacity  # noqa: E402

PACE = {"speed_mps": 1.0, "acceleration_mps2": 0.5, "apart_m": 0.9}
RAMPS_S = 2.0  # one up, one down: v / a


class DoorCapacityTest(unittest.TestCase):
    def least_s(self, *ways):
        return door_capacity.least_time_of(ways, PACE)

    def test_one_takes_its_way_and_its_ramps(self):
        self.assertAlmostEqual(self.least_s((0, 4.0, 3.0)), 7.0 + RAMPS_S, places=2)

    def test_those_behind_follow_at_their_distance(self):
        self.assertAlmostEqual(self.least_s(*[(0, 4.0, 3.0)] * 5), 7.0 + RAMPS_S + 4 * 0.9, places=2)

    def test_who_is_far_behind_holds_nobody_up(self):
        self.assertAlmostEqual(self.least_s((0, 4.0, 3.0), (0, 9.0, 3.0)), 12.0 + RAMPS_S, places=2)

    def test_who_has_farther_to_go_passes_first(self):
        self.assertAlmostEqual(self.least_s((0, 4.0, 1.0), (0, 4.0, 3.0)), 7.0 + RAMPS_S, places=2)

    def test_changing_the_direction_takes_longer_than_following(self):
        self.assertAlmostEqual(self.least_s((0, 4.0, 3.0), (1, 4.0, 3.0)), 7.0 + RAMPS_S + math.sqrt(2.0) * 0.9, places=2)

    def test_directions_change_once_where_all_are_there(self):
        both = [(side, 4.0, 3.0) for side in (0, 1)] * 3
        self.assertAlmostEqual(self.least_s(*both), 7.0 + RAMPS_S + (4 + math.sqrt(2.0)) * 0.9, places=2)

    def test_directions_change_twice_where_some_come_later(self):
        # One after the other, whatever the number of changes: the one from the far side passes while the last is on its way.
        self.assertAlmostEqual(self.least_s((0, 4.0, 3.0), (1, 4.0, 3.0), (0, 9.0, 3.0)), 12.0 + RAMPS_S, places=2)

    def test_two_at_a_right_angle_keep_their_distance(self):
        after_s = math.sqrt(2.0) * PACE["apart_m"] / PACE["speed_mps"]
        gaps = [math.hypot(t, after_s - t) for t in [0.01 * i for i in range(200)]]
        self.assertAlmostEqual(min(gaps), PACE["apart_m"], places=2)

    def test_ten_through_a_door(self):
        world = TEST.parent / "config" / "worlds" / "ten_through_a_door.yaml"
        pace = {"speed_mps": 1.0, "acceleration_mps2": 1.0, "apart_m": 0.95}
        # At the door 4 m from the nearest start, the last 4 m from it to the nearest goal.
        least_s = 4.0 + 4.0 + 1.0 + (8 + math.sqrt(2.0)) * 0.95
        found_s = door_capacity.least_time_s(world, (0.0, 0.0), pace)
        self.assertGreaterEqual(found_s, least_s - 0.01)
        self.assertLess(found_s, least_s + 2.0)


if __name__ == "__main__":
    unittest.main()
