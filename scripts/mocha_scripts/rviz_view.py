"""What rviz shows of a world: all of it."""
import math
import os

import yaml

CONFIG = os.path.join(os.path.dirname(os.path.realpath(__file__)), "../../rviz/fleet.rviz")
SHOWN_PX = (1250, 480)  # of the window, beside the list of displays


def view_of(bounds):
    """Centre [m] and scale [pixels per metre] of the smallest view that holds the bounds of a world file. Raises ValueError where they hold nothing."""
    sides_m = [high - low for low, high in zip(bounds["min"], bounds["max"])]
    if not all(0.0 < side_m < math.inf for side_m in sides_m):
        raise ValueError(f"bounds {bounds} hold nothing")
    x_m, y_m = [0.5 * (low + high) for low, high in zip(bounds["min"], bounds["max"])]
    return x_m, y_m, min(pixels / side_m for pixels, side_m in zip(SHOWN_PX, sides_m))


def write(world, path):
    """Writes a copy of rviz/fleet.rviz that shows all of a world file. Where its bounds are none, which the simulator then says, the view is
    the shipped one."""
    with open(world) as file:
        content = yaml.safe_load(file)
    with open(CONFIG) as file:
        config = yaml.safe_load(file)
    current = config["Visualization Manager"]["Views"]["Current"]
    try:
        x_m, y_m, scale = view_of(content["bounds"])
    except (KeyError, TypeError, ValueError):
        pass
    else:
        current.update({"X": x_m, "Y": y_m, "Scale": scale})
    with open(path, "w") as file:
        yaml.safe_dump(config, file, sort_keys=False)
