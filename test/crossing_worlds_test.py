#!/usr/bin/python3
"""The people of scripts/bench crossing."""
import math
import pathlib
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
from benchmarks.crossing_worlds import Walk, crossing_world  # noqa: E402

ENDS = [(0.0, 0.0), (6.0, 0.0)]


def between(keyframes, t):
    t %= keyframes[-1][0]
    for (t0, *a), (t1, *b) in zip(keyframes, keyframes[1:]):
        if t <= t1:
            return tuple(p + (t - t0) / (t1 - t0) * (q - p) for p, q in zip(a, b))
    raise AssertionError(t)


class WalkTest(unittest.TestCase):
    def test_is_at_the_meeting_in_time(self):
        walk = Walk(0.3, 1.0, ENDS, 0.5, 2.0, 0.0)
        self.assertAlmostEqual(walk.place(2.0)[0], 3.0)
        self.assertAlmostEqual(walk.place(2.5)[0], 3.5)

    def test_stands_where_it_turns(self):
        walk = Walk(0.3, 1.0, ENDS, 0.5, 2.0, 0.5)
        for t, x in ((5.0, 6.0), (5.49, 6.0), (6.5, 5.0), (11.5, 0.0), (11.9, 0.0), (13.0, 1.0)):
            self.assertAlmostEqual(walk.place(t)[0], x)

    def test_keyframes_are_the_same_walk_again_and_again(self):
        for turn_s in (0.0, 0.5):
            for meet_s in (0.3, 2.0, 5.2, 8.9, 12.4):
                walk = Walk(0.3, 0.8, ENDS, 0.5, meet_s, turn_s)
                keyframes = walk.as_dict()["keyframes"]
                self.assertEqual(keyframes[0][0], 0.0)
                self.assertTrue(all(a[0] < b[0] for a, b in zip(keyframes, keyframes[1:])))
                for i in range(400):
                    self.assertLess(math.dist(walk.place(0.1 * i), between(keyframes, 0.1 * i)), 0.01)

    def test_in_a_world_all_stand_as_long(self):
        for mover in crossing_world(1, 0.5)["moving"]:
            frames = mover["keyframes"]
            stands = [b[0] - a[0] for a, b in zip(frames, frames[1:]) if math.dist(a[1:], b[1:]) < 0.005]
            self.assertAlmostEqual(sum(stands), 1.0, 2)


if __name__ == "__main__":
    unittest.main()
