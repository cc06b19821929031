"""Maps of real buildings, from lidar logs and an odometry that drifts.

Logs are in CARMEN's format. Their poses, corrected by others, are the reference; they hold no odometry, so that is made from them with drift, swerving and
slip as of a small rover whose wheels skid (seeded; test/benchmarks/skid_odometry.h has its figures). Errors are those of all scans: absolute ones after the
trajectory is moved to fit best, relative ones of the motion over 1, 10 and 100 m of driving, on average. A scan's time is that of one core, loops and the
last optimisation included; memory is all that the program took, the log itself included. Merged are the maps of the log's halves, two drives with odometries of their own: median and worst
error of their keyframes, and the time to merge.

Cartographer (Hess et al., ICRA 2016, Table I) reports 0.0229 m and 0.453 degrees for intel, 0.0452 m and 0.538 degrees for freiburg-079: of relations that
were chosen by hand, from the logs' own odometry, so they are near to these figures in kind, but not the same.
"""
import os
import statistics

from benchmarks import benchmark, lidar_logs
from mocha_scripts.complaint import Complaint


def add_arguments(parser):
    lidar_logs.add_argument(parser, "(needed)")
    parser.add_argument("--seeds", type=int, default=1, metavar="N", help="odometries made of each log (default 1)")
    parser.add_argument("--maps", metavar="DIR", help="write the map of each log's first odometry there, and its picture")
    parser.add_argument("--json", metavar="FILE", help="write the rows there")


def print_row(row):
    mapped, errors = row["mapped"], ""
    for length in (1, 10, 100):
        of_length = mapped[f"relative_{length}"]
        errors += f"{of_length['m']:9.3f}{of_length['deg']:7.2f}"
    both = row["merged"]
    merged = both["fault"] if both["fault"] != "none" else f"{both['median_m']:9.3f}{both['worst_m']:7.3f}{both['s']:6.1f}"
    print(f"{row['log']:16}{row['seed']:3}{row['driven_m']:8.0f}{row['odometry']['median_m']:9.2f}{mapped['median_m']:9.3f}{mapped['p95_m']:7.3f}"
          f"{mapped['worst_m']:7.3f}{errors}{row['loops_closed']:7}{row['scan_ms']:8.2f}{row['longest_ms']:9.0f}{row['memory_mib']:9.0f}  {merged}", flush=True)


def run(options):
    if not options.logs:
        raise Complaint("--logs is missing")
    program, merger = benchmark.build("mapping"), benchmark.build("map_merging")
    if options.maps:
        os.makedirs(options.maps, exist_ok=True)
    print(f"{'':16}{'':3}{'driven':>8}{'odometry':>9}{'median':>9}{'95 %':>7}{'worst':>7}{'1 m:':>9}{'':7}{'10 m:':>9}{'':7}{'100 m:':>9}{'':7}{'':7}"
          f"{'scan':>8}{'longest':>9}{'memory':>9}  merged halves")
    print(f"{'log':16}{'':3}{'[m]':>8}{'[m]':>9}{'[m]':>9}{'[m]':>7}{'[m]':>7}{'[m]':>9}{'[deg]':>7}{'[m]':>9}{'[deg]':>7}{'[m]':>9}{'[deg]':>7}{'loops':>7}"
          f"{'[ms]':>8}{'[ms]':>9}{'[MiB]':>9}{'[m]':>11}{'[m]':>7}{'[s]':>6}")
    rows = []
    for name, log in lidar_logs.each(options.logs):
        for seed in range(1, options.seeds + 1):
            saved = os.path.join(options.maps, f"{name}.g2o") if options.maps and seed == 1 else "-"
            row = {"log": name, **benchmark.call(program, log, seed, os.path.abspath(saved) if saved != "-" else saved)}
            row["merged"] = benchmark.call(merger, log, seed, "-")
            rows.append(row)
            print_row(row)
            if saved != "-":
                from mocha_scripts import map_plot
                map_plot.draw_map(saved, options.maps)
    print(f"median of all: {statistics.median(row['mapped']['median_m'] for row in rows):.3f} m, "
          f"{statistics.mean(row['scan_ms'] for row in rows):.2f} ms a scan")
    benchmark.write({"rows": rows}, options.json)
    return 0
