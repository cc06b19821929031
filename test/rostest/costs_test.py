#!/usr/bin/python3
"""Two robots that would pass a cylinder on the same side: the first one's promise makes that dearer for the second one, which takes another
way, as in the paper's Fig. 14; and scripts/plots costs draws it from the recording, and scripts/plots animation the drive."""

import os
import shutil
import subprocess
import sys
import tempfile
import unittest

import numpy as np
import rospkg
import rostest
from PIL import Image, ImageSequence
from mocha_ugv.msg import MotionPhase

ROOT = rospkg.RosPack().get_path("mocha_ugv")
sys.path[:0] = [os.path.join(ROOT, "scripts"), os.path.join(ROOT, "test")]
from mocha_scripts import costs_plots  # noqa: E402

WORLD = os.path.join(ROOT, "config/worlds/corridor_meet.yaml")
RECORDED_S = 4.0
MOST_RECORDINGS = 5
CIRCLES = costs_plots.worlds.read_world(WORLD)["circles"]
DEARER = 1.1  # than before the promise, at least by this factor


def selected(plan):
    return next(way for way in plan.ways if way.selected)


def run(module, *arguments, out):
    environment = dict(os.environ, PYTHONPATH=ROOT + "/scripts:" + ROOT + "/test:" + os.environ["PYTHONPATH"], ROS_HOME=out)
    return subprocess.run(["/usr/bin/python3", "-m", "mocha_scripts." + module, *arguments, "--out", out],
                          env=environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, timeout=120.0)


class CostsTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.out = tempfile.mkdtemp()
        cls.bag = os.path.join(cls.out, "drive.bag")
        for _ in range(MOST_RECORDINGS):
            cls.demo = run("demo", "--headless", "--rate", "1", "--world", WORLD, "--limit", str(RECORDED_S), out=cls.out)
            if cls.tells():
                break

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.out)

    @classmethod
    def tells(cls):
        """Goals do not come in lockstep, so the clock is no faster than the machine's. Still, on a busy machine one may come so late that its
        robot knows the other's promise from the start, or plans on the way, where paths are given up before they have a cost."""
        if not os.path.exists(cls.bag):
            return False
        recording = costs_plots.Recording(cls.bag, ["ugv1", "ugv2"])
        plan, before = recording.telling_plan("ugv2")
        return recording.leader() == "ugv1" and before is not None and bool(cls.solved_like_wanted(plan, before))

    @staticmethod
    def side(way):
        return costs_plots.signature(costs_plots.places(way), CIRCLES)

    @classmethod
    def solved_like_wanted(cls, plan, before):
        """The paths on the side that was wanted before, other than those of which the planner only knows what they cost at least."""
        wanted = cls.side(selected(before))
        return [way for way in plan.ways if costs_plots.solved(way) and cls.side(way) == wanted]

    def setUp(self):
        self.assertTrue(os.path.exists(self.bag), self.demo.stdout)

    def test_the_drive_is_drawn_as_an_animated_picture(self):
        drawn = run("plots", "animation", self.bag, "--world", WORLD, "--speed", "5", out=self.out)
        self.assertEqual(drawn.returncode, 0, drawn.stdout)
        with Image.open(os.path.join(self.out, "drive.gif")) as picture:
            self.assertGreater(picture.n_frames, 5)
            frames = [np.asarray(picture.convert("RGB"), dtype=int) for picture in ImageSequence.Iterator(picture)]
        self.assertGreater((np.abs(frames[-1] - frames[0]).max(axis=2) > 50).mean(), 1e-3, "nothing moves in it")

    def test_the_promise_makes_the_way_dearer_and_another_is_taken(self):
        recording = costs_plots.Recording(self.bag, ["ugv1", "ugv2"])
        self.assertEqual(recording.leader(), "ugv1", self.demo.stdout)
        plan, before = recording.telling_plan("ugv2")
        self.assertFalse(before.promises)
        self.assertEqual(list(plan.promises), ["ugv1"])
        wanted, taken = selected(before), selected(plan)
        self.assertNotEqual(self.side(wanted), self.side(taken))
        dearer = self.solved_like_wanted(plan, before)
        self.assertTrue(dearer, "the way that was wanted is no candidate any more")
        for way in dearer:
            self.assertGreater(way.cost, DEARER * wanted.cost)
            self.assertGreater(way.cost, taken.cost)
            self.assertGreater(costs_plots.due_to_team_mate(way), 0.5 * (way.cost - taken.cost), "the promise is not what makes it dearer")

    def test_it_is_drawn(self):
        plots = run("plots", "costs", self.bag, "--world", WORLD, out=self.out)
        self.assertEqual(plots.returncode, 0, plots.stdout)
        for name in ("costs.png", "time_lapse.png"):
            self.assertGreater(os.path.getsize(os.path.join(self.out, name)), 5000, plots.stdout)
        rows = [line for line in plots.stdout.splitlines() if line.endswith("yes")]
        self.assertEqual([row.split()[0] for row in rows], ["ugv1", "ugv2"], plots.stdout)

    def test_a_promise_is_rebuilt_from_its_knots(self):
        """A curve x = y^4 through three knots, and the least-jerk motion from rest to rest, which is known."""
        quartic = MotionPhase(kind=MotionPhase.DRIVE, direction=1, durations=[1.0, 1.0], x=[0.0, 1.0, 16.0], y=[0.0, 1.0, 2.0],
                              start_derivatives=[0.0, 1.0, 0.0, 0.0], end_derivatives=[32.0, 1.0, 48.0, 0.0])
        places = costs_plots.minco_places(quartic, 3)
        np.testing.assert_allclose(places[:, 0], places[:, 1] ** 4, atol=1e-9)
        rest = MotionPhase(kind=MotionPhase.DRIVE, direction=1, durations=[2.0], x=[0.0, 1.0], y=[0.0, 0.0],
                           start_derivatives=[0.0] * 4, end_derivatives=[0.0] * 4)
        places = costs_plots.minco_places(rest, 3)
        share = np.linspace(0.0, 1.0, len(places))
        np.testing.assert_allclose(places[:, 0], 10.0 * share ** 3 - 15.0 * share ** 4 + 6.0 * share ** 5, atol=1e-9)


if __name__ == "__main__":
    rostest.rosrun("mocha_ugv", "costs", CostsTest, sys.argv)
