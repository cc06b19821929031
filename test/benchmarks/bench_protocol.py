"""The commitment protocol, proved by machine: all that can happen to two and three robots, within the harm that each scenario allows.

The real protocol runs in steps of 1/16 s: delta_dc is one step, heartbeats are two steps apart, and a robot that is silent for four is out of reach. Breadth first,
every order of proposing, sending, loss, delay, duplication, falling out of reach, restart and braking is tried. In all states, what settles
meets no motion that it must not meet (safety), and where nothing more goes wrong, proposals are settled or outdone, and somebody wins
(liveness). scripts/test does the same with less harm. A million states take a third of a gigabyte.
"""
from benchmarks import benchmark

SCENARIOS = 10
STATES = 10_000_000
HARM = ("losses", "delays", "duplicates", "restarts", "cuts", "brakes")


def add_arguments(parser):
    parser.add_argument("--only", default="", metavar="N,N,...", help=f"numbers of scenarios, from 1 to {SCENARIOS}")
    parser.add_argument("--states", type=int, default=STATES, metavar="N", help=f"of each scenario at most (default {STATES})")
    parser.add_argument("--json", metavar="FILE", help="write the rows and the summary there")


def print_row(row):
    harm = ", ".join(f"{row[kind]} {kind}" for kind in HARM if row[kind] > 0)
    print(f"{row['scenario']:30}{harm:48}{row['states']:11}{row['transitions']:13}{row['depth']:7}{'yes' if row['complete'] else 'no':>10}"
          f"{row['seconds']:9.1f}  {row['violation'] or 'none'}", flush=True)
    for line in row["counterexample"]:
        print(f"    {line}")


def summarise(rows):
    return {"states": sum(row["states"] for row in rows), "transitions": sum(row["transitions"] for row in rows),
            "complete": sum(row["complete"] for row in rows), "violations": sum(bool(row["violation"]) for row in rows),
            "seconds": round(sum(row["seconds"] for row in rows), 1)}


def run(options):
    numbers = [int(number) for number in options.only.split(",")] if options.only else range(1, SCENARIOS + 1)
    program = benchmark.build("protocol")
    print(f"\n{'scenario':30}{'at most':48}{'states':>11}{'transitions':>13}{'depth':>7}{'complete':>10}{'time [s]':>9}  violation")
    rows = []
    for number in numbers:
        rows.append(benchmark.call(program, number - 1, options.states))
        print_row(rows[-1])
    summary = summarise(rows)
    print(f"\n{summary['states']} states, {summary['transitions']} transitions, {summary['violations']} violations")
    benchmark.write({"rows": rows, "summary": summary}, options.json)
    return 1 if summary["violations"] else 0
