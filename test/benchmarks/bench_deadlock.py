"""Robots that want to go through the same narrow places in opposite directions: all are to arrive.

Head-on in a corridor as wide as one robot, without a passing place and with one; one against two behind each other; a dead end, out of
which one wants and into which another; two against two; four that swap corners; ten through a door; three puzzles in cells of 1.2 m. All
planners in one process, in simulated time, each robot knows the map, and messages take up to 30 ms and get lost by 5 %. Separation is
centre to centre, footprints have a radius of 0.3 m. The time of a puzzle is also told in those of its quickest plan, driven at full speed
without a stop; so is that of other worlds with --cells. That through a door is told in those of the door's capacity (door_capacity.py).
"""
import concurrent.futures
import os
import statistics

from benchmarks import benchmark, cell_optimum, door_capacity

WORLDS = ("config/worlds/narrow_corridor.yaml", "config/worlds/passing_place.yaml", "test/worlds/two_behind_each_other.yaml",
          "test/worlds/dead_end_for_two.yaml", "test/worlds/two_against_two.yaml", "config/worlds/four_corners.yaml",
          "config/worlds/ten_through_a_door.yaml", "test/worlds/puzzle_siding.yaml", "test/worlds/puzzle_crossroads.yaml",
          "test/worlds/puzzle_comb.yaml")
DOORS = {"ten_through_a_door": (0.0, 0.0)}  # that all have to pass [m]
RUNS = 10


def add_arguments(parser):
    parser.add_argument("--runs", type=int, default=RUNS, metavar="N", help=f"seeded runs in each world (default {RUNS})")
    parser.add_argument("--world", action="append", metavar="FILE", help="only this one, or another world file")
    parser.add_argument("--cells", action="store_true", help="the worlds are puzzles in cells of 1.2 m")
    parser.add_argument("--json", metavar="FILE", help="write the rows and the summary there")


def name_of(world):
    return os.path.splitext(os.path.basename(world))[0]


def is_puzzle(world):
    return name_of(world).startswith("puzzle_")


def least_time_s(world, cells, pace):
    """Of the quickest plan, or by the capacity of the door; None where neither is known."""
    path = os.path.join(benchmark.ROOT, world)
    if cells or is_puzzle(world):
        return cell_optimum.least_time_s(path)
    if name_of(world) in DOORS:
        return door_capacity.least_time_s(path, DOORS[name_of(world)], pace)
    return None


def summarise(rows):
    return {"runs": len(rows), "all_reached": sum(row["all_reached"] for row in rows), "contacts": sum(row["contacts"] for row in rows),
            "min_separation_m": min(row["min_separation_m"] for row in rows),
            "time_s": statistics.median(row["time_s"] for row in rows), "slowest_s": max(row["time_s"] for row in rows)}


def run(options):
    worlds = [os.path.abspath(world) for world in options.world] if options.world else WORLDS
    program = benchmark.build("deadlock")
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        jobs = [(world, pool.submit(benchmark.call, program, world, 1, options.runs))
                for world in worlds]
        rows = [{"world": name_of(world), **row} for world, job in jobs for row in job.result()["rows"]]
        pace = {world: job.result()["pace"] for world, job in jobs}
    print(f"\n{'world':24}{'runs':>6}{'all arrive':>12}{'contacts':>10}{'least sep. [m]':>16}{'time 50 % [s]':>15}{'slowest [s]':>13}"
          f"{'optimum [s]':>13}{'slowest of it':>15}")
    found = {name_of(world): summarise([row for row in rows if row["world"] == name_of(world)]) for world in worlds}
    for world in worlds:
        found[name_of(world)]["optimum_s"] = least_time_s(world, options.cells, pace[world])
    for name, each in found.items():
        optimum_s = each["optimum_s"]
        ratio = f"{optimum_s:13.1f}{each['slowest_s'] / optimum_s:15.2f}" if optimum_s else ""
        print(f"{name:24}{each['runs']:6}{each['all_reached']:12}{each['contacts']:10}{each['min_separation_m']:16.3f}"
              f"{each['time_s']:15.1f}{each['slowest_s']:13.1f}{ratio}")
    summary = {**summarise(rows), "worlds": found}
    print(f"\nall arrived in {summary['all_reached']} of {summary['runs']} runs, contacts: {summary['contacts']}")
    benchmark.write({"rows": rows, "summary": summary}, options.json)
    return 0
