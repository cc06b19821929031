"""Plans through seeded maps of buildings: rooms, corridors with rooms, halls of pillars, mazes and clutter, from 30 to 200 m a side, cells of 5 cm; and the
given lidar logs of buildings (../shared/data, or MOCHA_DATA) turned into maps, from where each begins to its farthest place.

A rover goes from corner to corner: first from rest; then again while it drives the plan (4 s under way); then with what is narrowest on its
way shut; then to a goal that is walled in. t_map is what a new map costs before a plan: two distance fields in the first case, then their repair;
in replan, after some cells of the walls within 12 m have changed. t_plan is the whole plan with all classes, with the skeleton of the whole map in
the first case, its repair later; A* the shortest path on the same map for the robot's disc and margin alone; BIT* the first solution of OMPL's, simplified, for the same (none within 5 s: not counted). T/shortest is the duration over that
path's length at top speed.
"""
import statistics

from benchmarks import benchmark, lidar_logs

KINDS = ("rooms", "corridors", "pillars", "maze", "clutter", "logs")
SIDES_M = (30, 100, 200)
CASES = ("first", "replan", "door_closed", "unreachable")


def add_arguments(parser):
    parser.add_argument("--kinds", default=",".join(KINDS), metavar="NAME,...", help=f"(default {','.join(KINDS)})")
    parser.add_argument("--sides", default=",".join(map(str, SIDES_M)), metavar="METRES,...", help=f"(default {','.join(map(str, SIDES_M))})")
    parser.add_argument("--seeds", type=int, default=1, metavar="N", help="maps of each kind and side (default 1)")
    parser.add_argument("--json", metavar="FILE", help="write the rows there")


def median(rows, key):
    values = [row[key] for row in rows if key in row]
    return statistics.median(values) if values else None


def text(value, factor, width, decimals):
    return f"{'-' if value is None else format(factor * value, f'.{decimals}f'):>{width}}"


def print_table(rows):
    print(f"{'medians':34}{'t_map [ms]':>11}{'t_plan [ms]':>12}{'A* [ms]':>9}{'BIT* [ms]':>10}{'classes':>9}{'T [s]':>8}{'T/shortest':>12}  solved")
    for name, side, case in dict.fromkeys((row["map"], row["side_m"], row["case"]) for row in rows):
        some = [row for row in rows if (row["map"], row["side_m"], row["case"]) == (name, side, case)]
        solved = sum(row["reason"] == "solved" for row in some)
        print(f"{f'{name}, {side:.0f} m, {case}':34}{text(median(some, 't_map_s'), 1e3, 11, 1)}{text(median(some, 't_plan_s'), 1e3, 12, 1)}"
              f"{text(median(some, 't_astar_s'), 1e3, 9, 1)}{text(median(some, 't_bitstar_s'), 1e3, 10, 1)}{text(median(some, 'classes'), 1, 9, 0)}{text(median(some, 'T_s'), 1, 8, 1)}"
              f"{text(median(some, 'T_over_shortest'), 1, 12, 3)}  {solved}/{len(some)}")


def print_summary(rows):
    print()
    for case in CASES:
        times = [row["t_plan_s"] for row in rows if row["case"] == case]
        if times:
            print(f"{case:12} median {1e3 * statistics.median(times):8.1f} ms, longest {1e3 * max(times):8.1f} ms")


def rows_of_logs(program):
    """Of each log that is there."""
    rows = []
    try:
        for name, log in lidar_logs.each(lidar_logs.given_folder()):
            found = benchmark.call(program, "log", log)["rows"]
            rows += [{**row, "map": name, "side_m": 0.05 * row["cells"] ** 0.5} for row in found]
    except lidar_logs.NoLogs as none:
        print(f"{none}: left out")
    return rows


def run(options):
    program = benchmark.build("maps")
    rows = []
    for side in map(float, options.sides.split(",")):
        for kind in [kind for kind in options.kinds.split(",") if kind != "logs"]:
            for seed in range(1, options.seeds + 1):
                found = benchmark.call(program, kind, side, seed)["rows"]
                rows += [{**row, "side_m": side, "seed": seed} for row in found]
    if "logs" in options.kinds.split(","):
        rows += rows_of_logs(program)
    print_table(rows)
    print_summary(rows)
    benchmark.write({"rows": rows}, options.json)
    return 0
