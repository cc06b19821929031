"""Robots leave where they stand: models beside a wall, in a corner and in dead ends, at many gaps and headings.

Through the whole stack of one robot in simulated time: a simulated lidar with the model's field of view and noise, the map that perception
makes of its scans, both planners, promises, tracker and wheels. Of the world the robot knows what its lidar has seen, and where it is. It
stands at rest so many metres (true body to true wall) from the wall, and from the second wall of a corner; a dead end is a slot
around the whole body that is wider by twice that, nose in and nose out. The goal is 3 m off in the open. It has left if it stands at the
goal within 60 s without having touched anything; one that stands for 10 s has failed. Who can leave at all is found by a flood on the
exact body and the exact walls, which shares nothing with the planner's search. `own` is a rover whose body is 0.9 x 0.6 m.
"""
import collections
import concurrent.futures
import os
import statistics

from benchmarks import benchmark

MODELS = ("jackal", "waveshare_rover", "own")
PLACES = ("wall", "corner", "dead_end")
GAPS_M = (0.02, 0.05, 0.1, 0.15, 0.2, 0.3)
DEAD_END_GAPS_M = (0.05, 0.1)
HEADINGS = 24


def add_arguments(parser):
    parser.add_argument("--models", default=",".join(MODELS), metavar="NAME,...", help=f"(default {','.join(MODELS)})")
    parser.add_argument("--places", default=",".join(PLACES), metavar="NAME,...", help=f"(default {','.join(PLACES)})")
    parser.add_argument("--gaps", default=",".join(map(str, GAPS_M)), metavar="METRES,...",
                        help=f"(default {','.join(map(str, GAPS_M))}; of these, dead ends have {' and '.join(map(str, DEAD_END_GAPS_M))})")
    parser.add_argument("--headings", type=int, default=HEADINGS, metavar="N", help=f"spread evenly (default {HEADINGS})")
    parser.add_argument("--processes", type=int, default=2, metavar="N", help="beside each other (default 2)")
    parser.add_argument("--json", metavar="FILE", help="write the rows and the summary there")


def jobs_of(options):
    """(model, place, gap)"""
    for model in options.models.split(","):
        for place in options.places.split(","):
            for gap in map(float, options.gaps.split(",")):
                if place != "dead_end" or gap in DEAD_END_GAPS_M:
                    yield model, place, gap


def drive_all(options):
    program = benchmark.build("leaving")
    with concurrent.futures.ThreadPoolExecutor(options.processes) as pool:
        started = [(job, pool.submit(benchmark.call, program, *job, options.headings)) for job in jobs_of(options)]
        return [{"model": model, "place": place, "gap_m": gap, **row} for (model, place, gap), each in started for row in each.result()["rows"]]


def median(values):
    return statistics.median(values) if values else None


def summarise(rows):
    can = [row for row in rows if row["can_leave"]]
    left = [row for row in can if row["left"]]
    return {"starts": len(rows), "can_leave": len(can), "left": len(left), "contacts": sum(row.get("contact", False) for row in rows),
            "left_s": median([row["left_s"] for row in left]), "took_s": median([row["took_s"] for row in left]),
            "slowest_took_s": max((row["took_s"] for row in left), default=None),
            "min_clearance_m": min((row["clearance_m"] for row in can), default=None),
            "slowest_plan_s": max((row["slowest_plan_s"] for row in can), default=None)}


def failures(rows):
    return [row for row in rows if row["can_leave"] and not row["left"]]


def kind_of(row):
    """What went wrong, in the stack's words without its numbers."""
    if row["contact"]:
        return "touched a wall"
    words = row["words"].split(", from")[0].split(" from (")[0]
    for number in "0123456789.-":
        words = words.replace(number, "")
    where = "never moved" if row["left_s"] is None else "left, did not arrive"
    return f"{where}: {' '.join(words.split())}"


def text(value, width, decimals):
    return f"{'-' if value is None else format(value, f'.{decimals}f'):>{width}}"


def print_line(name, rows, gaps):
    cells = [summarise([row for row in rows if row["gap_m"] == gap]) for gap in gaps]
    shares = [f"{cell['left']}/{cell['can_leave']}" if cell["starts"] else "-" for cell in cells]
    found = summarise(rows)
    share = 100.0 * found["left"] / found["can_leave"] if found["can_leave"] else None
    print(f"{name:28}" + "".join(f"{share:>8}" for share in shares) + text(share, 7, 0) + text(found["left_s"], 10, 1)
          + text(found["took_s"], 10, 1) + text(found["slowest_took_s"], 9, 1) + f"{found['contacts']:10}")


def print_table(rows, gaps):
    print(f"\n{'left / can leave, by gap':28}" + "".join(f"{gap:>6} m" for gap in gaps) + f"{'left':>7}{'away':>10}{'there':>10}{'slowest':>9}{'contacts':>10}")
    print(" " * (28 + 8 * len(gaps)) + f"{'[%]':>7}{'50 % [s]':>10}{'50 % [s]':>10}{'[s]':>9}")
    for model, place in dict.fromkeys((row["model"], row["place"]) for row in rows):
        print_line(f"{model}, {place}", [row for row in rows if (row["model"], row["place"]) == (model, place)], gaps)


def print_failures(rows):
    if not rows:
        return
    print("\nwhere robots did not leave that can")
    for kind, count in collections.Counter(map(kind_of, rows)).most_common():
        print(f"{count:6}  {kind}")
    print()
    for row in rows:
        print(f"  {row['model']}, {row['place']}, {row['gap_m']} m, {row['heading_deg']:.0f} degrees, {row['took_s']:.1f} s, clearance "
              f"{row['clearance_m']:.3f} m: {'contact; ' if row['contact'] else ''}{row['words']}")


def run(options):
    rows = drive_all(options)
    summary = {**summarise(rows), "failures": dict(collections.Counter(map(kind_of, failures(rows))))}
    print_table(rows, sorted({row["gap_m"] for row in rows}))
    print_failures(failures(rows))
    print(f"\n{summary['left']} of {summary['can_leave']} that can have left, contacts: {summary['contacts']}; "
          f"the slowest plan took {text(summary['slowest_plan_s'], 0, 2)} s of wall time")
    benchmark.write({"rows": rows, "summary": summary}, options.json)
    return 0
