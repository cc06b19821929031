"""The paper's Table III: five agents that start close together drive to goals of their own through clutter.

All planners of all agents run in one process, in simulated time, and settle their promises over a network that delays messages by up to
10 ms. t_plan is the wall time of a global plan (all paths optimised in parallel), in the median; paths is the most that were optimised for
one plan; D_min is the smallest distance to any other agent, centre to centre, on the whole drive.
"""
import statistics

from benchmarks import benchmark

SCENES = 5
SAFETY_DISTANCE_M = 0.8  # of the paper: two radii and 0.2 m


def add_arguments(parser):
    parser.add_argument("--scenes", type=int, default=SCENES, metavar="N", help=f"the first N seeded scenes (default {SCENES})")
    parser.add_argument("--only", default="", metavar="N,N,...", help="seeds of scenes, from 1 on")
    parser.add_argument("--json", metavar="FILE", help="write the rows and the summary there")


def summarise(rows, contacts):
    return {"scenes": len({row["seed"] for row in rows}), "reached": sum(row["reached"] for row in rows), "agents": len(rows),
            "t_plan_s": statistics.median(row["t_plan_s"] for row in rows), "d_min_m": min(row["d_min_m"] for row in rows),
            "safety_distance_m": SAFETY_DISTANCE_M, "contacts": contacts, "leases_lost": sum(row["leases_lost"] for row in rows)}


def print_table(rows):
    print(f"\n{'scene':>5}{'start':>8}{'t_plan [s]':>12}{'N (paths)':>11}{'D_min [m]':>11}{'reached':>9}{'time [s]':>10}")
    for row in rows:
        print(f"{row['seed']:5}{row['agent']:>8}{row['t_plan_s']:12.4f}{row['paths']:11}{row['d_min_m']:11.3f}"
              f"{'yes' if row['reached'] else 'NO':>9}{row['time_s']:10.1f}")


def run(options):
    found = benchmark.run("table3", *(options.only.split(",") if options.only else range(1, options.scenes + 1)))
    rows = found["rows"]
    summary = summarise(rows, found["contacts"])
    print_table(rows)
    print(f"\n{summary['reached']} of {summary['agents']} agents reached their goals; smallest separation {summary['d_min_m']:.3f} m"
          f" (the paper's safety distance: {SAFETY_DISTANCE_M} m), contacts: {summary['contacts']}; a plan in"
          f" {1e3 * summary['t_plan_s']:.0f} ms in the median")
    benchmark.write({"rows": rows, "summary": summary}, options.json)
    return 0
