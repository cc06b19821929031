"""The paper's Table I: motion camouflage against plain MINCO at fixed spacing, and both against adaptive knots.

Knots are 1, 3, 5 and 8 m apart; or they move along their rays until more is worth it, and stand where they are worth it. All methods have the
same evaluator, solver, front-end path, pace at the start and stopping rule. 20 worlds of 65 circles and 20 forests, whose paths keep clear of
all penalties, as many dense ones, whose paths do not, and three that are built; paths in space are those of a roadmap in space. v_max 12 m/s, a_max 5 m/s2, 20 samples a piece, w_e = w_t = 1, w_o = w_d = 100.
t_plan is from the front-end path to the certified trajectory, the least of 7 turns of all methods. J is that of the curve with samples 2 cm
apart.
"""
import statistics

from benchmarks import benchmark

SPACINGS_M = (1, 3, 5, 8)
METHODS = ("minco", "camouflage")
KINDS = (("open", 2), ("open", 3), ("dense", 2), ("dense", 3), ("built", 3))
TITLES = {("open", 2): "circles in the plane", ("open", 3): "trunks in space",
          ("dense", 2): "dense circles in the plane", ("dense", 3): "dense trunks in space",
          ("built", 3): "a wall with two windows, a ring and two storeys, ten times as large"}
NEAR_BEST = 1.001  # times the least cost of the fixed choices
# t_plan [s], T [s], L [m], J
PAPER = {(2, "camouflage"): (1.86, 17.51, 146.24, 409.57), (2, "minco"): (2.51, 17.15, 146.89, 400.12),
         (3, "camouflage"): (1.74, 21.11, 178.3, 494.34), (3, "minco"): (2.43, 19.19, 175.4, 419.06)}


def add_arguments(parser):
    parser.add_argument("--worlds", type=int, default=20, metavar="N", help="of each kind (default 20)")
    parser.add_argument("--first", type=int, default=1, metavar="SEED", help="seed of the first world (default 1)")
    parser.add_argument("--json", metavar="FILE", help="write the rows and the summary there")


def median(rows, key):
    return statistics.median(row[key] for row in rows)


def select(rows, method, spacing_m):
    return [row for row in rows if (row["method"], row["spacing_m"]) == (method, spacing_m)]


def ratio_summary(ours, theirs):
    """Median and range of pairwise ratios, world by world."""
    theirs = {row["world"]: row for row in theirs}
    summary = {}
    for key in ("t_plan_s", "evaluations", "piece_evaluations", "J", "T_s"):
        ratios = [row[key] / theirs[row["world"]][key] for row in ours if row["world"] in theirs]
        if not ratios:
            continue
        summary[key] = {"median": round(statistics.median(ratios), 4), "least": round(min(ratios), 4),
                        "most": round(max(ratios), 4)}
    return summary


def ratio_text(ratios):
    return "   ".join(f"{key} {value['median']:.3f} ({value['least']:.3f} to {value['most']:.3f})" for key, value in ratios.items())


def print_ratios(rows, name, summary):
    print("camouflage / MINCO, pairwise: median (least to most)")
    pairs = [(f"{spacing} m / {spacing} m", spacing, spacing) for spacing in SPACINGS_M]
    pairs += [("5 m / 1 m", 5, 1), ("8 m / 1 m", 8, 1)]
    for label, ours, theirs in pairs:
        ratios = ratio_summary(select(rows, "camouflage", ours), select(rows, "minco", theirs))
        summary[f"{name}_camouflage_{ours}m_over_minco_{theirs}m"] = ratios
        print(f"  {label:11}{ratio_text(ratios)}")


def print_methods(rows, dim, name, summary):
    print(f"{'method':12}{'knots':>6}{'t_plan':>10}{'evals':>7}{'pieces':>7}{'vars':>6}{'J':>8}{'J/best':>8}{'T':>7}{'L':>8}{'clear.':>8}"
          f"{'ex. v':>8}{'ex. a':>8}{'T/kin.':>8}{'T/opt.':>8}  feasible")
    for method, spacing_m in [(method, spacing_m) for spacing_m in SPACINGS_M for method in METHODS] + [("adaptive", 0)]:
        chosen = select(rows, method, spacing_m)
        feasible = sum(row["feasible"] for row in chosen)
        label = f"{spacing_m:4} m" if spacing_m else "      "
        print(f"{method:12}{label}{1e3 * median(chosen, 't_plan_s'):7.1f} ms{median(chosen, 'evaluations'):7.0f}"
              f"{median(chosen, 'pieces'):7.0f}{median(chosen, 'variables'):6.0f}"
              f"{median(chosen, 'J'):8.2f}{median(chosen, 'J_over_best'):8.4f}{median(chosen, 'T_s'):7.2f}"
              f"{median(chosen, 'L_m'):8.2f}{min(row['clearance_m'] for row in chosen):8.3f}"
              f"{max(0.0, *(row['excess_speed'] for row in chosen)):8.4f}"
              f"{max(0.0, *(row['excess_acceleration'] for row in chosen)):8.4f}"
              f"{median(chosen, 'T_over_kinematic_limit'):8.3f}{median(chosen, 'T_over_own_optimum'):8.3f}"
              f"  {feasible}/{len(chosen)}")
        summary[f"{name}_{method}" + (f"_{spacing_m}m" if spacing_m else "")] = {
            "t_plan_s": median(chosen, "t_plan_s"), "evaluations": median(chosen, "evaluations"),
            "J": median(chosen, "J"), "J_over_best": median(chosen, "J_over_best"), "feasible": feasible}
    for method in METHODS:
        t_plan_s, duration_s, length_m, cost = PAPER[(dim, method)]
        print(f"{'paper, ' + method[:5]:12}{1:4} m{1e3 * t_plan_s:7.0f} ms{'':20}{cost:8.2f}{'':8}{duration_s:7.2f}{length_m:8.2f}")


def best_fixed(rows):
    """Of each world, the fastest certified fixed choice whose cost is near the least."""
    best = {}
    for world in {row["world"] for row in rows}:
        certified = [row for row in rows if row["world"] == world and row["method"] in METHODS and row["feasible"]]
        if not certified:
            continue
        least = min(row["J"] for row in certified)
        best[world] = min((row for row in certified if row["J"] <= NEAR_BEST * least), key=lambda row: row["t_plan_s"])
        best[world]["least_J"] = least
    return best


def print_adaptive(rows, name, summary):
    """What nobody knows beforehand, the best fixed choice of each world, against adaptive knots."""
    adaptive = select(rows, "adaptive", 0)
    print(f"adaptive, over the fastest fixed choice of each world within {100 * (NEAR_BEST - 1):.1f} % of the least cost")
    best = best_fixed(rows)
    ratios = ratio_summary(adaptive, best.values())
    over_least = [row["J"] / best[row["world"]]["least_J"] for row in adaptive if row["world"] in best]
    ratios["J_over_least"] = {"median": round(statistics.median(over_least), 4), "least": round(min(over_least), 4),
                              "most": round(max(over_least), 4)}
    choices = [f"{row['method']} {row['spacing_m']} m" for row in best.values()]
    counts = ", ".join(f"{choice} in {choices.count(choice)}" for choice in sorted(set(choices)))
    slower = sum(row["t_plan_s"] > best[row["world"]]["t_plan_s"] for row in adaptive if row["world"] in best)
    dearer = sum(share > NEAR_BEST for share in over_least)
    print(f"  {ratio_text(ratios)}")
    print(f"  it is slower in {slower} worlds and dearer by more than that in {dearer} of {len(over_least)}; the fixed choices: {counts}")
    for spacing_m in SPACINGS_M:
        for method in METHODS:
            print(f"  / {method + f' {spacing_m} m':15}{ratio_text(ratio_summary(adaptive, select(rows, method, spacing_m)))}")
    summary[f"{name}_adaptive_over_best_fixed"] = {**ratios, "slower": slower, "dearer": dearer, "choices": counts}


def run(options):
    result = benchmark.run("table1", options.worlds, options.first)
    rows = result["rows"]
    for row in rows:
        same = [other["J"] for other in rows if all(other[key] == row[key] for key in ("kind", "dim", "world"))]
        row["J_over_best"] = round(row["J"] / min(same), 6)
    summary = {}
    for kind, dim in KINDS:
        name = f"{dim}d" if kind == "open" else f"{dim}d_{kind}"
        chosen = [row for row in rows if (row["kind"], row["dim"]) == (kind, dim)]
        print(f"\n{TITLES[kind, dim]}, medians over the worlds")
        print_ratios(chosen, name, summary)
        print_methods(chosen, dim, name, summary)
        print_adaptive(chosen, name, summary)
    print_fast(result["fast"], summary)
    benchmark.write({"rows": rows, "fast": result["fast"], "summary": summary}, options.json)
    return 0


def print_fast(rows, summary):
    """Weights that ask for speed."""
    print("\nwith weights that ask for speed, camouflage in the plane, certified")
    for limits in sorted({(row["max_speed"], row["max_acceleration"]) for row in rows}):
        chosen = [row for row in rows if (row["max_speed"], row["max_acceleration"]) == limits]
        feasible = sum(row["feasible"] for row in chosen)
        kinematic = [row["T_over_kinematic_limit"] for row in chosen]
        own = [row["T_over_own_optimum"] for row in chosen]
        print(f"  v_max {limits[0]:g} m/s, a_max {limits[1]:g} m/s2: T over L/v_max + v_max/a_max {statistics.median(kinematic):.3f}"
              f" (worst {max(kinematic):.3f}), over the time-optimal drive of its own path {statistics.median(own):.3f}"
              f" (worst {max(own):.3f}), t_plan {1e3 * median(chosen, 't_plan_s'):.1f} ms, feasible {feasible}/{len(chosen)}")
        summary[f"fast_{limits[0]:g}"] = {"T_over_kinematic_limit": max(kinematic), "T_over_own_optimum": max(own),
                                          "feasible": feasible}
