"""The main job: a simulated fleet maps, plans, promises and drives to its goals."""
import argparse
import json
import os
import sys
import time

from mocha_scripts.paths import CALLED, OUT, ROOT

LCM_URL = "udpm://239.255.76.67:7667?ttl=0"


def parse(arguments):
    parser = argparse.ArgumentParser(prog=CALLED + "demo", description=__doc__ + " Exit status 0 only if all robots reach "
                                     "their goals without contact.")
    parser.add_argument("--world", default=os.path.join(ROOT, "config/worlds/corridor.yaml"), metavar="FILE",
                        help="world file (default: two robots in a corridor of 12 cylinders)")
    parser.add_argument("--headless", action="store_true", help="no rviz; without it, rviz opens where there is a display")
    parser.add_argument("--rate", type=float, default=1.0,
                        help="simulated seconds per second at most; 0: as fast as possible (default 1)")
    parser.add_argument("--seed", type=int, default=1, help="of sensor noise and odometry drift (default 1)")
    parser.add_argument("--lcm", metavar="URL", nargs="?", const=LCM_URL, default="",
                        help=f"robots hear each other over LCM instead of topics (default URL {LCM_URL}: this host only)")
    parser.add_argument("--emulated-bases", action="store_true",
                        help="drive through base drivers, serial lines and emulated bases instead of directly")
    parser.add_argument("--map", metavar="FILE", default="",
                        help="robots find out where they are for themselves, in this map of the world (.bt); without, they are told the truth")
    parser.add_argument("--limit", type=float, default=180.0, metavar="SECONDS",
                        help="simulated seconds allowed (default 180)")
    parser.add_argument("--json", metavar="FILE", help="write the results of the table there")
    parser.add_argument("--out", metavar="DIR", default=os.path.join(OUT, "demo"),
                        help="log, rosbag and plots go there (default out/demo)")
    parser.add_argument("--no-plots", action="store_true", help="record no rosbag and draw no plots")
    return parser.parse_args(arguments)


def read_robots(world):
    """Names of the robots of a world file; one line and exit status 2 where it cannot be read."""
    from mocha_scripts import worlds  # here, like all that the help can do without
    from mocha_scripts.complaint import Complaint
    try:
        return [robot["name"] for robot in worlds.read_world(world)["robots"]]
    except Complaint as complaint:
        print(f"demo: {complaint}", file=sys.stderr)
        sys.exit(2)


def shown(path):
    """Relative to the working directory where that is shorter."""
    return min(os.path.relpath(path), os.path.abspath(path), key=len)


class Progress:
    """A line every few seconds: how far each robot has driven; and every contact at once."""

    def __init__(self, period_s=2.0):
        self._period_s = period_s
        self._next = 0.0
        self._contacts = 0

    def __call__(self, watched):
        from mocha_scripts import referee
        for contact in watched.contacts[self._contacts:]:
            print(f"  contact: {referee.contact_text(contact)}", flush=True)
            self._contacts += 1
        if time.monotonic() < self._next or not watched.robots:
            return
        self._next = time.monotonic() + self._period_s
        robots = [f"{name} {robot.path_m:5.1f} m{' (there)' if robot.reached else ''}"
                  for name, robot in sorted(watched.robots.items())]
        print(f"  {watched.elapsed_s():6.1f} s   " + "   ".join(robots), flush=True)


def main(arguments):
    options = parse(arguments)
    names = read_robots(options.world)
    from mocha_scripts import drive, referee
    show = bool(os.environ.get("DISPLAY")) and not options.headless
    print(f"demo: {' and '.join(names)} {'drives' if len(names) == 1 else 'drive'} through {shown(options.world)} (log: {shown(options.out)}/drive.log)\n"
          "demo: simulated time, and how far each robot has driven", flush=True)
    results, why = drive.drive(options.world, names, options.out, rate=options.rate, seed=options.seed, rviz=show,
                               record=not options.no_plots, limit_s=options.limit, lcm_url=options.lcm,
                               emulated_bases=options.emulated_bases, map_file=options.map, progress=Progress())
    print(f"demo: {why}\n\n" + referee.table(results) + "\n", flush=True)
    if options.json:
        with open(options.json, "w") as file:
            json.dump(results, file, indent=2)
    if not options.no_plots and results["robots"]:
        from mocha_scripts import drive_plots
        drive_plots.draw_drive(os.path.join(options.out, "drive.bag"), options.world, options.out)
        print(f"demo: rosbag and plots are in {shown(options.out)}")
    succeeded = referee.succeeded(results)
    print(f"demo: {'passed' if succeeded else 'FAILED'}")
    return 0 if succeeded else 1


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
