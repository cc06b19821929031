"""Drives worlds with movers that heed no robot through the whole stack, lidar only, and says whose the contacts are, and
what can be solved.

`knowing` is when a search in space and time that knows the future can stand at the goal. `seeing` is the same for drives of such searches that know
of each mover only what the robot's lidar has seen so far, search again each half or quarter second, and expect all that they know to go on as it
does; of several, more or less careful, the first to arrive without a contact of its own counts. They have no noise, no delay and the robot's
emergency acceleration. That one arrives proves that it can be done; that none does proves nothing. Times count from the start of the world.
"""
import functools
import glob
import multiprocessing
import multiprocessing.pool
import os
import statistics

from benchmarks import benchmark


def _add_arguments(kind, parser):
    parser.add_argument("directory", metavar="DIR", help=f"with {kind}_*.yaml")
    parser.add_argument("--only", default="", metavar="NAME,...", help=f"worlds, without {kind}_ and .yaml")
    parser.add_argument("--seeds", type=int, default=1, metavar="N", help="drives of each world, seeds from 1 on (default 1)")
    parser.add_argument("--jobs", type=int, default=1, help="drives at the same time (default 1)")
    parser.add_argument("--begin", type=float, default=1.5, metavar="S", help="when a robot can have mapped, planned and promised: searches begin"
                        " then (default 1.5)")
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
    absent = {"reached": False, "contacts": 0, "own_contacts": 0, "time_s": None, "arrival_s": None, "min_clearance_m": None}
    robot = results["robots"][0] if results["robots"] else absent
    return {"world": name, "seed": seed, **{key: robot[key] for key in absent}, "touched": results.get("contacts", []), "why": why}


def solve_world(job):
    """What can be solved: a row of benchmark_movers."""
    program, path, begin_s, limit_s = job
    return benchmark.call(program, begin_s, limit_s, path)["rows"][0]


def solvable(row):
    """What is solved at which level: without a contact of its own, by a search that knows, and by one that sees."""
    return {"knowing": row["knowing_s"] is not None, "seeing": row["seeing_s"] is not None}


def solved(row):
    return row["reached"] and not row["own_contacts"]


def seconds(value):
    return "-" if value is None else f"{value:.2f} s"


def line_of(row):
    from mocha_scripts import referee
    lines = [f"{row['world']} seed {row['seed']}  {'reached' if row['reached'] else 'failed '}  {seconds(row['time_s']):>8}"
             f"  knowing {seconds(row['knowing_s']):>8}  seeing {seconds(row['seeing_s']):>8}  lost {seconds(row['lost_s']):>8}"
             f"  contacts {row['contacts']}, own {row['own_contacts']}{'' if row['reached'] else '  ' + row['why']}"]
    return "\n".join(lines + [f"    {referee.contact_text(touch)}" for touch in row["touched"]])


def _solvable_counts(rows):
    """Of the drives, how many are in worlds that can be solved, and how many of these were."""
    counts = {}
    for level in ("knowing", "seeing"):
        there = [row for row in rows if solvable(row)[level]]
        counts[f"solvable_{level}"] = len(there)
        counts[f"solved_of_{level}"] = sum(map(solved, there))
    return counts


def _name(row):
    return f"{row['world']} seed {row['seed']}"


def failure_lines(rows):
    """Drives that were not solved, by what can be."""
    failed = [row for row in rows if not solved(row)]
    groups = {"solvable on sight, but not solved": [row for row in failed if solvable(row)["seeing"]],
              "solvable only if one knows the future": [row for row in failed if solvable(row)["knowing"] and not solvable(row)["seeing"]],
              "not solvable as far as found": [row for row in failed if not any(solvable(row).values())]}
    return [f"{what}: {', '.join(map(_name, those))}" for what, those in groups.items() if those]


def summarise(rows):
    lost = [row["lost_s"] for row in rows if row["lost_s"] is not None]
    times = [row["time_s"] for row in rows if row["reached"]]
    return {"drives": len(rows), "reached": len(times), "reached_without_contact": sum(row["reached"] and not row["contacts"] for row in rows),
            "drives_with_own_contacts": sum(row["own_contacts"] > 0 for row in rows),
            "drives_with_contacts": sum(row["contacts"] > 0 for row in rows), "contacts": sum(row["contacts"] for row in rows),
            "own_contacts": sum(row["own_contacts"] for row in rows),
            "median_lost_s": round(statistics.median(lost), 2) if lost else None, **_solvable_counts(rows),
            "median_time_s": round(statistics.median(times), 2) if times else None}


def _run(kind, limit_s, options):
    worlds = worlds_of(options.directory, kind, options.only)
    if not worlds:
        print(f"bench {kind}: no such {kind}_*.yaml in {options.directory}")
        return 2
    jobs = [(name, os.path.abspath(path), seed, options.record, options.out, limit_s)
            for name, path in worlds.items() for seed in range(1, options.seeds + 1)]
    program = benchmark.build("movers")
    with multiprocessing.pool.ThreadPool(options.jobs) as pool:
        solutions = dict(zip(worlds, pool.map(solve_world, [(program, os.path.abspath(path), options.begin, limit_s) for path in worlds.values()])))
    rows = []
    # A process a drive: a ROS node cannot change its master.
    with multiprocessing.get_context("spawn").Pool(options.jobs, maxtasksperchild=1) as pool:
        for row in pool.imap(drive_world, jobs):
            row.update({key: solutions[row["world"]][key] for key in ("knowing_s", "seeing_s")})
            both = row["arrival_s"] is not None and row["knowing_s"] is not None
            row["lost_s"] = round(row["arrival_s"] - row["knowing_s"], 2) if both else None
            rows.append(row)
            print(line_of(row), flush=True)
    summary = summarise(rows)
    print(f"{summary['reached_without_contact']} of {summary['drives']} drives reached without contact; {summary['drives_with_contacts']} with"
          f" contacts, {summary['drives_with_own_contacts']} with some of the robot's own")
    print(f"solvable knowing {summary['solvable_knowing']}/{summary['drives']}, solved of these {summary['solved_of_knowing']}; with its view"
          f" {summary['solvable_seeing']}/{summary['drives']}, solved of these {summary['solved_of_seeing']}; median time lost against knowing"
          f" {seconds(summary['median_lost_s'])}")
    print("\n".join(failure_lines(rows)))
    benchmark.write({"rows": rows, "summary": summary}, options.json)
    return 0


def bench(kind, limit_s):
    """What a bench of all worlds of a kind adds as arguments, and runs. Each drive ends where its goal is reached or given up, or after the limit in
    simulated time."""
    return functools.partial(_add_arguments, kind), functools.partial(_run, kind, limit_s)
