"""Draws what the paths of a recorded fleet cost and what the team-mates' promises add to that, and the drives, as the paper's Figs. 14 and 15."""
import math
import os
from dataclasses import dataclass

import matplotlib
matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
import rosbag
from matplotlib.patches import Circle

from mocha_scripts import bags, drive_plots, worlds
from mocha_scripts.complaint import Complaint
from mocha_scripts.map_topics import NewestMap
from mocha_scripts.world_plot import COLORS, draw_world
from mocha_ugv.msg import MotionPhase, PlannerStatus

EVERY_S = 2.0  # the robots of the time-lapse are drawn
STEP_S = 0.05  # at which promises are sampled
WIDTH_IN = 15.0
LABEL_SHARE = np.array((0.10, 0.03))  # half a label, of the width that is shown
TEAM_MATE = "moving"  # name of the term (33)


@dataclass
class Plan:
    """The paths of one plan (Candidate messages), the map, and the promises of driving team-mates that were known then."""
    time_s: float
    ways: list
    grid: object  # OccupancyGrid
    promises: dict  # agent: places (N x 2) [m]


class Recording:
    """What a bag says of each robot: its plans that found a path, what it heard, and its ground truth."""

    def __init__(self, bag, names):
        self.plans = {name: [] for name in names}
        self._heard = {name: [] for name in names}  # (time, trajectories)
        truth = {name: [] for name in names}  # time, x, y
        maps = {name: NewestMap() for name in names}
        topics = [f"/{name}/{topic}" for name in names for topic in ("candidates", "fleet/trajectories", "map", "map_updates")]
        with rosbag.Bag(bag) as messages:
            for topic, message, _ in messages.read_messages(topics + ["/fleet_simulator/ground_truth"]):
                stamp, name = message.header.stamp.to_sec(), topic.split("/")[1]
                if topic.endswith("/fleet/trajectories"):
                    self._heard[name].append((stamp, [one for one in message.trajectories if drives(one)]))
                elif topic.endswith("/candidates"):
                    if any(way.selected for way in message.candidates):
                        self.plans[name].append(Plan(stamp, message.candidates, maps[name].grid, {}))
                elif topic.endswith(("/map", "/map_updates")):
                    maps[name].take(topic, message)
                else:
                    for one in message.robots:
                        truth[one.name].append((stamp, one.pose.x, one.pose.y))
        self.truth = {name: np.array(rows) for name, rows in truth.items()}
        for name in names:
            for plan in self.plans[name]:
                plan.promises = self._promises(name, plan.time_s)

    def _promises(self, name, time_s):
        known = [trajectories for stamp, trajectories in self._heard[name] if stamp < time_s]
        return {one.agent: promised_places(one) for one in known[-1]} if known else {}

    def leader(self):
        """The first robot to promise a drive; None where none did."""
        promised = [(stamp, one.agent) for heard in self._heard.values() for stamp, trajectories in heard for one in trajectories]
        return min(promised)[1] if promised else None

    def telling_plan(self, name):
        """The leader's first plan, every other robot's first that knew a promise of a team-mate's drive; and the plan before it. None where
        there is no such plan."""
        plans = self.plans[name]
        index = 0 if name == self.leader() else next((k for k, plan in enumerate(plans) if plan.promises), len(plans))
        return (plans[index] if index < len(plans) else None), (plans[index - 1] if 0 < index < len(plans) else None)


def drives(trajectory):
    return any(phase.kind == MotionPhase.DRIVE for phase in trajectory.phases)


def promised_places(trajectory):
    return np.vstack([minco_places(phase, trajectory.s) for phase in trajectory.phases if phase.kind == MotionPhase.DRIVE])


def powers(time_s, order, derivative):
    """The derivatives of 1, t, t^2 ... at a time."""
    row = np.zeros(order)
    for k in range(derivative, order):
        row[k] = math.perm(k, derivative) * time_s ** (k - derivative)
    return row


def minco_places(phase, s):
    """Places along a DRIVE phase: the spline of degree 2s - 1 through its knots whose derivatives up to 2s - 2 are continuous (5)(6)."""
    knots, durations, order = np.column_stack((phase.x, phase.y)), phase.durations, 2 * s
    pieces = len(durations)
    rows, values = [], []

    def require(value, *parts):
        rows.append(np.zeros(pieces * order))
        for piece, part in parts:
            rows[-1][piece * order:(piece + 1) * order] = part
        values.append(value)

    ends = ((0, 0.0, knots[0], phase.start_derivatives), (pieces - 1, durations[-1], knots[-1], phase.end_derivatives))
    for piece, time_s, place, derivatives in ends:
        for derivative, value in enumerate([place, *np.reshape(derivatives, (s - 1, 2))]):
            require(value, (piece, powers(time_s, order, derivative)))
    for piece in range(pieces - 1):
        require(knots[piece + 1], (piece + 1, powers(0.0, order, 0)))
        for derivative in range(order - 1):
            require((0.0, 0.0), (piece, powers(durations[piece], order, derivative)), (piece + 1, -powers(0.0, order, derivative)))
    coefficients = np.linalg.solve(np.array(rows), np.array(values)).reshape(pieces, order, 2)
    return np.vstack([[powers(time_s, order, 0) @ piece for time_s in np.linspace(0.0, length, max(2, int(length / STEP_S)))]
                      for piece, length in zip(coefficients, durations)])


def places(way):
    return np.array([(point.x, point.y) for point in way.path])


def solved(way):
    return way.status.reason == PlannerStatus.SOLVED


def due_to_team_mate(way):
    """Value of (33) in the cost, which has no such term while no team-mate is known; None where no cost was made out."""
    return sum(term.value for term in way.terms if term.name == TEAM_MATE) if solved(way) else None


def describe(way):
    if solved(way):
        return f"{way.cost:.1f}"
    if way.status.reason == PlannerStatus.CANNOT_WIN:
        return f"given up at {way.cost:.1f}" if way.terms else f"at least {way.cost:.1f}"
    return "not certified"


def signature(path, circles):
    """Signed crossings of the ray upwards from the centre of each cylinder: the same in every plan, other than the planner's, which
    counts round what its map holds."""
    before, after = path[:-1], path[1:]
    crossings = []
    for x, y, _ in circles:
        sides = (after[:, 0] > x).astype(int) - (before[:, 0] > x).astype(int)
        crossings.append(int(sides[0.5 * (before[:, 1] + after[:, 1]) > y].sum()))
    return crossings


def cost_before(way, before, circles):
    """What the same path cost in the plan before; None where that did not make it out."""
    own = signature(places(way), circles)
    return min((one.cost for one in (before.ways if before else []) if solved(one) and signature(places(one), circles) == own), default=None)


def label_places(paths, size):
    """For every path a place that is far from the other paths and where no label of that half size is yet."""
    chosen = []
    inner = [path[len(path) // 10:len(path) - len(path) // 10] for path in paths]
    for i, path in enumerate(inner):
        apart = [min((np.hypot(*(other - place).T).min() for k, other in enumerate(paths) if k != i), default=0.0) for place in path]
        covered = [max(0.0, 2.0 - min((np.abs((place - taken) / size).max() for taken in chosen), default=2.0)) for place in path]
        chosen.append(path[int(np.argmax(np.minimum(apart, 1.0) - 10.0 * np.array(covered)))])
    return chosen


def draw_ways(axes, plan, before, world):
    paths = [places(way) for way in plan.ways]
    labels = label_places([path for way, path in zip(plan.ways, paths) if solved(way)], LABEL_SHARE * np.ptp(window(plan, world)))
    for i, (way, path) in enumerate(zip(plan.ways, paths)):
        color, text = COLORS[i % len(COLORS)], describe(way)
        if solved(way):
            was = cost_before(way, before, world.get("circles") or [])
            text = (f"{was:.1f} \u2192 " if was is not None else "") + f"{text} ({due_to_team_mate(way):.1f})"
            axes.annotate(text, labels.pop(0), color=color, weight="bold", ha="center", va="center", zorder=6,
                          bbox={"boxstyle": "round,pad=0.15", "fc": "w", "ec": color, "alpha": 0.9})
        axes.plot(*path.T, color=color, lw=4.0 if way.selected else 1.8 if solved(way) else 1.0, ls="-" if solved(way) else ":",
                  zorder=4 if way.selected else 3, label=text + (", chosen" if way.selected else ""))


def draw_plan(axes, name, plan, before, world, radius_m):
    if plan.grid is not None:
        drive_plots.draw_grid(axes, plan.grid)
    axes.set_facecolor("0.8")
    drive_plots.draw_obstacles(axes, world)
    draw_ways(axes, plan, before, world)
    for agent, promise in plan.promises.items():
        axes.plot(*promise.T, "k--", lw=2.2, zorder=5, label=f"promised by {agent}")
        axes.add_patch(Circle(promise[0], radius_m[agent], fc="none", ec="k", ls="--", zorder=5))
    start, goal = places(plan.ways[0])[[0, -1]]
    axes.add_patch(Circle(start, radius_m[name], fc="w", ec="k", zorder=7))
    axes.annotate(name, start, ha="center", va="center", fontsize=7, zorder=8)
    axes.plot(*goal, "*", color="w", ms=15, mec="k", zorder=7)
    knows = "knows the promise of " + " and ".join(sorted(plan.promises)) if plan.promises else "no drive is promised yet"
    axes.set(aspect="equal", xlim=window(plan, world), ylim=[world["bounds"][end][1] for end in ("min", "max")], xlabel="x [m]", ylabel="y [m]",
             title=f"{name} plans at {plan.time_s:.2f} s on its map (grey: not seen yet): {knows}")
    earlier = f"in its plan at {before.time_s:.2f} s \u2192\n" if before else ""
    axes.legend(loc="upper left", bbox_to_anchor=(1.0, 1.0), fontsize=9, title=f"cost {earlier}now (of which (33),\ndue to team-mates)")


def window(plan, world):
    """What to show of the x axis: everything planned and promised."""
    x = np.concatenate([places(way)[:, 0] for way in plan.ways] + [promise[:, 0] for promise in plan.promises.values()])
    return max(world["bounds"]["min"][0], x.min() - 1.0), min(world["bounds"]["max"][0], x.max() + 1.0)


def draw_time_lapse(axes, truth, world, radius_m):
    draw_world(axes, world)
    moving = {name: moving_s(track) for name, track in truth.items()}
    begin = min(first for first, _ in moving.values())
    for i, (name, track) in enumerate(sorted(truth.items())):
        color = drive_plots.COLOURS[i % len(drive_plots.COLOURS)]
        axes.plot(track[:, 1], track[:, 2], color=color, lw=1.5, label=name, zorder=3)
        for time_s in np.arange(begin, moving[name][1] + EVERY_S, EVERY_S):
            place = [np.interp(time_s, track[:, 0], track[:, column]) for column in (1, 2)]
            axes.add_patch(Circle(place, radius_m[name], fc=color, ec="k", lw=0.6, alpha=0.45, zorder=4))
            axes.annotate(f"{time_s - begin:.0f}", place, ha="center", va="center", fontsize=7, zorder=5)
    axes.set(aspect="equal", xlabel="x [m]", ylabel="y [m]", title=f"Driven: the robots every {EVERY_S:.0f} s, with the time [s], ground truth")
    axes.legend(loc="upper left", bbox_to_anchor=(1.0, 1.0))


def moving_s(track):
    """From when to when a robot drove: when it had left its first place by a centimetre, and when its last one was so near."""
    away = [np.flatnonzero(np.hypot(*(track[:, 1:] - track[end, 1:]).T) > 0.01) for end in (0, -1)]
    return (track[away[0][0], 0] if len(away[0]) else track[-1, 0]), (track[away[1][-1], 0] if len(away[1]) else track[0, 0])


def save(figure, path):
    figure.tight_layout()
    figure.savefig(path, dpi=110, bbox_inches="tight")  # the legends stand outside
    plt.close(figure)


def table(told, circles):
    def number(value):
        return "-" if value is None else f"{value:.1f}"

    lines = ["robot      plan [s]  way  cost              of which (33)  plan before  chosen"]
    for name, (plan, before) in told.items():
        for i, way in enumerate(plan.ways, 1):
            lines.append(f"{name:<10} {plan.time_s:8.2f} {i:4d}  {describe(way):<18}{number(due_to_team_mate(way)):>12}"
                         f"{number(cost_before(way, before, circles)):>13}  {'yes' if way.selected else ''}".rstrip())
    return "\n".join(lines)


def draw_costs(bag, world_path, out):
    """Writes costs.png (Fig. 14) and time_lapse.png (Fig. 15) to the directory `out`. Returns the costs as a table."""
    world = worlds.read_world(world_path)
    bags.check_drive(bag, world, world_path)
    radius_m = {robot["name"]: robot.get("radius", worlds.robot_values(robot["model"])["footprint_radius"]) for robot in world["robots"]}
    recording = Recording(bag, list(radius_m))
    told = {name: recording.telling_plan(name) for name in radius_m}
    told = {name: (plan, before) for name, (plan, before) in told.items() if plan}
    if not told:
        raise Complaint(f"{bag}: no robot of {world_path} has planned")
    height_m = world["bounds"]["max"][1] - world["bounds"]["min"][1]
    spans_m = [np.ptp(window(plan, world)) for plan, _ in told.values()]
    heights = [min(7.0, 0.8 * WIDTH_IN * height_m / span_m) + 0.8 for span_m in spans_m]
    figure, axes = plt.subplots(len(told), 1, figsize=(WIDTH_IN, sum(heights)), gridspec_kw={"height_ratios": heights}, squeeze=False)
    for (name, (plan, before)), panel in zip(told.items(), axes[:, 0]):
        draw_plan(panel, name, plan, before, world, radius_m)
    save(figure, os.path.join(out, "costs.png"))
    width_m = world["bounds"]["max"][0] - world["bounds"]["min"][0]
    figure, panel = plt.subplots(figsize=(WIDTH_IN, min(14.0, 0.9 * WIDTH_IN * height_m / width_m) + 0.8))
    draw_time_lapse(panel, recording.truth, world, radius_m)
    save(figure, os.path.join(out, "time_lapse.png"))
    return table(told, world.get("circles") or [])
