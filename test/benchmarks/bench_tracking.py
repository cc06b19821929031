"""How well perception's tracks follow the labelled people of a bag: CLEAR MOT.

Runs perception over the laser scans of a bag in one process, and holds every mover that it tells (`obstacles` of `predicted_obstacles`) against the labels:
geometry_msgs/PoseStamped with the stamp and frame of a scan, and the person's number in header.seq. Both are looked at where the labels' authors
looked: between two bearings of the lidar (--sector), in every scan of the bag, so that what is told where nobody is labelled counts as false.
A person and a thing belong together within 0.75 m. The first row is everything told, as hard as that; a row below it leaves out what its name
says: people are labelled only where their legs are hit, so a thing told while they are hidden counts as false in the first row.
`numbers` is how many numbers of tracks a labelled person went through, for each minute from its first label to its last.
"""
import bisect
import math
import os

from benchmarks import benchmark, tracks_plots
from benchmarks.clear_mot import REACH_M, ClearMot

SECTOR_DEG = (-80.0, 12.0)
LONGEST_GAP_S = 1.5  # between two labels of a person that is hidden meanwhile


def add_arguments(parser):
    parser.add_argument("bag", help="bag with sensor_msgs/LaserScan, transforms and labels")
    parser.add_argument("--map-frame", default="odom", metavar="FRAME", help="in which things are told (default odom)")
    parser.add_argument("--sector", type=float, nargs=2, default=SECTOR_DEG, metavar=("FROM", "TO"),
                        help="bearings of the lidar that are looked at [deg] (default %(default)s)")
    parser.add_argument("--plot", metavar="FILE", help="draw the tracks and the people there")
    parser.add_argument("--json", metavar="FILE", help="write the rows and every error there")


def people_of(scan, sector_rad):
    """Number -> (place, time)."""
    return {int(number): ((x, y), time_s) for number, x, y, time_s, bearing_rad in scan["labels"] if sector_rad[0] <= bearing_rad <= sector_rad[1]}


def things_of(scan, sector_rad, time_s):
    """Number -> (place at that time, seen in this scan)."""
    things = {}
    sensor_x, sensor_y, yaw_rad = scan["sensor"]
    for number, x, y, vx, vy, _, seen in scan["things"]:
        bearing_rad = math.remainder(math.atan2(y - sensor_y, x - sensor_x) - yaw_rad, 2.0 * math.pi)
        if sector_rad[0] <= bearing_rad <= sector_rad[1]:
            since_s = time_s - scan["time_s"]
            things[int(number)] = ((x + since_s * vx, y + since_s * vy), seen)
    return things


def labelled_places(scans):
    """Person -> [(time, place)] of all labels, in order of time."""
    places = {}
    for scan in scans:
        for number, x, y, time_s, _ in scan["labels"]:
            places.setdefault(int(number), []).append((time_s, (x, y)))
    return places


def between(labels, time_s):
    """Where a person is between two of its labels that are not far apart in time; else nothing."""
    k = bisect.bisect([label[0] for label in labels], time_s)
    if k in (0, len(labels)):
        return None
    (before_s, before), (after_s, after) = labels[k - 1], labels[k]
    if after_s - before_s > LONGEST_GAP_S:
        return None
    share = (time_s - before_s) / (after_s - before_s)
    return tuple(a + share * (b - a) for a, b in zip(before, after))


def judge(scans, sector_rad, without_hidden_things=False, without_hidden_people=False, without_unlabelled_scans=False):
    score = ClearMot()
    everywhere = labelled_places(scans)
    for scan in scans:
        people = people_of(scan, sector_rad)
        if without_unlabelled_scans and not people:
            continue
        time_s = next((label_s for _, label_s in people.values()), scan["time_s"])
        things = things_of(scan, sector_rad, time_s)
        if without_hidden_things:
            things = {number: thing for number, thing in things.items() if thing[1]}
        if without_hidden_people:
            hidden = [between(labels, scan["time_s"]) for person, labels in everywhere.items()
                      if person not in [int(label[0]) for label in scan["labels"]]]
            shown = [place for place, _ in people.values()]
            things = {number: thing for number, thing in things.items()
                      if not any(place and math.dist(place, thing[0]) <= REACH_M for place in hidden)
                      or any(math.dist(place, thing[0]) <= REACH_M for place in shown)}
        score.add({number: place for number, (place, _) in people.items()}, {number: place for number, (place, _) in things.items()}, scan["time_s"])
    return score


def numbers_per_minute(score, scans):
    minutes = sum(labels[-1][0] - labels[0][0] for person, labels in labelled_places(scans).items() if person in score.numbers) / 60.0
    return round(sum(len(numbers) for numbers in score.numbers.values()) / minutes, 1) if minutes > 0.0 else None


def run(options):
    result = benchmark.run("tracks", os.path.abspath(options.bag), options.map_frame)
    scans = result["scans"]
    sector_rad = [math.radians(angle) for angle in options.sector]
    kinds = {"all that is told": {}, "without things not seen in the scan": {"without_hidden_things": True},
             f"without people hidden up to {LONGEST_GAP_S:g} s": {"without_hidden_people": True},
             "without scans that have no label": {"without_unlabelled_scans": True}}
    print(f"{'':40}{'labels':>7}{'misses':>8}{'false':>7}{'switches':>10}{'MOTA':>9}{'MOTP [m]':>10}{'numbers/min':>13}")
    rows, events = [], []
    for name, rules in kinds.items():
        score = judge(scans, sector_rad, **rules)
        row = {"kind": name, **score.summary(), "numbers_per_minute": numbers_per_minute(score, scans)}
        mota = "-" if row["mota"] is None else f"{row['mota']:.1%}"
        motp = "-" if row["motp_m"] is None else f"{row['motp_m']:.3f}"
        print(f"{name:40}{row['labels']:7}{row['misses']:8}{row['false_positives']:7}{row['switches']:10}{mota:>9}{motp:>10}"
              f"{row['numbers_per_minute'] or '-':>13}")
        rows.append(row)
        events = events or score.events
    if options.plot:
        tracks_plots.draw(result, options.plot)
    benchmark.write({"rows": rows, "errors": events}, options.json)
    return 0
