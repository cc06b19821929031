"""World and robot files, read the simple way: for drawing and reports. The C++ loader is the one that judges them."""
import os

import yaml

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))


def read_world(path):
    with open(path) as file:
        return yaml.safe_load(file)


def robot_values(model):
    """Values of config/robots/<model>.yaml over the defaults of its schema."""
    with open(os.path.join(ROOT, "config/robot.yaml")) as file:
        values = {name: entry["default"] for name, entry in yaml.safe_load(file).items() if "gone" not in entry}
    with open(os.path.join(ROOT, f"config/robots/{model}.yaml")) as file:
        values.update(yaml.safe_load(file) or {})
    return values
