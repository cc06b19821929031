"""Draws a recorded drive: map with trajectories, speed, acceleration and yaw rate against limits, clearance, separation."""
import argparse
import os
import sys

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))


def main(arguments):
    parser = argparse.ArgumentParser(prog="scripts/plots", description=__doc__)
    what = parser.add_subparsers(dest="what", metavar="WHAT", required=True)
    drive = what.add_parser("drive", help="the plots of scripts/demo, from its rosbag")
    drive.add_argument("bag", help="drive.bag of a demo")
    drive.add_argument("--world", default=os.path.join(ROOT, "config/worlds/corridor.yaml"), metavar="FILE",
                       help="world file that was driven (default: the corridor)")
    drive.add_argument("--out", default=".", metavar="DIR", help="PNG files go there (default: here)")
    options = parser.parse_args(arguments)
    from mocha_scripts import drive_plots  # not above: the help needs no matplotlib
    os.makedirs(options.out, exist_ok=True)
    drive_plots.draw_drive(options.bag, options.world, options.out)
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
