#!/usr/bin/python3
"""The quickest plans of puzzles, which scripts/bench deadlock holds its times against."""
import pathlib
import sys
import tempfile
import unittest

import yaml

TEST = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(TEST))
from benchmarks import cell_optimum  # noqa: E402


def corridor(length, robots, siding=None):
    """A corridor of cells along x; a cell above it at `siding`."""
    high = 1 if siding is None else 2
    solid = [] if siding is None else [x for x in range(length) if x != siding]
    cells = [[x, 1] for x in solid]
    corners = [[[1.2 * (x + dx), 1.2 * (y + dy)] for dx, dy in ((0, 0), (1, 0), (1, 1), (0, 1))] for x, y in cells]
    return {"bounds": {"min": [-0.2, -0.2], "max": [1.2 * length + 0.2, 1.2 * high + 0.2]}, "polygons": corners,
            "robots": [{"start": [1.2 * (a + 0.5), 0.6, 0.0], "goal": [1.2 * (b + 0.5), 0.6]} for a, b in robots]}


def steps_of(world):
    with tempfile.NamedTemporaryFile("w", suffix=".yaml") as file:
        yaml.safe_dump(world, file)
        file.flush()
        return cell_optimum.least_steps(file.name)


class CellOptimumTest(unittest.TestCase):
    def test_one_goes_straight(self):
        self.assertEqual(steps_of(corridor(6, [(0, 5)])), 5)

    def test_a_train_follows_without_gaps(self):
        self.assertEqual(steps_of(corridor(6, [(0, 3), (1, 4), (2, 5)])), 3)

    def test_two_do_not_swap(self):
        self.assertIsNone(steps_of(corridor(2, [(0, 1), (1, 0)])))
        self.assertIsNone(steps_of(corridor(5, [(0, 4), (4, 0)])))

    def test_a_siding_lets_them_pass(self):
        self.assertEqual(steps_of(corridor(3, [(0, 2), (2, 0)], siding=1)), 4)

    def test_many_are_as_quick_as_the_farthest_where_nobody_is_in_the_way(self):
        self.assertEqual(steps_of(corridor(12, [(cell, cell + 5) for cell in range(7)])), 5)

    def test_more_than_can_be_numbered_are_refused(self):
        with self.assertRaises(ValueError):
            steps_of(corridor(40, [(cell, cell + 1) for cell in range(12)]))

    def test_places_between_cells_are_none(self):
        world = corridor(4, [(0, 3)])
        world["robots"][0]["goal"][0] += 0.1
        with self.assertRaises(ValueError):
            steps_of(world)

    def test_the_puzzles_are_as_quick_as_known(self):
        known = {"puzzle_siding": 13, "puzzle_crossroads": 9, "puzzle_comb": 9}
        for name, steps in known.items():
            self.assertEqual(cell_optimum.least_steps(TEST / "worlds" / (name + ".yaml")), steps, name)


if __name__ == "__main__":
    unittest.main()
