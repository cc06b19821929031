"""Robots that cross each other's paths over networks that delay messages and lose some, under two protocols.

Two to four robots start on the rim of an open place and drive to its other side; all planners in one process, in simulated time. Under
the two-phase protocol of this package a promise is binding when all others in reach have agreed, delta_dc being longer than the delay;
under the paper's one-phase protocol at once, and then it is broadcast. Both have the same planners, which brake or swerve as soon as they
hear of a promise that meets their own. Separation is centre to centre, footprints have a radius of 0.3 m, and each robot is up to 3 cm off
its motion. Time lost is against the same drives without the other robots. Each network is run with clocks that agree, and with clocks that
are off and drift; with --asymmetry 1 all of the delay is on one of the two ways between each two robots, which hides an offset of as much.
"""
import concurrent.futures
import os
import statistics

from benchmarks import benchmark

PROTOCOLS = ("one_phase", "two_phase")
DELAYS_S = (0.0, 0.1, 0.25, 0.5)
LOSSES = (0.0, 0.1, 0.3)
CLOCK_OFFSET_S = 0.2
CLOCK_DRIFT = 5e-5  # two clocks that drift apart by what ClockEstimate allows for
RUNS = 25


def numbers(text):
    return tuple(float(each) for each in text.split(","))


def add_arguments(parser):
    parser.add_argument("--runs", type=int, default=RUNS, metavar="N", help=f"seeded runs of each cell (default {RUNS})")
    parser.add_argument("--protocol", choices=PROTOCOLS, action="append", help="only this one")
    parser.add_argument("--delays", type=numbers, default=DELAYS_S, metavar="S,S,...", help="only these delays [s]")
    parser.add_argument("--losses", type=numbers, default=LOSSES, metavar="P,P,...", help="only these shares of messages lost")
    parser.add_argument("--clock-offset", type=float, default=CLOCK_OFFSET_S, metavar="S",
                        help=f"where clocks are off: each by up to this (default {CLOCK_OFFSET_S} s)")
    parser.add_argument("--clock-drift", type=float, default=CLOCK_DRIFT, metavar="RATE",
                        help=f"and each drifts by up to this (default {CLOCK_DRIFT} s/s)")
    parser.add_argument("--asymmetry", type=float, default=0.0, metavar="SHARE", help="of the delay, moved from one way to the other (default 0)")
    parser.add_argument("--json", metavar="FILE", help="write the rows and the summary there")


def summarise(rows):
    return {"runs": len(rows), "contacts": sum(row["contacts"] for row in rows),
            "runs_with_contact": sum(row["contacts"] > 0 for row in rows),
            "min_separation_m": min(row["min_separation_m"] for row in rows),
            "all_reached": all(row["all_reached"] for row in rows), "not_reached": sum(not row["all_reached"] for row in rows),
            "broken_promises": sum(row["breaches"] for row in rows),
            "time_lost_s": round(statistics.median(row["time_lost_s"] for row in rows), 3)}


def cells(options):
    return [(protocol, delay, loss, offset, drift) for protocol in options.protocol or PROTOCOLS
            for offset, drift in ((0.0, 0.0), (options.clock_offset, options.clock_drift)) for delay in options.delays for loss in options.losses]


def of_cell(rows, cell):
    return [row for row in rows if (row["protocol"], row["delay_s"], row["loss"], row["clock_offset_s"], row["clock_drift"]) == cell]


def print_table(rows, options):
    print(f"\n{'protocol':12}{'clocks':10}{'delay [s]':>10}{'loss':>7}{'runs':>6}{'contacts':>10}{'least sep. [m]':>16}{'not all arrive':>16}"
          f"{'promises met':>14}{'lost 50 % [s]':>15}")
    for cell in cells(options):
        found = summarise(of_cell(rows, cell))
        print(f"{cell[0]:12}{'agree' if cell[3:] == (0.0, 0.0) else 'are off':10}{cell[1]:10.2f}{100 * cell[2]:5.0f} %{found['runs']:6}{found['contacts']:10}{found['min_separation_m']:16.3f}"
              f"{found['not_reached']:16}{found['broken_promises']:14}{found['time_lost_s']:15.2f}")


def run(options):
    program = benchmark.build("fleet_delay")
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        jobs = [pool.submit(benchmark.call, program, *cell, options.asymmetry, 0, options.runs) for cell in cells(options)]
        rows = [row for job in jobs for row in job.result()["rows"]]
    print_table(rows, options)
    protocols = {protocol: summarise([row for row in rows if row["protocol"] == protocol]) for protocol in options.protocol or PROTOCOLS}
    print()
    for protocol, found in protocols.items():
        print(f"{protocol}: {found['contacts']} contacts in {found['runs']} runs, smallest separation {found['min_separation_m']:.3f} m,"
              f" {found['not_reached']} runs in which not all arrived, {found['broken_promises']} times promises met")
    summary = {"protocols": protocols, "cells": [{"protocol": cell[0], "delay_s": cell[1], "loss": cell[2], "clock_offset_s": cell[3],
                                                  "clock_drift": cell[4], **summarise(of_cell(rows, cell))} for cell in cells(options)]}
    benchmark.write({"rows": rows, "summary": summary}, options.json)
    return 0
