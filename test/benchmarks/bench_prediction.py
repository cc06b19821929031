"""How well the places of what moves are predicted, from a simulated lidar among recorded movers.

In each world of a directory the first robot patrols between its start and its goal (through people, if need be). Each track that perception
tells is held against the mover that it follows (the nearest, within 0.75 m) 0.5, 1 and 2 s later, if that is still there. Shown are the mean
displacement error of these predictions, beside that of plain constant velocity (from the track's places now and 0.4 s ago), and how often
the disc of a confidence held the mover: at that time, and at any time until then (the discs that motions keep from). `final` is the error
at 2 s. Tracks without a mover are false ones; they are counted, not judged.
"""
import glob
import multiprocessing
import os

from benchmarks import benchmark

AHEAD_S = (0.5, 1.0, 2.0)
CONFIDENCES = (0.5, 0.8, 0.9, 0.95)
SECONDS = 88.0


def add_arguments(parser):
    parser.add_argument("directory", help="with world files")
    parser.add_argument("--seed", type=int, default=1, help="of the lidar's noise (default 1)")
    parser.add_argument("--seconds", type=float, default=SECONDS, help=f"of each world (default {SECONDS:g})")
    parser.add_argument("--jobs", type=int, default=1, help="worlds at the same time (default 1)")
    parser.add_argument("--json", metavar="FILE", help="write the rows and the summary there")


def mean(values):
    values = [value for value in values if value is not None]
    return round(sum(values) / len(values), 4) if values else None


def measure(job):
    program, world, seed, seconds = job
    return benchmark.call(program, world, seed, seconds)


def figures(judged):
    """Of what became of predictions for one time ahead: rows as the program prints them."""
    both = [row for row in judged if row[1] is not None]
    held = {"at": [mean(row[2] < row[4][k] for row in judged) for k in range(len(CONFIDENCES))],
            "throughout": [mean(row[3] < row[5][k] for row in judged) for k in range(len(CONFIDENCES))]}
    return {"predictions": len(judged), "error_m": mean(row[0] for row in both), "plain_error_m": mean(row[1] for row in both),
            "held": held}


def judged(measured, index):
    return [row[index] for one in measured for row in one["rows"] if row[index] is not None]


def row_of(name, measured):
    ahead = {f"{seconds:g}": figures(judged(measured, i)) for i, seconds in enumerate(AHEAD_S)}
    return {"world": name, "false": sum(one["unmatched"] for one in measured), "ahead_s": ahead,
            "mean_error_m": mean(here["error_m"] for here in ahead.values()), "final_error_m": ahead["2"]["error_m"]}


def shown(row):
    def shares(values):
        return " ".join("   - " if value is None else f"{value:.3f}" for value in values)

    def error(value):
        return "  -  " if value is None else f"{value:.3f}"

    lines = []
    for seconds, here in row["ahead_s"].items():
        name = row["world"] if not lines else ""
        lines.append(f"{name:24} {seconds:>4} s {here['predictions']:6}   {error(here['error_m'])} {error(here['plain_error_m'])}   "
                     f"{shares(here['held']['at'])}   {shares(here['held']['throughout'])}")
    return "\n".join(lines)


def farthest(rows, kind):
    """By how much a share differs from its confidence, at most of all worlds and times."""
    off = [abs(share - confidence) for row in rows for here in row["ahead_s"].values()
           for share, confidence in zip(here["held"][kind], CONFIDENCES) if share is not None]
    return round(max(off), 4) if off else None


def run(options):
    paths = sorted(glob.glob(os.path.join(options.directory, "*.yaml")))
    if not paths:
        raise SystemExit(f"bench prediction: no world files in {options.directory}")
    program = benchmark.build("prediction")
    confidences = " ".join(f"{confidence:5g}" for confidence in CONFIDENCES)
    print(f"{'':24} {'':13}   error [m]     held then{'':14}   held until then")
    print(f"{'world':24} {'ahead':>6} {'judged':>6}    ours plain   {confidences}   {confidences}")
    rows, everything = [], []
    with multiprocessing.Pool(options.jobs) as pool:
        jobs = [(program, os.path.abspath(path), options.seed, options.seconds) for path in paths]
        for path, measured in zip(paths, pool.imap(measure, jobs)):
            rows.append(row_of(os.path.splitext(os.path.basename(path))[0], [measured]))
            everything.append(measured)
            print(shown(rows[-1]), flush=True)
    summary = row_of("all", everything)
    summary["farthest_off"] = {kind: farthest(rows, kind) for kind in ("at", "throughout")}
    print(shown(summary))
    print(f"mean error {summary['mean_error_m']} m, final {summary['final_error_m']} m; false tracks {summary['false']}; "
          f"farthest from its confidence: {summary['farthest_off']['at']} then, {summary['farthest_off']['throughout']} until then")
    benchmark.write({"rows": rows, "summary": summary}, options.json)
    return 0
