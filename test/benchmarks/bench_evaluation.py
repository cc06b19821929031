"""Time of one evaluation of the objective against the spline and its adjoint alone.

A path of about 146 m in pieces of 1 m, 65 circles, 20 samples a piece; with camouflage and with waypoints as variables, in three worlds.
"""
import statistics

from benchmarks import benchmark


def add_arguments(parser):
    parser.add_argument("--json", metavar="FILE", help="write the rows there")


def run(options):
    result = benchmark.run("evaluation")
    rows = result["rows"]
    print(f"{'method':12}{'world':>6}{'pieces':>8}{'full [us]':>11}{'spline [us]':>13}{'ratio':>7}")
    ratios = []
    for full, spline in zip(rows[0::2], rows[1::2]):
        ratio = full["seconds"] / spline["seconds"]
        ratios.append(ratio)
        print(f"{full['method']:12}{full['world']:6}{full['pieces']:8}{1e6 * full['seconds']:11.1f}"
              f"{1e6 * spline['seconds']:13.1f}{ratio:7.2f}")
    result["summary"] = {"median_ratio": round(statistics.median(ratios), 3), "worst_ratio": round(max(ratios), 3)}
    print(f"an evaluation takes {result['summary']['median_ratio']:.2f} times as long as the spline alone (median; worst"
          f" {max(ratios):.2f})")
    benchmark.write(result, options.json)
    return 0
