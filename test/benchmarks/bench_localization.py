"""A robot that finds out where it is in a saved map: how far off it is, and how long it takes.

With --logs, maps of lidar logs instead. Else
drives by lidar and drifting odometry through worlds of which a map was made in another drive; nothing tells the robot where it begins.
Then once more each, carried 5 m away on the way without any odometry. Figures of poses are taken while the robot is localised;
`found` counts from the first scan, or from the carrying. A scan's time is that of one core.
"""
import concurrent.futures
import os
import statistics

from benchmarks import benchmark, lidar_logs

RUNS = 5
CORRIDOR = ("0,0 3.4,1.5 5,0 7.2,1.1 9,0.1 10.7,1.3 12.8,0 14.6,0.9 17,0.6 18.5,1.2 18.5,-1.2 17,0 14.6,-1.3 12.6,-0.2 11,-1.1 9,0 "
            "7.2,-1.2 5,-0.1 3,-1 0,0").split()
HALL = "-3.5,0 0,0 3.5,0.5 0,3.5 -3.8,2.5 -3.8,-3.5 0,-3.5 0,0".split()
STREET = "1.5,0.9 18.5,0.9 10,0.9 18.5,0.9 1.5,0.9".split()
SCENES = [("corridor", "config/worlds/corridor.yaml", "rover", CORRIDOR),
          ("corridor", "config/worlds/corridor_rovers.yaml", "waveshare_rover", CORRIDOR),
          ("street", "config/worlds/head_on.yaml", "rover", STREET),
          ("hall", "test/worlds/crossing_rovers.yaml", "waveshare_rover", HALL)]


def add_arguments(parser):
    lidar_logs.add_argument(parser, "in maps of lidar logs in CARMEN's format, made at the poses of one part of their scans, by the other part:")
    parser.add_argument("--runs", type=int, default=RUNS, metavar="N", help=f"seeded drives in each world (default {RUNS})")
    parser.add_argument("--json", metavar="FILE", help="write the rows and the summary there")


def summarise(rows):
    return {"runs": len(rows), "found": sum(row["found_s"] >= 0.0 for row in rows), "median_m": statistics.median(row["median_m"] for row in rows),
            "worst_m": max(row["worst_m"] for row in rows), "median_deg": statistics.median(row["median_deg"] for row in rows),
            "worst_deg": max(row["worst_deg"] for row in rows), "found_s": max(row["found_s"] for row in rows),
            "wrong_s": max(row["wrong_s"] for row in rows), "scan_ms": statistics.median(row["scan_ms"] for row in rows),
            "longest_ms": max(row["longest_ms"] for row in rows)}


def summary_of(searches):
    """Where one scan tells the place, how many were found; of all, how many were taken for elsewhere, for how long at most; the time."""
    telling = [search for search in searches if search["tells"]]
    found = [search for search in telling if search["scans"] > 0]
    return {"places": len(searches), "telling": len(telling), "found": len(found), "wrong": sum(search["wrong"] for search in searches),
            "wrong_s": max((search["wrong_s"] for search in searches), default=0.0),
            "found_s": statistics.median(search["s"] for search in found) if found else None}


def words_of(summary):
    found_s = float("nan") if summary["found_s"] is None else summary["found_s"]
    return f"{summary['found']:9} of {summary['telling']:<3}{found_s:6.1f}{summary['wrong']:7}{summary['wrong_s']:7.1f}"


def run_on_logs(options):
    program = benchmark.build("localization_logs")
    print(f"{'':20}{'error [m]':^24}{'error [deg]':^21}{'localised':>11}{'wrong':>8}{'a scan':>8}{'longest':>9}"
          f"  {'found from nothing':^32}  {'found after being carried':^32}")
    print(f"{'log':14}{'part':6}{'median':>8}{'95 %':>8}{'worst':>8}{'median':>7}{'95 %':>7}{'worst':>7}{'[%]':>11}{'[%]':>8}{'[ms]':>8}{'[ms]':>9}"
          + 2 * f"  {'of telling':>15}{'[s]':>4}{'wrong':>7}{'for':>5} s")
    rows = []
    for name, log in lidar_logs.each(options.logs):
        for part in ("rest", "odd"):
            row = {"log": name, "part": part, **benchmark.call(program, log, 1, part)}
            row.update({kind: summary_of(row[kind]) for kind in ("searches", "carries")})
            rows.append(row)
            print(f"{name:14}{part:6}{row['median_m']:8.3f}{row['p95_m']:8.3f}{row['worst_m']:8.2f}{row['median_deg']:7.2f}{row['p95_deg']:7.2f}"
                  f"{row['worst_deg']:7.1f}{100 * row['localized']:11.1f}{100 * row['wrong']:8.2f}{row['scan_ms']:8.2f}{row['longest_ms']:9.0f}"
                  f"  {words_of(row['searches'])}  {words_of(row['carries'])}", flush=True)
    benchmark.write({"rows": rows}, options.json)
    return 0


def run(options):
    if options.logs:
        return run_on_logs(options)
    program = benchmark.build("localization")
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        jobs = [(name, model, pool.submit(benchmark.call, program, world, model, 1, options.runs, *way))
                for name, world, model, way in SCENES]
        rows = [{"world": name, "model": model, **row} for name, model, job in jobs for row in job.result()["rows"]]
    print(f"\n{'world':10}{'model':18}{'':9}{'found':>7}{'median [m]':>12}{'worst [m]':>11}{'median [deg]':>14}{'worst':>7}{'found [s]':>11}"
          f"{'wrong [s]':>11}{'scan [ms]':>11}{'longest':>9}")
    summary = []
    for name, _, model, _ in SCENES:
        for kind in ("drive", "carried"):
            each = summarise([row for row in rows if (row["world"], row["model"], row["kind"]) == (name, model, kind)])
            summary.append({"world": name, "model": model, "kind": kind, **each})
            print(f"{name:10}{model:18}{kind:9}{each['found']:4}/{each['runs']:<2}{each['median_m']:12.4f}{each['worst_m']:11.4f}"
                  f"{each['median_deg']:14.3f}{each['worst_deg']:7.2f}{each['found_s']:11.1f}{each['wrong_s']:11.1f}{each['scan_ms']:11.2f}"
                  f"{each['longest_ms']:9.1f}")
    benchmark.write({"rows": rows, "summary": summary}, options.json)
    return 0
