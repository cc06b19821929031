"""World and robot files, read the simple way: for drawing and reports. The C++ loader is the one that judges them."""
import os

import yaml

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))


def read_world(path):
    """Models that are named by their paths are so relative to the world file; here, absolute."""
    with open(path) as file:
        world = yaml.safe_load(file)
    for robot in world.get("robots", ()):
        if robot["model"].endswith(".yaml"):
            robot["model"] = os.path.abspath(os.path.join(os.path.dirname(path), robot["model"]))
    return world


def robot_values(model):
    """Values of a model, config/robots/<model>.yaml or a file of one's own, over the defaults of its schema."""
    with open(os.path.join(ROOT, "config/robot.yaml")) as file:
        values = {name: entry["default"] for name, entry in yaml.safe_load(file).items() if "gone" not in entry}
    with open(model if model.endswith(".yaml") else os.path.join(ROOT, f"config/robots/{model}.yaml")) as file:
        values.update(yaml.safe_load(file) or {})
    return values
