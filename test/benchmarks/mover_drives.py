"""Drives worlds with movers that heed no robot through the whole stack, lidar only, and says whose the contacts are."""
import functools
import glob
import multiprocessing
import os
import statistics

from benchmarks import benchmark


def _add_arguments(kind, parser):
    parser.add_argument("directory", metavar="DIR", help=f"with {kind}_*.yaml")
    parser.add_argument("--only", default="", metavar="NAME,...", help=f"worlds, without {kind}_ and .yaml")
    parser.add_argument("--seeds", type=int, default=1, metavar="N", help="drives of each world, seeds from 1 on (default 1)")
    parser.add_argument("--jobs", type=int, default=1, help="drives at the same time (default 1)")
    parser.add_argument("--record", action="store_true", help="record a rosbag of each drive")
    parser.add_argument("--out", default=f"out/{kind}", metavar="DIR", help=f"logs go there (default out/{kind})")
    parser.add_argument("--json", metavar="FILE", help="write the rows and the summary there")


def worlds_of(directory, kind, only):
    """name -> path"""
    paths = {os.path.splitext(os.path.basename(path))[0]: path for path in sorted(glob.glob(os.path.join(directory, f"{kind}_*.yaml")))}
    wanted = {f"{kind}_{name}" for name in only.split(",")} if only else set(paths)
    return {name: path for name, path in paths.items() if name in wanted}


def drive_world(job):
    """A row for one drive."""
    from mocha_scripts import drive  # here: the help needs no packages
    name, path, seed, record, out, limit_s = job
    folder = os.path.join(out, f"{name}_{seed}")
    results, why = drive.drive(path, ["ugv1"], folder, rate=0.0, seed=seed, record=record, limit_s=limit_s)
    absent = {"reached": False, "contacts": 0, "own_contacts": 0, "time_s": None, "min_clearance_m": None}
    robot = results["robots"][0] if results["robots"] else absent
    return {"world": name, "seed": seed, **{key: robot[key] for key in absent}, "touched": results.get("contacts", []), "why": why}


def line_of(row):
    from mocha_scripts import referee
    time = "-" if row["time_s"] is None else f"{row['time_s']:.2f} s"
    lines = [f"{row['world']} seed {row['seed']}  {'reached' if row['reached'] else 'failed '}  {time:>8}  contacts {row['contacts']},"
             f" own {row['own_contacts']}{'' if row['reached'] else '  ' + row['why']}"]
    return "\n".join(lines + [f"    {referee.contact_text(touch)}" for touch in row["touched"]])


def summarise(rows):
    times = [row["time_s"] for row in rows if row["reached"]]
    return {"drives": len(rows), "reached": len(times), "reached_without_contact": sum(row["reached"] and not row["contacts"] for row in rows),
            "drives_with_own_contacts": sum(row["own_contacts"] > 0 for row in rows),
            "drives_with_contacts": sum(row["contacts"] > 0 for row in rows), "contacts": sum(row["contacts"] for row in rows),
            "own_contacts": sum(row["own_contacts"] for row in rows),
            "median_time_s": round(statistics.median(times), 2) if times else None}


def _run(kind, limit_s, options):
    worlds = worlds_of(options.directory, kind, options.only)
    if not worlds:
        print(f"bench {kind}: no such {kind}_*.yaml in {options.directory}")
        return 2
    jobs = [(name, os.path.abspath(path), seed, options.record, options.out, limit_s)
            for name, path in worlds.items() for seed in range(1, options.seeds + 1)]
    rows = []
    # A process a drive: a ROS node cannot change its master.
    with multiprocessing.get_context("spawn").Pool(options.jobs, maxtasksperchild=1) as pool:
        for row in pool.imap(drive_world, jobs):
            rows.append(row)
            print(line_of(row), flush=True)
    summary = summarise(rows)
    print(f"{summary['reached_without_contact']} of {summary['drives']} drives reached without contact; {summary['drives_with_contacts']} with"
          f" contacts, {summary['drives_with_own_contacts']} with some of the robot's own")
    benchmark.write({"rows": rows, "summary": summary}, options.json)
    return 0


def bench(kind, limit_s):
    """What a bench of all worlds of a kind adds as arguments, and runs. Each drive ends where its goal is reached or given up, or after the limit in
    simulated time."""
    return functools.partial(_add_arguments, kind), functools.partial(_run, kind, limit_s)
