"""The paper's Table I: motion camouflage against plain MINCO, in the plane and in space, at 1, 5 and 8 m between knots.

Both methods have the same evaluator, solver, start and stopping rule. 20 worlds of 65 circles and 20 forests; v_max 12 m/s, a_max 5 m/s2,
20 samples a piece, w_e = w_t = 1, w_o = w_d = 100. t_plan is from the front-end path to the certified trajectory.
"""
import statistics

from benchmarks import benchmark

SPACINGS_M = (1, 5, 8)
METHODS = ("minco", "camouflage")
# t_plan [s], T [s], L [m], J
PAPER = {(2, "camouflage"): (1.86, 17.51, 146.24, 409.57), (2, "minco"): (2.51, 17.15, 146.89, 400.12),
         (3, "camouflage"): (1.74, 21.11, 178.3, 494.34), (3, "minco"): (2.43, 19.19, 175.4, 419.06)}


def add_arguments(parser):
    parser.add_argument("--worlds", type=int, default=20, metavar="N", help="of each kind (default 20)")
    parser.add_argument("--json", metavar="FILE", help="write the rows and the summary there")


def median(rows, key):
    return statistics.median(row[key] for row in rows)


def select(rows, dim, method, spacing_m):
    return [row for row in rows if (row["dim"], row["method"], row["spacing_m"]) == (dim, method, spacing_m)]


def ratio_summary(ours, theirs):
    """Median and range of pairwise ratios, world by world."""
    theirs = {row["world"]: row for row in theirs}
    summary = {}
    for key in ("t_plan_s", "evaluations", "J", "T_s"):
        ratios = [row[key] / theirs[row["world"]][key] for row in ours]
        summary[key] = {"median": round(statistics.median(ratios), 4), "least": round(min(ratios), 4),
                        "most": round(max(ratios), 4)}
    return summary


def print_dimension(rows, dim, summary):
    print(f"\n{'circles in the plane' if dim == 2 else 'trunks in space'}, medians over the worlds")
    print(f"{'method':12}{'knots':>6}{'t_plan':>9}{'evals':>7}{'J':>8}{'J/best':>8}{'T':>7}{'L':>8}{'clear.':>8}{'ex. v':>8}"
          f"{'ex. a':>8}{'T/kin.':>8}{'T/opt.':>8}  feasible")
    for spacing_m in SPACINGS_M:
        for method in METHODS:
            chosen = select(rows, dim, method, spacing_m)
            feasible = sum(row["feasible"] for row in chosen)
            print(f"{method:12}{spacing_m:4} m{1e3 * median(chosen, 't_plan_s'):6.1f} ms{median(chosen, 'evaluations'):7.0f}"
                  f"{median(chosen, 'J'):8.2f}{median(chosen, 'J_over_best'):8.4f}{median(chosen, 'T_s'):7.2f}"
                  f"{median(chosen, 'L_m'):8.2f}{min(row['clearance_m'] for row in chosen):8.3f}"
                  f"{max(0.0, *(row['excess_speed'] for row in chosen)):8.4f}"
                  f"{max(0.0, *(row['excess_acceleration'] for row in chosen)):8.4f}"
                  f"{median(chosen, 'T_over_kinematic_limit'):8.3f}{median(chosen, 'T_over_own_optimum'):8.3f}"
                  f"  {feasible}/{len(chosen)}")
            summary[f"{dim}d_{method}_{spacing_m}m"] = {
                "t_plan_s": median(chosen, "t_plan_s"), "evaluations": median(chosen, "evaluations"),
                "J": median(chosen, "J"), "J_over_best": median(chosen, "J_over_best"), "feasible": feasible}
    for method in METHODS:
        t_plan_s, duration_s, length_m, cost = PAPER[(dim, method)]
        print(f"{'paper, ' + method[:5]:12}{1:4} m{1e3 * t_plan_s:6.0f} ms{'':7}{cost:8.2f}{'':8}{duration_s:7.2f}{length_m:8.2f}")


def print_ratios(rows, dim, summary):
    print("camouflage / MINCO, pairwise: median (least to most)")
    pairs = [(f"{spacing} m / {spacing} m", spacing, spacing) for spacing in SPACINGS_M]
    pairs += [("5 m / 1 m", 5, 1), ("8 m / 1 m", 8, 1)]
    for label, ours, theirs in pairs:
        ratios = ratio_summary(select(rows, dim, "camouflage", ours), select(rows, dim, "minco", theirs))
        summary[f"{dim}d_camouflage_{ours}m_over_minco_{theirs}m"] = ratios
        print(f"  {label:11}" + "   ".join(f"{key} {value['median']:.3f} ({value['least']:.3f} to {value['most']:.3f})"
                                           for key, value in ratios.items()))


def run(options):
    result = benchmark.run("table1", options.worlds)
    rows = result["rows"]
    for dim in (2, 3):
        for world in {row["world"] for row in rows}:
            same = [row for row in rows if (row["dim"], row["world"]) == (dim, world)]
            best = min(row["J"] for row in same)
            for row in same:
                row["J_over_best"] = round(row["J"] / best, 6)
    summary = {}
    for dim in (2, 3):
        print_dimension(rows, dim, summary)
        print_ratios(rows, dim, summary)
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
