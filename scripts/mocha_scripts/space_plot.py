"""Draws a plan in space: what stands, the curves that tell classes apart, and the trajectories."""
import matplotlib
matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

MOST_POINTS = 60000
VIEWS = ((28, -62), (90, -90))  # elevation and azimuth [degrees]: at a slant, and from above


def inside(points, bounds):
    """Those stretches of a polyline that are in the box, cut at its faces; nothing of it is drawn beyond."""
    points = np.asarray(points, dtype=float)
    steps = np.concatenate([np.linspace(a, b, 50) for a, b in zip(points[:-1], points[1:])])
    is_in = np.all((steps >= bounds[0]) & (steps <= bounds[1]), axis=1)
    steps[~is_in] = np.nan
    return steps


def curve_points(kind, corners, bounds):
    if kind == "column":
        x, y = corners
        return np.array([[x, y, bounds[0][2]], [x, y, bounds[1][2]]])
    return np.array(list(corners) + ([corners[0]] if kind == "loop" else []))


def draw_plan(planner, curves, plan, options):
    """Writes the picture that the options name."""
    bounds = np.array(planner.bounds)
    surface = np.array(planner.surface()).reshape(-1, 3)
    surface = surface[::1 + len(surface) // MOST_POINTS]
    figure = plt.figure(figsize=(15, 7))
    for column, (elevation, azimuth) in enumerate(VIEWS, 1):
        axes = figure.add_subplot(1, 2, column, projection="3d", computed_zorder=False)
        axes.scatter(*surface.T, s=1.5, c=surface[:, 2], cmap="Greys", vmin=bounds[0][2] - 2, vmax=bounds[1][2] + 2, alpha=0.12, zorder=1,
                     linewidths=0)
        for kind, corners in (curves or {"curves": []})["curves"]:
            axes.plot(*inside(curve_points(kind, corners, bounds), bounds).T, color="black", lw=0.8, ls=":", zorder=2)
        for number, each in reversed(list(enumerate(plan.candidates))):
            samples = np.array(each.sample(0.02)["place_m"]).reshape(-1, 3)
            label = f"{each.cost:.2f}" + ("" if each.certified else ", not certified")
            axes.plot(*samples.T, color=f"C{number}", lw=2.6 if number == 0 else 1.3, ls="-" if each.certified else "--", label=label, zorder=5)
        for name, point, colour in (("start", options.start, "tab:green"), ("goal", options.goal, "tab:red")):
            axes.scatter(*point, color=colour, s=40, zorder=6, label=name)
        axes.set(xlim=bounds[:, 0], ylim=bounds[:, 1], zlim=bounds[:, 2], xlabel="x [m]", ylabel="y [m]", zlabel="z [m]")
        axes.set_box_aspect(bounds[1] - bounds[0])
        axes.view_init(elevation, azimuth)
        if elevation == 90:
            axes.set_zticks([])
            axes.set_zlabel("")
    handles, labels = axes.get_legend_handles_labels()
    figure.legend(handles[::-1], labels[::-1], loc="lower center", ncol=8, title="cost", fontsize=9)
    figure.suptitle(f"{options.map}: {plan.reason}", fontsize=11)
    figure.savefig(options.picture, dpi=110, bbox_inches="tight")
    plt.close(figure)
