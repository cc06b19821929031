"""Drives seeded halls with three people each through the whole stack, lidar only, and the same halls empty.

The people cross, come towards the rover or walk ahead of it at 0.4 to 1.2 m/s, there and back, and heed no robot. A contact or 120 s end a
run. The lost share is the time with people over the time without, less one.
"""
import json
import multiprocessing
import os
import statistics

LIMIT_S = 120.0


def add_arguments(parser):
    parser.add_argument("--runs", type=int, default=20, metavar="N", help="halls, seeds from 1 on (default 20)")
    parser.add_argument("--turn", type=float, default=0.0, metavar="S", help="so long people stand where they turn round (default 0)")
    parser.add_argument("--rate", type=float, default=0.0,
                        help="simulated seconds per second at most; 0: as fast as possible (default)")
    parser.add_argument("--jobs", type=int, default=1, help="drives at the same time (default 1)")
    parser.add_argument("--out", default="out/crossing", metavar="DIR", help="worlds and logs go there (default out/crossing)")
    parser.add_argument("--json", metavar="FILE", help="write the rows and the summary there")


def drive_world(job):
    from mocha_scripts import drive  # here: the help needs no packages
    path, rate = job
    results, why = drive.drive(path, ["ugv1"], os.path.splitext(path)[0], rate=rate, record=False, limit_s=LIMIT_S, stop_at_contact=True)
    robot = results["robots"][0] if results["robots"] else {"reached": False, "contacts": 0, "time_s": None}
    return {key: robot[key] for key in ("reached", "contacts", "time_s")}, why


def write_worlds(seed, out, turn_s=0.0):
    """The hall with people and the same without."""
    import yaml
    from benchmarks.crossing_worlds import crossing_world
    world = crossing_world(seed, turn_s)
    paths = [os.path.join(out, f"crossing_{seed:03}{kind}.yaml") for kind in ("", "_empty")]
    for path, content in zip(paths, (world, {key: value for key, value in world.items() if key != "moving"})):
        with open(path, "w") as file:
            yaml.safe_dump(content, file, default_flow_style=None, sort_keys=False)
    return paths


def row_of(seed, path, crowded, empty):
    lost = crowded["time_s"] / empty["time_s"] - 1.0 if crowded["reached"] and empty["reached"] else None
    return {"world": os.path.splitext(os.path.basename(path))[0], "seed": seed, **crowded, "empty_time_s": empty["time_s"],
            "lost_share": None if lost is None else round(lost, 4)}


def shown(value, unit):
    return "-" if value is None else f"{value:.2f}{unit}"


def run(options):
    os.makedirs(options.out, exist_ok=True)
    seeds = range(1, options.runs + 1)
    paths = [path for seed in seeds for path in write_worlds(seed, options.out, options.turn)]
    rows = []
    # A process a drive: a ROS node cannot change its master.
    with multiprocessing.get_context("spawn").Pool(options.jobs, maxtasksperchild=1) as pool:
        driven = pool.imap(drive_world, [(path, options.rate) for path in paths])
        for seed, path in zip(seeds, paths[::2]):
            (crowded, why), (empty, _) = next(driven), next(driven)
            row = row_of(seed, path, crowded, empty)
            rows.append(row)
            print(f"{row['world']}  {'reached' if row['reached'] else 'failed '}  contacts {row['contacts']}"
                  f"  {shown(row['time_s'], ' s'):>8}  empty {shown(row['empty_time_s'], ' s'):>8}  lost share {shown(row['lost_share'], ''):>5}"
                  f"{'' if row['reached'] else '  ' + why}", flush=True)
    lost = [row["lost_share"] for row in rows if row["lost_share"] is not None]
    summary = {"worlds": len(rows), "reached_without_contact": sum(row["reached"] and row["contacts"] == 0 for row in rows),
               "contacts": sum(row["contacts"] for row in rows),
               "median_lost_share": round(statistics.median(lost), 4) if lost else None}
    print(f"{summary['reached_without_contact']} of {len(rows)} halls crossed without contact, {summary['contacts']} contacts,"
          f" median lost share {shown(summary['median_lost_share'], '')}")
    if options.json:
        with open(options.json, "w") as file:
            json.dump({"rows": rows, "summary": summary}, file, indent=2)
    return 0
