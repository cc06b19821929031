"""Six robots in an office swap patrols for an hour, while nodes and whole robots are started anew and the network fails.

All in one process and in simulated time. Every 75 s each robot takes over where the next one was going, so that all keep meeting in doors
through which one fits, and in a corridor in which two just pass. The network loses 5 to 20 % and takes up to 0.1 s, both of which change.
Faults follow the seed: somewhere in the fleet a node does not run for about a second every 20 s, a robot's planners and its broadcaster
for 3 to 8 s every 90 s, and a robot hears and is heard by nobody for 1 to 3 s every 30 s. Robots know the walls, and where they are; of
team-mates that are not where they promised to be they know what a lidar would tell. A wait is a time in which a robot that has a goal
neither arrives nor gets 0.3 m away. Fails if one is longer than 60 s, if anything touches, or if memory grows.
"""
import os

import numpy as np

from benchmarks import benchmark

WORLD = "config/worlds/office.yaml"
LONGEST_WAIT_S = 60.0
WARM_UP = 10  # minutes, in which caches fill
JUDGED = 20  # minutes, at least
FLAT = 0.05  # of the memory in an hour


def add_arguments(parser):
    parser.add_argument("--hours", type=float, default=1.0, metavar="H", help="of simulated time (default 1)")
    parser.add_argument("--seed", type=int, default=1, metavar="N", help="of faults and network (default 1)")
    parser.add_argument("--world", default=WORLD, metavar="FILE", help=f"whose robots have goals (default {WORLD})")
    parser.add_argument("--json", metavar="FILE", help="write what the program measured and the summary there")
    parser.add_argument("--plot", metavar="FILE", help="draw memory, waits and arrivals over time there (PNG)")


def memory_growth(minutes):
    """First and last [MB] after the warm-up, and the share by which the line through them rises in an hour; nothing after too short a run."""
    memory_mb = 1e-6 * np.array([minute["memory_bytes"] for minute in minutes[WARM_UP:]])
    if len(memory_mb) < JUDGED:
        return None
    slope_mb = np.polyfit(np.arange(len(memory_mb)) / 60.0, memory_mb, 1)[0]
    return {"first_mb": memory_mb[0], "last_mb": memory_mb[-1], "mb_per_hour": slope_mb, "share_per_hour": slope_mb / memory_mb.mean(),
            "flat": bool(slope_mb < FLAT * memory_mb.mean())}


def failures(result, growth):
    found = []
    if result["longest_wait_s"] > LONGEST_WAIT_S:
        found.append(f"{len(result['stuck'])} waits of more than {LONGEST_WAIT_S:.0f} s")
    if result["contacts"]:
        found.append(f"{len(result['contacts'])} contacts")
    if growth and not growth["flat"]:
        found.append("memory grows")
    return found


def summarise(result):
    growth = memory_growth(result["minutes"])
    return {"arrivals_per_hour": result["arrivals"] / result["time_s"] * 3600.0, "memory": growth,
            "wall_s_per_hour": result["wall_s"] / result["time_s"] * 3600.0, "failures": failures(result, growth)}


def print_summary(result, summary):
    print(f"\n{result['arrivals']} arrivals in {result['time_s'] / 60.0:.1f} min, {summary['arrivals_per_hour']:.0f} an hour;"
          f" {result['gave_up']} goals given up, and given again")
    print(f"longest wait {result['longest_wait_s']:.1f} s, longest time of a robot without arrival {result['longest_without_arrival_s']:.1f} s")
    print(f"{len(result['contacts'])} contacts, least separation {result['min_separation_m']:.3f} m (centre to centre, radii 0.3 m)")
    print(f"{result['node_restarts']} nodes and {result['robot_restarts']} robots started anew, {result['blackouts']} blackouts;"
          f" {result['leases_lost']} leases ended, {result['breaches']} times a robot heard of a promise that met its own")
    for wait in result["stuck"]:
        print(f"stuck: ugv{wait['robot']} at {wait['place']} from {wait['begin_s']:.1f} s for {wait['lasts_s']:.1f} s, to {wait['goal']}:"
              f" {wait['words']}")
    for contact in result["contacts"]:
        print(f"contact: {contact}")
    growth = summary["memory"]
    if growth:
        print(f"memory {growth['first_mb']:.2f} MB after {WARM_UP} min, {growth['last_mb']:.2f} MB at the end,"
              f" {growth['mb_per_hour']:+.3f} MB ({100 * growth['share_per_hour']:+.1f} %) in an hour: {'flat' if growth['flat'] else 'GROWS'}")
    else:
        print(f"memory: not judged, which takes {WARM_UP + JUDGED} min")
    print(f"{summary['wall_s_per_hour']:.0f} s of wall time for an hour")
    print(f"FAILED: {', '.join(summary['failures'])}" if summary["failures"] else "nobody stuck, no contact")


def draw(result, path):
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    minutes = result["minutes"]
    time_min = np.arange(1, len(minutes) + 1)
    series = ([1e-6 * minute["memory_bytes"] for minute in minutes], [minute["longest_wait_s"] for minute in minutes],
              np.diff([0] + [minute["arrivals"] for minute in minutes]))
    figure, plots = plt.subplots(3, 1, figsize=(9, 8), sharex=True)
    for axes, values, label in zip(plots, series, ("memory in use [MB]", "longest wait under way [s]", "arrivals in the minute")):
        axes.plot(time_min, values)
        axes.set(ylabel=label, ylim=(0.0, None))
        axes.grid(alpha=0.3)
    plots[-1].set_xlabel("simulated time [min]")
    figure.savefig(path, dpi=110, bbox_inches="tight")


def run(options):
    result = benchmark.run("soak", os.path.abspath(os.path.join(benchmark.ROOT, options.world)), options.hours, options.seed)
    summary = summarise(result)
    print_summary(result, summary)
    benchmark.write({"result": result, "summary": summary}, options.json)
    if options.plot:
        draw(result, options.plot)
    return 1 if summary["failures"] else 0
