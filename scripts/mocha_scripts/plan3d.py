"""Plans in an OctoMap, in three dimensions: trajectories of several classes, certified, the cheapest first.

    scripts/plan3d config/maps/two_windows.bt --start 1,4,1.5 --goal 9,4,1.5 --picture out/plan3d.png
"""
import argparse
import json
import math
import os
import sys
import time

from mocha_scripts.complaint import Complaint, in_a_line

SAMPLE_S = 0.05
PICTURES = (".png", ".pdf", ".svg")


def numbers_of(count, expected):
    def read(text):
        try:
            numbers = [float(number) for number in text.split(",")]
        except ValueError:
            numbers = []
        if len(numbers) != count or not all(map(math.isfinite, numbers)):
            raise argparse.ArgumentTypeError(f"{text}: expected {expected}")
        return tuple(numbers)
    return read


place = numbers_of(3, "X,Y,Z in metres")
ball = numbers_of(7, "X,Y,Z,VX,VY,VZ,RADIUS in metres and metres per second")


def parameter(text):
    name, equals, value = text.partition("=")
    if not equals:
        raise argparse.ArgumentTypeError(f"{text}: expected NAME=VALUE")
    for kind in (int, float):
        try:
            return name, kind(value)
        except ValueError:
            pass
    return name, value


def file_to_write(text):
    if os.path.isdir(text) or not os.path.basename(text):
        raise argparse.ArgumentTypeError(f"{text}: expected the name of a file, not of a directory")
    return text


def picture(text):
    if os.path.splitext(file_to_write(text))[1].lower() not in PICTURES:
        raise argparse.ArgumentTypeError(f"{text}: expected a name that ends in {', '.join(PICTURES[:-1])} or {PICTURES[-1]}")
    return text


def parse(arguments):
    parser = argparse.ArgumentParser(prog="scripts/plan3d", description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("map", metavar="MAP.bt", help="an OctoMap file (.bt or .ot)")
    parser.add_argument("--start", type=place, required=True, metavar="X,Y,Z", help="where the robot rests [m]")
    parser.add_argument("--goal", type=place, required=True, metavar="X,Y,Z", help="where it is to rest [m]")
    parser.add_argument("--classes", type=int, metavar="K", help="paths of different topology at most (as config/space_planner.yaml has it: 6)")
    parser.add_argument("--moving", type=ball, action="append", default=[], metavar="X,Y,Z,VX,VY,VZ,R",
                        help="a ball that moves: where it is when the plan begins [m], its velocity [m/s], its radius [m]; may be given several times")
    parser.add_argument("--parameter", type=parameter, action="append", default=[], metavar="NAME=VALUE",
                        help="one of config/space_planner.yaml; may be given several times")
    parser.add_argument("--json", type=file_to_write, metavar="FILE", help="write the plan there")
    parser.add_argument("--picture", type=picture, metavar="FILE", help="draw map, curves and trajectories there (.png, .pdf or .svg)")
    # A place may begin with a minus sign, which argparse takes for an option.
    joined = []
    for word in arguments:
        if joined and joined[-1] in ("--start", "--goal", "--moving"):
            joined[-1] += "=" + word
        else:
            joined.append(word)
    return parser.parse_args(joined)


def run(options):
    import mocha_planner  # built by now
    parameters = dict(options.parameter)
    if options.classes is not None:
        parameters["classes"] = options.classes
    begin_s = time.monotonic()
    try:
        planner = mocha_planner.SpacePlanner(options.map, parameters, [options.start, options.goal])
        curves = planner.curves(options.start)
        map_s = time.monotonic() - begin_s
        plan = planner.plan(options.start, options.goal, options.moving)
    except (ValueError, RuntimeError) as error:
        raise Complaint(in_a_line(error)) from error
    return planner, curves, plan, map_s


def count_text(counts):
    def number(count, one, more):
        return f"{count} {one if count == 1 else more}"
    parts = [number(counts["columns"], "column", "columns"), number(counts["loops"], "loop", "loops"),
             number(counts["arches"], "arch", "arches")]
    text = "classes are told apart by " + ", ".join(parts)
    if counts["bodies"]:
        text += f"; {number(counts['bodies'], 'body hangs', 'bodies hang')} free and can be passed on any side alike"
    if counts["surface_voxels"]:
        text += f"; {number(counts['surface_voxels'], 'voxel is', 'voxels are')} neither"
    return text


def say(planner, curves, plan, map_s):
    low, high = planner.bounds
    print(f"map: voxels of {planner.resolution_m:g} m, from ({low[0]:g}, {low[1]:g}, {low[2]:g}) to ({high[0]:g}, {high[1]:g}, {high[2]:g}),"
          f" made ready in {map_s:.2f} s")
    if curves:
        print(count_text(curves["counts"]))
    print(f"{plan.reason} in {1e3 * plan.took_s:.0f} ms" + (f": {plan.message}" if not plan.solved else ""))
    for number, each in enumerate(plan.candidates, 1):
        print(f"{number:3}  cost {each.cost:7.2f}  {each.duration_s:6.2f} s  {each.length_m:6.2f} m  {each.evaluations:4} evaluations  "
              + ("certified" if each.certified else each.outcome))


def as_dict(planner, curves, plan, map_s):
    def candidate(each):
        samples = each.sample(SAMPLE_S)
        return {"certified": each.certified, "outcome": each.outcome, "cost": each.cost, "terms": each.terms,
                "evaluations": each.evaluations, "signature": each.signature, "duration_s": each.duration_s, "length_m": each.length_m,
                "path_m": [list(map(float, point)) for point in each.path],
                "trajectory": {"time_s": samples["time_s"], "place_m": [list(map(float, point)) for point in samples["place_m"]],
                               "speed_mps": samples["speed_mps"]}}
    return {"solved": plan.solved, "reason": plan.reason, "message": plan.message, "map_s": map_s, "plan_s": plan.took_s,
            "bounds_m": [list(map(float, corner)) for corner in planner.bounds], "resolution_m": planner.resolution_m,
            "curves": curves["counts"] if curves else None, "candidates": [candidate(each) for each in plan.candidates]}


def main(arguments):
    options = parse(arguments)
    try:
        planner, curves, plan, map_s = run(options)
        say(planner, curves, plan, map_s)
        for path in filter(None, (options.json, options.picture)):
            os.makedirs(os.path.dirname(os.path.abspath(path)), exist_ok=True)
        if options.json:
            with open(options.json, "w") as file:
                json.dump(as_dict(planner, curves, plan, map_s), file, indent=1)
        if options.picture:
            from mocha_scripts.space_plot import draw_plan
            draw_plan(planner, curves, plan, options)
            print(f"drawn: {options.picture}")
    except (Complaint, OSError) as complaint:
        print(f"plan3d: {complaint}", file=sys.stderr)
        return 2
    except KeyboardInterrupt:
        return 130  # as shells have it
    return 0 if plan.solved else 1


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
