"""How worlds are drawn, and colours to tell paths of different classes apart."""
from matplotlib.patches import Circle, Polygon

COLORS = ("#d6247f", "#1f77b4", "#2ca02c", "#ff7f0e", "#7b3fb5", "#00a6a6", "#8c564b", "#8a8a12")


def draw_world(axes, world):
    """What stands in a world file, and what is not to be entered."""
    for x, y, radius in world.get("circles", []):
        axes.add_patch(Circle((x, y), radius, fc="#d9d9d9", ec="#969696", lw=0.6))
    for corners in world.get("polygons", []):
        axes.add_patch(Polygon(corners, fc="#bdbdbd", ec="#969696", lw=0.6))
    for zone in world.get("keep_out", []):
        corners = zone["polygon"] if isinstance(zone, dict) else zone
        axes.add_patch(Polygon(corners, fc="#fddbc7", ec="#d6604d", lw=0.6, hatch="//"))
    axes.set(xlim=[world["bounds"][end][0] for end in ("min", "max")], ylim=[world["bounds"][end][1] for end in ("min", "max")])
