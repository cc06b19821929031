"""Local replanning in 200 seeded scenes with movers, in closed loop and with a perfect tracker.

1 to 8 discs of 0.2 to 0.4 m radius at 0.2 to 1.4 m/s cross, come towards or overtake a rover on its drive of 10 to 14 m, in the open and in
corridors; they heed no robot. Those of the group `accelerating` also accelerate, brake or turn, which the predictions do not know. A search
in space and time that has nothing in common with the planner, and knows the future, says which scenes can be solved. Time lost is
against the same drive without movers; planning time is wall time of a step in which the replanner planned locally.
"""
import statistics

from benchmarks import benchmark

SCENES = 200
GROUPS = ("constant_velocity", "accelerating")
KINDS = ("crossing", "head_on", "overtaking", "mixed")


def add_arguments(parser):
    parser.add_argument("--scenes", type=int, default=SCENES, metavar="N", help=f"the first N scenes (default {SCENES})")
    parser.add_argument("--only", default="", metavar="N,N,...", help="numbers of scenes, from 1 on")
    parser.add_argument("--json", metavar="FILE", help="write the rows and the summary there")


def share(rows, key):
    """Of the rows for which key(row) holds."""
    return round(sum(bool(key(row)) for row in rows) / len(rows), 4) if rows else None


def percentile(values, percent):
    """The smallest value that as many percent of all do not exceed."""
    values = sorted(values)
    return round(values[min(len(values) - 1, int(len(values) * percent / 100.0))], 6) if values else None


def succeeded(row):
    return row["reached"] and not row["contact"]


def summarise(rows):
    solvable = [row for row in rows if row["solvable"]]
    lost = [row["time_lost_s"] for row in rows if row["time_lost_s"] is not None]
    plans = [seconds for row in rows for seconds in row["replans_s"]]
    stages = [sum(row[stage] for row in rows) for stage in ("front_end_s", "optimisation_s")]
    return {"scenes": len(rows), "solvable": len(solvable), "success": share(solvable, succeeded),
            "contacts": sum(row["contact"] for row in rows), "not_reached": sum(not row["reached"] for row in rows),
            "min_clearance_m": min((row["min_clearance_m"] for row in rows), default=None),
            "time_lost_s": {"median": percentile(lost, 50), "p90": percentile(lost, 90)},
            "t_plan_s": {"median": percentile(plans, 50), "p99": percentile(plans, 99), "most": percentile(plans, 100)},
            "share_of_front_end": round(stages[0] / sum(stages), 4) if sum(stages) > 0.0 else None,
            "share_of_optimisation": round(stages[1] / sum(stages), 4) if sum(stages) > 0.0 else None,
            "replans_per_scene": round(statistics.mean(row["replans"] for row in rows), 2) if rows else None,
            "replans_taken": round(sum(row["taken"] for row in rows) / max(1, sum(row["replans"] for row in rows)), 4),
            "switches": sum(row["switches"] for row in rows), "would_meet": share(rows, lambda row: row["would_meet"])}


def text(value, width, decimals):
    return f"{'-' if value is None else format(value, f'.{decimals}f'):>{width}}"


def percent(value):
    return None if value is None else 100.0 * value


def print_table(rows):
    print(f"\n{'scenes':32}{'number':>7}{'solvable':>9}{'success':>9}{'contacts':>9}{'stuck':>6}{'least':>9}{'lost':>8}{'lost':>8}"
          f"{'t_plan':>9}{'t_plan':>9}{'switches':>9}")
    print(f"{'':32}{'':7}{'':9}{'[%]':>9}{'':9}{'':6}{'gap [m]':>9}{'50 % [s]':>8}{'90 % [s]':>9}{'50 % [ms]':>10}{'99 %':>7}")
    for group in GROUPS:
        chosen = [row for row in rows if row["group"] == group]
        print_line(group, chosen)
        for kind in KINDS:
            for place in ("open", "corridor"):
                print_line(f"  {kind}, {place}", [row for row in chosen if (row["kind"], row["place"]) == (kind, place)])
    print_line("all", rows)


def print_line(name, rows):
    if not rows:
        return
    found = summarise(rows)
    plan_ms = [None if value is None else 1e3 * value for value in found["t_plan_s"].values()]
    stuck = sum(not row["reached"] and not row["contact"] for row in rows)
    print(f"{name:32}{found['scenes']:7}{found['solvable']:9}{text(percent(found['success']), 9, 1)}{found['contacts']:9}{stuck:6}"
          f"{text(found['min_clearance_m'], 9, 3)}{text(found['time_lost_s']['median'], 8, 2)}{text(found['time_lost_s']['p90'], 8, 2)}"
          f"{text(plan_ms[0], 9, 2)}{text(plan_ms[1], 9, 2)}{found['switches']:9}")


def failures(rows):
    return [row["scene"] for row in rows if row["solvable"] and not succeeded(row)]


def run(options):
    numbers = options.only.split(",") if options.only else range(1, options.scenes + 1)
    rows = benchmark.run("replan", *numbers)["rows"]
    summary = {**summarise(rows), "groups": {group: summarise([row for row in rows if row["group"] == group]) for group in GROUPS},
               "failures": failures(rows)}
    print_table(rows)
    print(f"\nwithout avoidance, {percent(summary['would_meet']):.0f} % of the drives would have ended in contact")
    print(f"{summary['replans_per_scene']:.1f} local plans a scene, {percent(summary['replans_taken']):.0f} % of them taken")
    if summary["failures"]:
        print(f"solvable, but not solved: {', '.join(map(str, summary['failures']))}")
    benchmark.write({"rows": rows, "summary": summary}, options.json)
    return 0
