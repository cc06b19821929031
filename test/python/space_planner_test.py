#!/usr/bin/python3
"""Planning in space by the Python module mocha_planner.

    space_planner_test.py DIRECTORY     (where the module is)"""
import math
import os
import pathlib
import signal
import subprocess
import sys
import threading
import unittest

import numpy as np

sys.path.insert(0, sys.argv.pop())
import mocha_planner  # noqa: E402

MAPS = pathlib.Path(__file__).resolve().parents[2] / "config" / "maps"
START, GOAL = (1.0, 4.0, 1.5), (9.0, 4.0, 1.5)  # before and behind the wall with two windows


def two_windows(parameters=None, **others):
    return mocha_planner.SpacePlanner(str(MAPS / "two_windows.bt"), parameters or {}, **others)


class PlanningInSpace(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.planner = two_windows()

    def test_there_is_a_certified_trajectory_through_each_window(self):
        plan = self.planner.plan(START, GOAL)
        self.assertTrue(plan.solved, plan.message)
        self.assertEqual([each.certified for each in plan.candidates], [True, True])
        self.assertEqual(len({tuple(each.signature) for each in plan.candidates}), 2)
        self.assertGreater(plan.took_s, 0.0)
        for each in plan.candidates:
            samples = each.sample(0.02)
            places = np.array(samples["place_m"])
            np.testing.assert_allclose(places[[0, -1]], [START, GOAL], atol=1e-6)
            self.assertAlmostEqual(samples["time_s"][-1], each.duration_s)
            self.assertAlmostEqual(np.linalg.norm(np.diff(places, axis=0), axis=1).sum(), each.length_m, delta=0.01)
            self.assertLessEqual(max(samples["speed_mps"]), 2.0)
            self.assertAlmostEqual(sum(each.terms.values()), each.cost, places=6)

    def test_a_ball_in_a_window_is_waited_for_or_passed_by(self):
        best = self.planner.plan(START, GOAL).candidates[0]
        samples = best.sample(0.02)
        middle = samples["place_m"][len(samples["place_m"]) // 2]
        ball = (*middle, 0.0, 0.0, 0.0, 0.3)
        plan = self.planner.plan(START, GOAL, [ball])
        self.assertTrue(plan.solved, plan.message)
        places = np.array(plan.candidates[0].sample(0.01)["place_m"])
        self.assertGreaterEqual(np.linalg.norm(places - middle, axis=1).min(), 0.25 + 0.05 + 0.3 - 1e-3)

    def test_bad_arguments_are_named(self):
        for start, goal, moving, word in (((1.0, 4.0), GOAL, [], "start"), ((math.nan, 4.0, 1.5), GOAL, [], "start"), ("here", GOAL, [], "start"),
                                          (None, GOAL, [], "start"), (START, (9.0, 4.0, math.inf), [], "goal"), (START, (1, 2, 3, 4), [], "goal"),
                                          (START, GOAL, [(1.0, 2.0, 3.0)], "moving"), (START, GOAL, [(0, 0, 0, 0, 0, 0, -1)], "moving"),
                                          (START, GOAL, [(0, 0, 0, 1e7, 0, 0, 1)], "moving"), (START, GOAL, [(0, 0, math.nan, 0, 0, 0, 1)], "moving")):
            with self.subTest(start=start, goal=goal, moving=moving), self.assertRaisesRegex(ValueError, word):
                self.planner.plan(start, goal, moving)
        best = self.planner.plan(START, GOAL).candidates[0]
        for step_s in (0.0, -1.0, 1e-9, math.inf, math.nan):
            with self.assertRaisesRegex(ValueError, f"step_s.* {step_s}"):
                best.sample(step_s)
        with self.assertRaisesRegex(ValueError, "start"):
            self.planner.curves((1.0, math.nan, 1.0))

    def test_bad_parameters_and_maps_are_refused(self):
        for parameters, word in (({"radius": -1.0}, "radius"), ({"radiuss": 0.2}, "radiuss"), ({"radius": "wide"}, "radius"),
                                 ({"classes": 0}, "classes"), ({"bounds": "[0, 0, 0, 1, 1]"}, "bounds"),
                                 ({"bounds": "[0, 0, 0, -1, 1, 1]"}, "bounds"), ({"unknown": "maybe"}, "unknown"),
                                 ({"bounds": (0, 0, 0, 1, 1)}, "bounds"), ({"bounds": np.full(6, np.nan)}, "bounds"), ({"bounds": [[0, 0], 1]}, "bounds"),
                                 ({"map_file": "two_windows.bt"}, "map_file has to be given as the argument")):
            with self.subTest(parameters=parameters), self.assertRaisesRegex(ValueError, word):
                two_windows(parameters)
        for path in (MAPS / "none.bt", MAPS, pathlib.Path(__file__)):
            with self.subTest(path=path), self.assertRaisesRegex(RuntimeError, path.name):
                mocha_planner.SpacePlanner(str(path))
        with self.assertRaisesRegex(ValueError, "held"):
            two_windows(held=[(0.0, 0.0)])

    def test_maps_may_be_paths_and_bounds_rows_of_numbers(self):
        for path in (MAPS / "two_windows.bt", os.fsencode(MAPS / "two_windows.bt")):
            np.testing.assert_array_equal(mocha_planner.SpacePlanner(path).bounds, self.planner.bounds)
        corners = [0.0, 0.2, 0.0, 9.8, 7.8, 2.4]
        for bounds in (corners, tuple(corners), np.array(corners), list(np.array(corners)), str(corners)):
            with self.subTest(bounds=bounds):
                np.testing.assert_allclose(np.ravel(two_windows({"bounds": bounds}).bounds), corners)
        for path in (None, 3):
            self.assertRaises(TypeError, mocha_planner.SpacePlanner, path)

    def test_where_nothing_can_be_planned_the_reason_is_given(self):
        for start, goal, reason in ((START, START, "invalid input"), ((5.0, 4.0, 1.5), GOAL, "start occupied"), (START, (9.0, 4.0, 60.0), "goal occupied")):
            plan = self.planner.plan(start, goal)
            self.assertFalse(plan.solved)
            self.assertEqual((plan.reason, plan.candidates), (reason, []))
            self.assertTrue(plan.message)
        self.assertIsNone(self.planner.curves((5.0, 4.0, 1.5)))

    def test_sampling_ends_with_its_share_of_the_time(self):
        plan = two_windows({"planning_time": 0.1, "prm_samples": 1000000}).plan(START, GOAL)  # all of them would take minutes
        self.assertGreater(plan.took_s, 0.025)
        self.assertIn(plan.reason, ("solved", "budget exhausted"))

    def test_planning_ends_with_ctrl_c(self):
        """In a process of its own: without an answer it would plan for ten minutes."""
        code = f"""
import sys, threading
sys.path.insert(0, {sys.path[0]!r})
import mocha_planner
planner = mocha_planner.SpacePlanner({str(MAPS / "two_windows.bt")!r}, {{"planning_time": 600.0, "prm_samples": 1000000}})
planner.curves({START})  # so that the map is ready
threading.Timer(0.3, print, ["plans"], {{"flush": True}}).start()
try:
    planner.plan({START}, {GOAL})
except KeyboardInterrupt:
    print("interrupted;", "solved" if planner.plan({START}, {START}).solved else "planner can be used")
"""
        with subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE, text=True) as process:
            try:
                self.assertEqual(process.stdout.readline(), "plans\n")
                process.send_signal(signal.SIGINT)
                said, _ = process.communicate(timeout=30)
            finally:
                process.kill()
        self.assertEqual((said, process.returncode), ("interrupted; planner can be used\n", 0))

    def test_threads_may_plan_at_once(self):
        planner = two_windows({"planning_time": 600.0})
        expected = [each.cost for each in planner.plan(START, GOAL).candidates]
        found = []
        threads = [threading.Thread(target=lambda: found.append([each.cost for each in planner.plan(START, GOAL).candidates])) for _ in range(4)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(found, 4 * [expected])

    def test_candidates_outlive_their_planner(self):
        planner = two_windows()
        best = planner.plan(START, GOAL).candidates[0]
        del planner
        self.assertGreater(len(best.sample()["time_s"]), 10)


if __name__ == "__main__":
    unittest.main()
