"""Measurements by name."""
import argparse
import sys

from benchmarks import (bench_barn, bench_crossing, bench_crowds, bench_deadlock, bench_dynabarn, bench_evaluation, bench_faults,
                        bench_fleet_delay, bench_fleet_scale, bench_footprint, bench_leaving, bench_localization, bench_mapping, bench_maps,
                        bench_prediction, bench_protocol, bench_replan, bench_soak, bench_space, bench_table1, bench_table2, bench_table3,
                        bench_tracking)
from mocha_scripts.complaint import Complaint

BENCHES = {"barn": bench_barn, "crossing": bench_crossing, "crowds": bench_crowds, "deadlock": bench_deadlock,
           "dynabarn": bench_dynabarn, "evaluation": bench_evaluation, "faults": bench_faults, "fleet_delay": bench_fleet_delay,
           "fleet_scale": bench_fleet_scale, "footprint": bench_footprint, "leaving": bench_leaving,
           "localization": bench_localization, "mapping": bench_mapping, "maps": bench_maps, "prediction": bench_prediction, "protocol": bench_protocol,
           "replan": bench_replan, "soak": bench_soak, "space": bench_space, "table1": bench_table1, "table2": bench_table2, "table3": bench_table3,
           "tracking": bench_tracking}


def main(arguments):
    parser = argparse.ArgumentParser(prog="scripts/bench", description=__doc__)
    names = parser.add_subparsers(dest="name", metavar="NAME", required=True)
    for name, module in BENCHES.items():
        module.add_arguments(names.add_parser(name, help=module.__doc__.strip().split("\n")[0],
                                              description=module.__doc__))
    options = parser.parse_args(arguments)
    try:
        return BENCHES[options.name].run(options)
    except Complaint as complaint:
        print(f"bench: {complaint}", file=sys.stderr)
        return 1


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
