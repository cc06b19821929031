"""CLEAR MOT: how well tracks follow labelled people, by misses, false positives and switches.

Scan by scan, a track keeps the person that it has as long as it is within reach of it; the tracks and people that are left are paired so that
as many as possible are within reach, and those as near as possible. Reference: Bernardin and Stiefelhagen, Evaluating Multiple Object
Tracking Performance: The CLEAR MOT Metrics, 2008.
"""
import math

import numpy as np
from scipy.optimize import linear_sum_assignment

REACH_M = 0.75


class ClearMot:
    """Adds up scan after scan."""

    def __init__(self):
        self.people = self.misses = self.false_positives = self.switches = 0
        self.distances_m = []
        self.events = []  # (time, kind, number, place)
        self.numbers = {}  # person -> numbers of the tracks that followed it
        self._tracks, self._persons = {}, {}  # who is followed by which, as last seen

    def add(self, people, tracks, time_s=0.0):
        """Places (x, y) by number: of the people labelled in a scan, and of the tracks told then."""
        pairs = self._kept(people, tracks)
        pairs.update(self._paired({person: place for person, place in people.items() if person not in pairs},
                                  {number: place for number, place in tracks.items() if number not in pairs.values()}))
        for person, number in pairs.items():
            if self._tracks.get(person, number) != number or self._persons.get(number, person) != person:
                self.switches += 1
                self.events.append((time_s, "switch", person, people[person]))
        for person, number in pairs.items():
            self._follow(person, number, people[person], tracks[number])
        missed = [person for person in people if person not in pairs]
        alone = [number for number in tracks if number not in pairs.values()]
        self.events += [(time_s, "miss", person, people[person]) for person in missed]
        self.events += [(time_s, "false", number, tracks[number]) for number in alone]
        self.people += len(people)
        self.misses += len(missed)
        self.false_positives += len(alone)

    def _kept(self, people, tracks):
        return {person: self._tracks[person] for person in people if self._tracks.get(person) in tracks
                and math.dist(people[person], tracks[self._tracks[person]]) <= REACH_M}

    @staticmethod
    def _paired(people, tracks):
        persons, numbers = list(people), list(tracks)
        far = 1e3 * REACH_M
        costs = np.array([[math.dist(people[person], tracks[number]) for number in numbers] for person in persons]).reshape(len(persons), len(numbers))
        rows, columns = linear_sum_assignment(np.where(costs <= REACH_M, costs, far))
        return {persons[i]: numbers[j] for i, j in zip(rows, columns) if costs[i, j] <= REACH_M}

    def _follow(self, person, number, place, told):
        self._persons.pop(self._tracks.pop(person, None), None)
        self._tracks.pop(self._persons.pop(number, None), None)
        self._tracks[person], self._persons[number] = number, person
        self.numbers.setdefault(person, set()).add(number)
        self.distances_m.append(math.dist(place, told))

    def summary(self):
        wrong = self.misses + self.false_positives + self.switches
        matches = len(self.distances_m)
        return {"labels": self.people, "misses": self.misses, "false_positives": self.false_positives, "switches": self.switches,
                "mota": round(1.0 - wrong / self.people, 4) if self.people else None,
                "motp_m": round(sum(self.distances_m) / matches, 4) if matches else None}
