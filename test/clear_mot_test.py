#!/usr/bin/python3
"""The CLEAR MOT score of scripts/bench tracking, on cases made by hand."""
import pathlib
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
from benchmarks.clear_mot import ClearMot  # noqa: E402


def scored(*scans):
    score = ClearMot()
    for people, tracks in scans:
        score.add(people, tracks)
    return score


class ClearMotTest(unittest.TestCase):
    def test_a_perfect_track(self):
        summary = scored(*[({1: (t, 0.0)}, {7: (t + 0.1, 0.0)}) for t in range(5)]).summary()
        self.assertEqual((summary["misses"], summary["false_positives"], summary["switches"]), (0, 0, 0))
        self.assertEqual(summary["mota"], 1.0)
        self.assertAlmostEqual(summary["motp_m"], 0.1)

    def test_out_of_reach_is_a_miss_and_a_false_positive(self):
        summary = scored(({1: (0.0, 0.0)}, {7: (0.76, 0.0)}), ({1: (0.0, 0.0)}, {7: (0.74, 0.0)})).summary()
        self.assertEqual((summary["misses"], summary["false_positives"], summary["mota"]), (1, 1, 0.0))

    def test_a_pair_is_kept_though_another_is_nearer(self):
        score = scored(({1: (0.0, 0.0)}, {7: (0.0, 0.0)}), ({1: (0.5, 0.0)}, {7: (0.0, 0.0), 8: (0.5, 0.0)}))
        self.assertEqual((score.switches, score.false_positives), (0, 1))
        self.assertEqual(score.distances_m, [0.0, 0.5])

    def test_another_number_is_a_switch_also_after_a_gap(self):
        score = scored(({1: (0.0, 0.0)}, {7: (0.0, 0.0)}), ({1: (0.0, 0.0)}, {}), ({1: (0.0, 0.0)}, {8: (0.0, 0.0)}),
                       ({1: (0.0, 0.0)}, {8: (0.0, 0.0)}))
        self.assertEqual((score.switches, score.misses), (1, 1))
        self.assertEqual(score.numbers, {1: {7, 8}})

    def test_numbers_that_are_exchanged_are_two_switches(self):
        people = {1: (0.0, 0.0), 2: (5.0, 0.0)}
        score = scored((people, {7: (0.0, 0.0), 8: (5.0, 0.0)}), (people, {8: (0.0, 0.0), 7: (5.0, 0.0)}))
        self.assertEqual(score.switches, 2)

    def test_as_many_pairs_as_can_be(self):
        score = scored(({1: (0.0, 0.0), 2: (0.6, 0.0)}, {7: (0.5, 0.0), 8: (1.3, 0.0)}))
        self.assertEqual((score.misses, score.false_positives), (0, 0))


if __name__ == "__main__":
    unittest.main()
