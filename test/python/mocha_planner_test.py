#!/usr/bin/python3
"""The Python module mocha_planner.

    mocha_planner_test.py DIRECTORY     (where the module is)"""
import pathlib
import sys
import tempfile
import unittest

import numpy as np

sys.path.insert(0, sys.argv.pop())
import mocha_planner  # noqa: E402

CONFIG = pathlib.Path(__file__).resolve().parents[2] / "config"
RESOLUTION_M = 0.1


def room():
    """10 m x 6 m with walls, and a block in the middle that leaves a way on either side."""
    grid = np.zeros((60, 100), dtype=np.int8)
    grid[[0, -1], :] = grid[:, [0, -1]] = 100
    grid[20:40, 40:60] = 100
    return grid


def plan(grid=None, start=(1.0, 3.0, 0.0), goal=(9.0, 3.0), **others):
    return mocha_planner.plan(room() if grid is None else grid, RESOLUTION_M, start, goal, **others)


class Planning(unittest.TestCase):
    def test_a_plan_leads_to_the_goal_around_what_stands(self):
        result = plan(goal=(9.0, 3.0, 1.5))
        self.assertTrue(result.solved, result.message)
        self.assertEqual(result.reason, "solved")
        self.assertEqual(result.goal, (9.0, 3.0))
        driven = result.motion.sample(0.05)
        ends = [driven[name][[0, -1]] for name in ("x_m", "y_m", "yaw_rad", "speed_mps")]
        np.testing.assert_allclose(ends, [[1.0, 9.0], [3.0, 3.0], [0.0, 1.5], [0.0, 0.0]], atol=0.03)
        self.assertFalse(room()[(driven["y_m"] / RESOLUTION_M).astype(int), (driven["x_m"] / RESOLUTION_M).astype(int)].any())
        steps_m = np.hypot(np.diff(driven["x_m"]), np.diff(driven["y_m"]))
        self.assertAlmostEqual(steps_m.sum(), result.motion.length_m, delta=0.01)
        self.assertGreater(result.motion.length_m, 8.5)

    def test_samples_are_spaced_as_asked_for_and_end_with_the_motion(self):
        motion = plan().motion
        samples = motion.sample(0.3)
        np.testing.assert_allclose(np.diff(samples["time_s"])[:-1], 0.3)
        self.assertEqual(samples["time_s"][0], 0.0)
        self.assertEqual(samples["time_s"][-1], motion.duration_s)
        speeds_mps = np.hypot(np.gradient(motion.sample()["x_m"], 0.05), np.gradient(motion.sample()["y_m"], 0.05))
        np.testing.assert_allclose(speeds_mps[2:-2], np.abs(motion.sample()["speed_mps"])[2:-2], atol=0.05)

    def test_candidates_are_of_several_classes_and_the_cheapest_is_driven(self):
        candidates = plan().candidates
        self.assertGreater(len({tuple(each.signature) for each in candidates}), 1)
        certified = [each for each in candidates if each.certified]
        selected, = [each for each in candidates if each.selected]
        self.assertEqual(selected.cost, min(each.cost for each in certified))
        self.assertEqual(selected.outcome, "solved")
        self.assertAlmostEqual(sum(selected.terms.values()), selected.cost, places=6)
        self.assertEqual(selected.path.shape[1], 2)
        np.testing.assert_allclose(selected.path[-1], (9.0, 3.0), atol=1e-6)
        self.assertEqual(len(plan(parameters={"classes": 1}).candidates), 1)

    def test_candidates_say_what_planning_fell_back_on(self):
        self.assertEqual(plan().candidates[0].fallbacks, [])
        only, = plan(parameters={"roadmap": "visibility_prm", "prm_samples": 1}).candidates
        self.assertTrue(any(each.startswith("a path of the lattice: ") for each in only.fallbacks), only.fallbacks)

    def test_rows_lie_above_each_other_from_the_origin_on(self):
        moved = plan(start=(21.0, -7.0, 0.0), goal=(29.0, -7.0), origin=(20.0, -10.0))
        self.assertTrue(moved.solved, moved.message)
        grid = room()
        grid[40:, 40:60] = 100  # nothing is left above the block
        self.assertLess(plan(grid).motion.sample()["y_m"].min(), 2.0)
        self.assertGreater(plan(grid[::-1]).motion.sample()["y_m"].max(), 4.0)

    def test_values_mean_what_they_mean_in_ros(self):
        wall = np.zeros((60, 100), dtype=np.int8)
        for value, blocks in ((25, False), (-1, False), (50, False), (65, True), (100, True)):
            wall[:, 50] = value
            wall[[0, -1], :] = wall[:, [0, -1]] = 100
            self.assertEqual(plan(wall).reason, "no path" if blocks else "solved", value)

    def test_says_why_there_is_no_plan(self):
        enclosed = room()
        enclosed[:, 50] = 100
        result = plan(enclosed)
        self.assertFalse(result.solved)
        self.assertEqual(result.reason, "no path")
        self.assertIn("nearest place in reach", result.message)
        self.assertIsNone(result.motion)
        self.assertEqual(plan(start=(5.0, 3.0, 0.0)).reason, "start occupied")

    def test_other_robots_and_other_integers(self):
        rover, jackal = plan(), plan(model="jackal")
        self.assertNotEqual(rover.motion.duration_s, jackal.motion.duration_s)
        self.assertEqual(plan(model=str(CONFIG / "robots/jackal.yaml")).motion.duration_s, jackal.motion.duration_s)
        wide = np.zeros((120, 200), dtype=np.int64)
        wide[::2, ::2] = room()
        self.assertEqual(plan(wide[::2, ::2]).motion.duration_s, rover.motion.duration_s)

    def test_bad_arguments_are_refused_with_a_sentence(self):
        for arguments, complaint in (
                ({"grid": np.zeros((60, 100))}, "grid: has to be a 2-D numpy array of integers, not empty, and is 'of float64"),
                ({"grid": np.zeros((1, 60, 100), dtype=np.int8)}, r"with the shape \(1, 60, 100\)"),
                ({"grid": np.zeros((0, 100), dtype=np.int8)}, "not empty"),
                ({"grid": [[0, 0], [0, 0]]}, "numpy array"),
                ({"grid": np.full((60, 100), 101)}, "-1 .unknown. or 0 to 100 .per cent. in each cell, and is 101"),
                ({"grid": np.full((60, 100), 255, dtype=np.uint8)}, "and is 255"),
                ({"start": (1.0, 3.0)}, r"start: has to be \(x, y, yaw\), finite numbers, and is \(1.0, 3.0\)"),
                ({"start": (1.0, 3.0, np.nan)}, "start: .*nan"),
                ({"start": "here"}, "start: .*'here'"),
                ({"goal": (9.0, 3.0, 0.0, 0.0)}, "goal: has to be"),
                ({"goal": (np.inf, 3.0)}, "goal: .*inf"),
                ({"goal": None}, "goal: .*None"),
                ({"origin": (0.0, 0.0, 0.0)}, r"origin: has to be \(x, y\)"),
                ({"model": "hovercraft"}, "hovercraft"),
                ({"parameters": {"clases": 4}}, "clases"),
                ({"parameters": {"classes": 0}}, "classes"),
                ({"parameters": {"classes": "many"}}, "classes")):
            with self.subTest(arguments=arguments), self.assertRaisesRegex(ValueError, complaint):
                plan(**arguments)
        for resolution_m in (0.0, -0.1, float("nan"), float("inf")):
            with self.subTest(resolution_m=resolution_m), self.assertRaisesRegex(ValueError, "resolution_m: has to be"):
                mocha_planner.plan(room(), resolution_m, (1.0, 3.0, 0.0), (9.0, 3.0))
        for step_s in (0.0, -1.0, float("nan"), 1e-9):
            with self.subTest(step_s=step_s), self.assertRaisesRegex(ValueError, "step_s: has to be"):
                plan().motion.sample(step_s)

    def test_a_model_that_is_none_is_named(self):
        with tempfile.NamedTemporaryFile("w", suffix=".yaml") as file:
            file.write("max_sped: 1.0\n")
            file.flush()
            with self.assertRaisesRegex(ValueError, f"{file.name}.*max_sped"):
                plan(model=file.name)


if __name__ == "__main__":
    unittest.main()
