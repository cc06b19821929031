"""Draws a recorded drive (map with trajectories, speed, acceleration and yaw rate against limits, clearance, separation), or the paper's
Figs. 6 to 15 with our own data, or the paths of all classes on a map, or what moves in recorded laser scans, or the nodes, their topics and parameters."""
import argparse
import os
import sys

from mocha_scripts.complaint import Complaint
from mocha_scripts.paths import CALLED, HAS_SOURCES, ROOT


def add_recording(plots, world, words):
    """What is drawn: a bag, and the world file that was driven."""
    plots.add_argument("bag", help="drive.bag of a demo")
    plots.add_argument("--world", default=os.path.join(ROOT, f"config/worlds/{world}.yaml"), metavar="FILE",
                       help=f"world file that was driven (default: {words})")


def add_drive(what):
    drive = what.add_parser("drive", help="the plots of scripts/demo, from its rosbag",
                            description="Writes map.png, dynamics.png, clearance.png and, for more than one robot, separation.png.")
    add_recording(drive, "corridor", "the corridor")
    drive.set_defaults(draw=draw_drive)
    return drive


def add_table1(what):
    table1 = what.add_parser("table1", help="trajectories of Table I, as in the paper's Figs. 6 and 7",
                             description="Plans with MINCO and with motion camouflage in one world of the plane and one of space. Writes "
                             "fig6.png (the trajectories) and fig7.png (their speed and acceleration over time against the limits).")
    table1.add_argument("--world", type=int, default=1, metavar="N",
                        help="seed of both worlds, as scripts/bench table1 numbers them (default 1)")
    table1.set_defaults(draw=draw_table1)
    return table1


def add_table2(what):
    table2 = what.add_parser("table2", help="drives of Table II, as in the paper's Figs. 8 and 9",
                             description="Plans with this package's planner, SST and BIT* to three targets in one world. Writes "
                             "fig9.png (the trajectories) and fig8.png (their speed and acceleration over time against the limits).")
    table2.add_argument("--world", type=int, default=1, metavar="N",
                        help="seed of the world, as scripts/bench table2 numbers them (default 1)")
    table2.set_defaults(draw=draw_table2)
    return table2


def add_table3(what):
    table3 = what.add_parser("table3", help="drives of Table III, as in the paper's Figs. 12 and 13",
                             description="Drives the five agents of one scene. Writes fig12.png (the distances of all pairs over time) and "
                             "fig13.png (the paths among the obstacles).")
    table3.add_argument("--seed", type=int, default=1, metavar="N",
                        help="of the scene, as scripts/bench table3 numbers them (default 1)")
    table3.set_defaults(draw=draw_table3)
    return table3


def add_classes(what):
    classes = what.add_parser("classes", help="the paths of all classes in a world or on a saved map",
                              description="Plans in a world, for its first robot, or on a saved map, for the rover. Writes classes.png: the "
                              "candidates of all classes with their costs, and what the optimiser makes of the straight line, without classes.")
    classes.add_argument("file", help="world file, or map.yaml of a saved map")
    classes.add_argument("--classes", type=int, default=8, metavar="N", help="how many at most (default 8)")
    classes.add_argument("--drive", type=float, nargs=4, metavar=("X0", "Y0", "X1", "Y1"),
                         help="start and goal [m]; a saved map needs them")
    classes.set_defaults(draw=draw_classes)
    return classes


def add_tracks(what):
    tracks = what.add_parser("tracks", help="what moves in the laser scans of a bag",
                             description="Runs perception over all laser scans of a bag. Writes tracks.png: "
                             "the map, the hits on moving things, their tracks with velocities, and their speeds over time.")
    tracks.add_argument("bag", help="bag with sensor_msgs/LaserScan")
    tracks.add_argument("--map-frame", default="odom", metavar="FRAME", help="in which is drawn, of the bag's transforms (default odom)")
    tracks.add_argument("--mount", action="append", default=[], metavar="FRAME:X,Y,YAW",
                        help="where the lidar with that frame_id is [m, rad], if the bag has no transforms; give it once for each lidar")
    tracks.set_defaults(draw=draw_tracks)
    return tracks


def add_contacts(what):
    contacts = what.add_parser("contacts", help="what led to the contacts in a world with movers",
                               description="Drives the first robot of a world through its whole stack, lidar only and without ROS. Writes a "
                               "picture for each contact: what was there, seen, predicted and promised before it, and what the robot did.")
    contacts.add_argument("world", help="world file with movers")
    contacts.add_argument("--seed", type=int, default=1, metavar="N", help="of the lidar's noise (default 1)")
    contacts.set_defaults(draw=draw_contacts)
    return contacts


def add_replan(what):
    replan = what.add_parser("replan", help="a drive around what moves, as in the paper's Figs. 10 and 11",
                             description="Drives one scene of scripts/bench replan in closed loop. Writes replan.png: the plan, the drive and "
                             "the movers, and below the clearance over time.")
    replan.add_argument("--scene", type=int, default=1, metavar="N", help="number of the scene (default 1)")
    replan.set_defaults(draw=draw_replan)
    return replan


def add_detour(what):
    detour = what.add_parser("detour", help="a recorded drive around what moves, as in the paper's Figs. 10 and 11",
                             description="Writes detour.png: the global plan, the local trajectories with their rejoin points, what was seen to move, "
                             "and below the clearance over time.")
    add_recording(detour, "detour", "the scene of Fig. 10")
    detour.set_defaults(draw=draw_detour)
    return detour


def add_costs(what):
    costs = what.add_parser("costs", help="what a recorded fleet's paths cost, as in the paper's Figs. 14 and 15",
                            description="Writes costs.png (for each robot the paths of one plan, their costs and what the team-mates' promises "
                            "add to them: for the robot that promised first its first plan, for the others their first that knew a promise) and "
                            "time_lapse.png (the drives), and prints the costs, beside those of the same paths in the plan before. A path is optimised with "
                            "(33), so where it makes room for a promise its duration rises rather than (33) itself.")
    add_recording(costs, "corridor_meet", "two robots that meet in the corridor")
    costs.set_defaults(draw=draw_costs)
    return costs


def add_animation(what):
    animation = what.add_parser("animation", help="a recorded drive as an animated picture",
                                description="Writes drive.gif: what the robots know of the world, where they are, and (broad) what they have promised.")
    add_recording(animation, "corridor", "the corridor")
    animation.add_argument("--speed", type=float, default=2.0, metavar="N", help="so many times as fast as it was driven (default 2)")
    animation.set_defaults(draw=draw_animation)
    return animation


def add_map(what):
    driven = what.add_parser("map", help="a map as it was driven, from its pose graph",
                             description="Writes NAME.png: all hits of all keyframes, where these were, and the loops that were closed.")
    driven.add_argument("map", help="NAME.g2o, as scan_localizer saves it while mapping")
    driven.set_defaults(draw=draw_driven_map)
    return driven


def add_architecture(what):
    architecture = what.add_parser("architecture", help="the nodes, their topics and the frames, read from the sources",
                                   description="Writes architecture.svg and frames.svg, which docs/ holds.")
    architecture.set_defaults(draw=draw_architecture)
    return architecture


def add_reference(what):
    reference = what.add_parser("reference", help="topics, messages and parameters in words, read from the sources",
                                description="Writes reference/topics.md, messages.md and parameters.md, which docs/ holds.")
    reference.set_defaults(draw=write_reference)
    return reference


# The imports stand in the functions, as the help needs no matplotlib.
def draw_drive(options):
    from mocha_scripts import drive_plots
    drive_plots.draw_drive(options.bag, options.world, options.out)


def draw_table1(options):
    from benchmarks import table1_plots
    table1_plots.draw_table1(options.world, options.out)


def draw_table2(options):
    from benchmarks import table2_plots
    table2_plots.draw_table2(options.world, options.out)


def draw_table3(options):
    from benchmarks import table3_plots
    table3_plots.draw_table3(options.seed, options.out)


def draw_classes(options):
    from benchmarks import classes_plots
    classes_plots.draw_classes(options.file, options.classes, options.drive, options.out)


def draw_tracks(options):
    from benchmarks import tracks_plots
    tracks_plots.draw_tracks(options.bag, options.map_frame, options.mount, options.out)


def draw_contacts(options):
    from benchmarks import contacts_plots
    contacts_plots.draw_contacts(options.world, options.seed, options.out)


def draw_replan(options):
    from benchmarks import replan_plots
    replan_plots.draw_replan(options.scene, options.out)


def draw_detour(options):
    from mocha_scripts import detour_plots
    detour_plots.draw_detour(options.bag, options.world, options.out)


def draw_costs(options):
    from mocha_scripts import costs_plots
    print(costs_plots.draw_costs(options.bag, options.world, options.out))


def draw_animation(options):
    from mocha_scripts import animation
    print(animation.draw_animation(options.bag, options.world, options.out, options.speed))


def draw_driven_map(options):
    from mocha_scripts import map_plot
    print(map_plot.draw_map(options.map, options.out))


def draw_architecture(options):
    from mocha_scripts import architecture_plot, frames_plot
    architecture_plot.draw_architecture(ROOT, options.out)
    frames_plot.draw_frames(ROOT, options.out)


def write_reference(options):
    from mocha_scripts import reference
    reference.write_reference(ROOT, options.out)


OF_RECORDINGS = [add_drive, add_detour, add_costs, add_animation, add_map]
# These run benchmarks, or read what is not installed.
OF_SOURCES = [add_table1, add_table2, add_table3, add_classes, add_tracks, add_contacts, add_replan, add_architecture, add_reference]


def main(arguments):
    parser = argparse.ArgumentParser(prog=CALLED + "plots", description=__doc__)
    what = parser.add_subparsers(dest="what", metavar="WHAT", required=True)
    for add in OF_RECORDINGS + (OF_SOURCES if HAS_SOURCES else []):
        plots = add(what)
        plots.add_argument("--out", default=".", metavar="DIR", help="files go there (default: here)")
    options = parser.parse_args(arguments)
    os.makedirs(options.out, exist_ok=True)
    try:
        options.draw(options)
    except Complaint as complaint:
        print(f"plots: {complaint}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
