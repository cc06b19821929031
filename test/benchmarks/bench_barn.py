"""Drives every BARN world of a directory through the whole stack, lidar only, and scores it.

Score of a world: reached * OT / clip(time, 2 OT, 8 OT), OT being the world's optimal time; a contact or 100 s end a run with 0.
"""
import glob
import json
import multiprocessing
import os
import statistics

LIMIT_S = 100.0


def add_arguments(parser):
    parser.add_argument("directory", metavar="DIR", help="with barn_*.yaml")
    parser.add_argument("--rate", type=float, default=0.0,
                        help="simulated seconds per second at most; 0: as fast as possible (default)")
    parser.add_argument("--only", default="", metavar="N,N,...", help="numbers of worlds, such as 003,009")
    parser.add_argument("--jobs", type=int, default=1, help="worlds at the same time (default 1)")
    parser.add_argument("--out", default="out/barn", metavar="DIR", help="logs go there (default out/barn)")
    parser.add_argument("--json", metavar="FILE", help="write the rows there")


def score(reached, contacts, time_s, optimal_time_s):
    if not reached or contacts or time_s is None:
        return 0.0
    return optimal_time_s / min(max(time_s, 2.0 * optimal_time_s), 8.0 * optimal_time_s)


def drive_world(job):
    import yaml  # here: the help needs no packages
    from mocha_scripts import drive
    path, rate, out = job
    with open(path) as file:
        world = yaml.safe_load(file)
    name = os.path.splitext(os.path.basename(path))[0]
    names = [robot["name"] for robot in world["robots"]]
    results, why = drive.drive(path, names, os.path.join(out, name), rate=rate, record=False, limit_s=LIMIT_S,
                               stop_at_contact=True)
    robot = results["robots"][0] if results["robots"] else {"reached": False, "contacts": 0, "time_s": None}
    return {"world": name, "reached": robot["reached"], "contacts": robot["contacts"], "time_s": robot["time_s"],
            "score": round(score(robot["reached"], robot["contacts"], robot["time_s"], world["optimal_time"]), 4)}, why


def run(options):
    paths = sorted(glob.glob(os.path.join(options.directory, "barn_*.yaml")))
    if options.only:
        wanted = {f"barn_{number}.yaml" for number in options.only.split(",")}
        paths = [path for path in paths if os.path.basename(path) in wanted]
    if not paths:
        print(f"bench barn: no barn_*.yaml in {options.directory}")
        return 2
    jobs = [(path, options.rate, options.out) for path in paths]
    rows = []
    # A process a world: a ROS node cannot change its master.
    with multiprocessing.get_context("spawn").Pool(options.jobs, maxtasksperchild=1) as pool:
        for row, why in pool.imap(drive_world, jobs):
            rows.append(row)
            time = "-" if row["time_s"] is None else f"{row['time_s']:.2f} s"
            print(f"{row['world']}  {'reached' if row['reached'] else 'failed '}  contacts {row['contacts']}  {time:>8}"
                  f"  score {row['score']:.3f}{'' if row['reached'] else '  ' + why}", flush=True)
    reached = sum(row["reached"] and row["contacts"] == 0 for row in rows)
    summary = {"worlds": len(rows), "reached_without_contact": reached,
               "mean_score": round(statistics.mean(row["score"] for row in rows), 4)}
    print(f"{reached} of {len(rows)} worlds reached without contact, mean score {summary['mean_score']:.4f}")
    if options.json:
        with open(options.json, "w") as file:
            json.dump({"rows": rows, "summary": summary}, file, indent=2)
    return 0
