"""What a robot's planning, talking and remembering cost as the fleet grows, at constant density.

Every robot has 40 m^2 and a pillar to itself and drives 8 m. Messages go as far as radio_range is by default, which is to about 70 others;
--reach says how far instead (inf: all hear all, which takes long beyond some hundred).
All planners run in one process, in simulated time, each on one thread. Where fleets are smaller, as many of them run side by side as make up
the same number of robots, each by itself: so many robots find little of what they need in the processor's caches, which no robot of a real
fleet shares with others. replan_s is the processor time of a global plan, step_s that of a step of the local replanner, both in the median;
bytes_per_s is what one robot sends; memory_bytes is what is held at the end, by the number of robots; protocol is the share of one core that
one robot's part in the protocol takes, news that of taking over what others promise.
"""
from benchmarks import benchmark

AGENTS = (5, 20, 50, 100, 200, 1000)
TIME_S = 8.0
REACH_M = 30.0


def counts(text):
    return tuple(int(each) for each in text.split(","))


def add_arguments(parser):
    parser.add_argument("--agents", type=counts, default=AGENTS, metavar="N,N,...", help="sizes of the fleet")
    parser.add_argument("--time", type=float, default=TIME_S, metavar="S", help=f"simulated time of each run (default {TIME_S:g})")
    parser.add_argument("--reach", type=float, default=REACH_M, metavar="M",
                        help=f"how far messages reach (default {REACH_M:g}; inf: all hear all)")
    parser.add_argument("--seed", type=int, default=1, metavar="N", help="of the scenes (default 1)")
    parser.add_argument("--json", metavar="FILE", help="write the rows and the summary there")


def print_table(rows):
    print(f"\n{'agents':>6}{'replan [ms]':>13}{'step [ms]':>11}{'kB/s sent':>11}{'largest [B]':>13}{'memory [MB]':>13}{'protocol':>10}{'news':>8}"
          f"{'contacts':>10}{'least sep. [m]':>16}")
    for row in rows:
        print(f"{row['agents']:6}{1e3 * row['replan_s']:13.2f}{1e3 * row['step_s']:11.2f}{1e-3 * row['bytes_per_s']:11.2f}"
              f"{row['largest_datagram']:13}{1e-6 * row['memory_bytes']:13.2f}{100 * row['protocol_share']:9.2f}%{100 * row['news_share']:7.2f}%{row['contacts']:10}"
              f"{row['min_separation_m']:16.3f}")


def summarise(rows):
    first, last = rows[0], rows[-1]
    return {"agents": [first["agents"], last["agents"]], "contacts": sum(row["contacts"] for row in rows),
            **{f"{key}_ratio": round(last[key] / first[key], 3) for key in ("replan_s", "step_s", "bytes_per_s", "memory_bytes")}}


def run(options):
    program = benchmark.build("fleet_scale")
    together = max(options.agents)
    rows = [benchmark.call(program, options.time, options.reach, options.seed, agents, together // agents) for agents in options.agents]
    summary = summarise(rows)
    print_table(rows)
    print(f"\n{summary['agents'][1]} robots against {summary['agents'][0]}: a plan takes {summary['replan_s_ratio']:.2f} times as long, a step"
          f" of the local replanner {summary['step_s_ratio']:.2f} times")
    benchmark.write({"rows": rows, "summary": summary}, options.json)
    return 0
