"""The paper's Table II: this package's planner against SST and BIT* of OMPL, on the way to three targets through circles in the plane.

10 worlds of 50 circles; robot radius 0.3 m, v_max 3 m/s, a_max 2 m/s2, obstacles checked every 0.1 m. t_plan is wall time from the
list of circles: for mocha to the selected certified motion, all classes included. mocha drives from rest to rest at the target; SST (a
double integrator, its cost the time) may pass within 1 m of the target at any speed. The paths of BIT*, after simplification, have
corners, so that nothing can drive them at speed: T is the kinematic limit L / v_max + v_max / a_max, and feasible is no. SST comes a
second time with its speed clipped at the limit, where the table's has it forbidden to exceed it.
"""
import statistics

from benchmarks import benchmark

TARGETS = (1, 2, 3)
METHODS = ("mocha", "sst_first", "sst_1.5s", "bitstar_first", "bitstar_0.1s")
COLUMNS = ("t_plan_s", "classes", "L_m", "T_s", "v_max", "v_avg", "T_over_kinematic_limit")
# t_plan [s], L [m], T [s], v_max, v_avg [m/s]
PAPER = {(1, "MOCHA"): (0.029, 144.57, 68.45, 3.00, 2.11), (1, "TRR"): (0.187, 145.80, 108.93, 2.14, 1.38),
         (1, "SST"): (1.506, 177.97, 103.05, 2.99, 1.72), (2, "MOCHA"): (0.026, 114.67, 50.48, 3.00, 2.27),
         (2, "TRR"): (0.229, 113.04, 81.79, 2.11, 1.38), (2, "SST"): (1.071, 159.39, 93.65, 2.94, 1.71),
         (3, "MOCHA"): (0.023, 93.21, 41.03, 2.98, 2.27), (3, "TRR"): (0.048, 91.11, 66.82, 2.34, 1.36),
         (3, "SST"): (1.059, 115.96, 69.75, 2.96, 1.66)}
MAX_SPEED, MAX_ACCELERATION = 3.0, 2.0


def add_arguments(parser):
    parser.add_argument("--worlds", type=int, default=10, metavar="N", help="how many (default 10)")
    parser.add_argument("--json", metavar="FILE", help="write the rows and the summary there")


def select(rows, method, target=None):
    """The rows of a method by world and target."""
    return {(row["world"], row["target"]): row for row in rows if row["method"] == method and target in (None, row["target"])}


def spread(values):
    """Median, least and most; None where there is nothing."""
    values = [value for value in values if value is not None]
    if not values:
        return None
    return {"median": round(statistics.median(values), 4), "least": round(min(values), 4), "most": round(max(values), 4)}


def ratios(ours, theirs, key):
    """Pairwise, world by world and target by target."""
    return spread([row[key] / theirs[task][key] for task, row in ours.items() if row[key] is not None and theirs[task][key] is not None])


def text(value, width, decimals=2):
    return f"{'-' if value is None else format(value, f'.{decimals}f'):>{width}}"


def print_row(name, t_plan_s, classes, figures, feasible):
    length_m, duration_s, top_speed, mean_speed, over_limit = figures
    t_plan_ms = None if t_plan_s is None else 1e3 * t_plan_s
    print(f"{name:14}{text(t_plan_ms, 9, 1)} ms{text(classes, 9, 0)}{text(length_m, 9)}{text(duration_s, 9)}"
          f"{text(top_speed, 7)}{text(mean_speed, 7)}{text(over_limit, 8, 3)}  {feasible}")


def print_target(rows, target, summary):
    print(f"\ntarget {target}, medians over the worlds, and the paper's")
    print(f"{'method':14}{'t_plan':>12}{'classes':>9}{'L [m]':>9}{'T [s]':>9}{'v_max':>7}{'v_avg':>7}{'T/kin.':>8}  feasible")
    for method in METHODS:
        chosen = select(rows, method, target).values()
        medians = {key: (spread(row[key] for row in chosen) or {}).get("median") for key in COLUMNS}
        feasible = sum(row["feasible"] for row in chosen)
        print_row(method, medians["t_plan_s"], medians["classes"], [medians[key] for key in COLUMNS[2:]], f"{feasible}/{len(chosen)}")
        summary[f"target{target}_{method}"] = {**medians, "feasible": feasible}
    for method in ("MOCHA", "TRR", "SST"):
        t_plan_s, length_m, duration_s, top_speed, mean_speed = PAPER[(target, method)]
        over_limit = duration_s / (length_m / MAX_SPEED + MAX_SPEED / MAX_ACCELERATION)
        print_row(f"paper, {method}", t_plan_s, None, (length_m, duration_s, top_speed, mean_speed, over_limit), "")


def print_ratios(rows, clipped, summary):
    """mocha's figures over the others', and the paper's."""
    print("\nmocha / other, pairwise: median (least to most)")
    mocha = select(rows, "mocha")
    others = {method: select(rows, method) for method in METHODS[1:]}
    others |= {f"{method}, clipped": select(clipped, method) for method in METHODS[1:3]}
    for method, theirs in others.items():
        found = {key: ratios(mocha, theirs, key) for key in ("t_plan_s", "L_m", "T_s")}
        summary[f"mocha_over_{method.replace(', ', '_')}"] = found
        print_spreads(method, found)
    for method in ("TRR", "SST"):
        found = [[ours / theirs for ours, theirs in zip(PAPER[(target, "MOCHA")], PAPER[(target, method)])] for target in TARGETS]
        print_spreads(f"in the paper, {method}", {key: spread(column) for key, column in zip(("t_plan_s", "L_m", "T_s"), zip(*found))})


def print_spreads(name, found):
    cells = [f"{key} {value['median']:.3f} ({value['least']:.3f} to {value['most']:.3f})" if value else f"{key} -"
             for key, value in found.items()]
    print(f"  {name:20}" + "   ".join(cells))


def print_aims(rows, summary):
    """What the planner is to reach, and what it does."""
    mocha = select(rows, "mocha").values()
    feasible = sum(row["feasible"] for row in mocha)
    print("\naims for mocha")
    print(f"  {'every target solved and certified':42}{feasible}/{len(mocha)}  {'met' if feasible == len(mocha) else 'MISSED'}")
    aims = [("T over sst_first's", summary["mocha_over_sst_first"]["T_s"], 0.6),
            ("T over sst_1.5s's", summary["mocha_over_sst_1.5s"]["T_s"], 0.6),
            ("T over the kinematic limit", spread(row["T_over_kinematic_limit"] for row in mocha), 1.10),
            ("L over bitstar_0.1s's", summary["mocha_over_bitstar_0.1s"]["L_m"], 1.03),
            ("t_plan over sst_first's", summary["mocha_over_sst_first"]["t_plan_s"], 0.5)]
    summary["aims"] = {"feasible": feasible}
    for name, found, most in aims:
        summary["aims"][name] = found
        if found:
            print(f"  {f'{name}: at most {most:g}':42}{found['median']:.3f} ({found['least']:.3f} to {found['most']:.3f})"
                  f"  {verdict(found, most)}")
    counts = sorted(row["classes"] for row in mocha)
    summary["aims"]["classes"] = spread(counts)
    print(f"  {'classes: at least 4 where they exist':42}{statistics.median(counts):g} ({counts[0]} to {counts[-1]})"
          f"  fewer than 4: {sum(count < 4 for count in counts)}/{len(counts)}")


def verdict(found, most):
    if found["most"] <= most:
        return "met everywhere"
    return "met by the median" if found["median"] <= most else "MISSED"


def run(options):
    result = benchmark.run("table2", options.worlds)
    rows, clipped = result["rows"], result["clipped"]
    summary = {}
    for target in TARGETS:
        print_target(rows, target, summary)
    print_ratios(rows, clipped, summary)
    print_aims(rows, summary)
    benchmark.write({"rows": rows, "clipped": clipped, "summary": summary}, options.json)
    return 0
