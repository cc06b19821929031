"""World and robot files, read the simple way: for drawing and reports. The C++ loader is the one that judges them."""
import os

import yaml

from mocha_scripts.complaint import Complaint, in_a_line
from mocha_scripts.paths import ROOT


def read_yaml(path):
    """A map."""
    try:
        with open(path) as file:
            content = yaml.safe_load(file)
    except (OSError, UnicodeDecodeError, yaml.YAMLError) as error:
        raise Complaint(f"{path}: cannot be read: {in_a_line(error)}") from error
    if not isinstance(content, dict):
        raise Complaint(f"{path}: is not a map in YAML")
    return content


def read_world(path):
    """Models that are named by their paths are so relative to the world file; here, absolute."""
    world = read_yaml(path)
    try:
        for robot in world["robots"]:
            if robot["name"] and robot["model"].endswith(".yaml"):
                robot["model"] = os.path.abspath(os.path.join(os.path.dirname(path), robot["model"]))
    except (KeyError, TypeError, AttributeError) as error:
        raise Complaint(f"{path}: is not a world file: its robots each need a name and a model") from error
    return world


def robot_values(model):
    """Values of a model, config/robots/<model>.yaml or a file of one's own, over the defaults of its schema."""
    with open(os.path.join(ROOT, "config/robot.yaml")) as file:
        values = {name: entry["default"] for name, entry in yaml.safe_load(file).items() if "gone" not in entry}
    with open(model if model.endswith(".yaml") else os.path.join(ROOT, f"config/robots/{model}.yaml")) as file:
        values.update(yaml.safe_load(file) or {})
    return values
