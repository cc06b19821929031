#!/usr/bin/python3
"""Every launch file can be loaded, whatever its switches say; its arguments are explained; its nodes exist, and are given only parameters
that they have."""
import importlib.machinery
import itertools
import os
import pathlib
import tempfile
import unittest
import xml.etree.ElementTree as ElementTree

import roslaunch.config
import roslaunch.core
import roslaunch.xmlloader
import yaml

ROOT = pathlib.Path(__file__).resolve().parent.parent
FILES = sorted((ROOT / "launch").glob("*.launch"))
NEEDED = {"robot": "ugv3", "bag": "/drive.bag", "map_file": "/house.bt"}  # arguments without default


def arguments(path):
    return ElementTree.parse(path).findall("arg")


def switches(path):
    """All that the true-or-false arguments of a file can say together."""
    names = [argument.get("name") for argument in arguments(path) if argument.get("default") in ("true", "false")]
    for values in itertools.product(("true", "false"), repeat=len(names)):
        yield [f"{name}:={value}" for name, value in zip(names, values)]


def load(path, given=()):
    needed = {argument.get("name"): NEEDED[argument.get("name")] for argument in arguments(path)
              if argument.get("default") is None and argument.get("value") is None}
    said = {**needed, **dict(each.split(":=", 1) for each in given)}
    config = roslaunch.config.ROSLaunchConfig()
    roslaunch.xmlloader.XmlLoader().load(str(path), config, argv=[f"{name}:={value}" for name, value in said.items()], verbose=False)
    return config


def names_of(config):
    return {node.namespace + node.name for node in config.nodes}


class LaunchFiles(unittest.TestCase):
    def test_arguments_are_explained(self):
        for path in FILES:
            unexplained = [argument.get("name") for argument in arguments(path) if not argument.get("doc")]
            self.assertEqual(unexplained, [], path.name)

    def test_roslaunch_finds_the_one_that_is_meant(self):
        """By its name alone it looks through the whole checkout, and refuses what is there twice."""
        everywhere = [path.name for path in ROOT.rglob("*.launch") if "_build" not in path.parts]
        self.assertEqual([path.name for path in FILES if everywhere.count(path.name) > 1], [])

    def test_a_map_that_is_missing_is_named(self):
        loader = roslaunch.xmlloader.XmlLoader()
        loader.ignore_unset_args = False  # as roslaunch does
        with self.assertRaisesRegex(roslaunch.core.RLException, "requires the 'map_file' arg"):
            loader.load(str(ROOT / "launch/space.launch"), roslaunch.config.ROSLaunchConfig(), argv=[], verbose=False)

    def test_can_be_loaded_whatever_the_switches_say(self):
        for path in FILES:
            for given in switches(path):
                with self.subTest(path=path.name, given=given):
                    self.assertGreater(len(load(path, given).nodes), 0)

    def test_nodes_exist_and_have_their_parameters(self):
        for path in FILES:
            for given in switches(path):
                config = load(path, given)
                for node in config.nodes:
                    if node.package != "mocha_ugv":
                        continue
                    with self.subTest(path=path.name, given=given, node=node.type):
                        if (ROOT / "scripts" / node.type).exists():
                            continue
                        self.assertTrue((ROOT / f"src/nodes/{node.type}_node.cpp").exists())
                        mine = node.namespace + node.name + "/"
                        set_here = {name[len(mine):] for name in config.params if name.startswith(mine)}
                        schema = yaml.safe_load((ROOT / f"config/{node.type}.yaml").read_text())
                        self.assertLessEqual(set_here, {name for name, entry in schema.items() if "gone" not in entry})


class OwnFiles(unittest.TestCase):
    """Paths are those of the shell that roslaunch is started in: its nodes run elsewhere."""

    def said(self, file, *given):
        config = load(ROOT / "launch" / file, given)
        return [str(param.value) for param in config.params.values()] + [word for node in config.nodes for word in node.args.split()]

    def check(self, file, argument, path="/some/file"):
        here = os.environ["PWD"] + "/"
        relative = os.path.relpath(path, here)
        for given, expected in ((path, path), (relative, here + relative)):
            said = [word.rsplit("=", 1)[-1] for word in self.said(file, f"{argument}:={given}")]
            self.assertEqual({word for word in said if word.endswith(relative)} or {word for word in said if word == path}, {expected}, f"{file} {argument}")

    def test_are_found_from_where_roslaunch_is_started(self):
        for file, names in {"agent": ("map_file", "keep_out_file", "fleet_key"), "robot": ("map_file", "keep_out_file", "fleet_key"),
                            "emulated_robot": ("world",), "fleet_sim": ("world", "map_file", "fleet_key"), "replay": ("world", "bag"), "space": ("map_file",)}.items():
            for name in names:
                self.check(file + ".launch", name)

    def test_parameters_reach_the_nodes(self):
        with tempfile.NamedTemporaryFile("w", suffix=".yaml") as file:
            file.write("{local_replanner: {horizon: 5.0}, perception: {scan_timeout: 0.4}}")
            file.flush()
            for launch in ("agent.launch", "robot.launch"):
                params = load(ROOT / "launch" / launch, [f"parameters:={file.name}"]).params
                self.assertEqual([params["/ugv3/local_replanner/horizon"].value, params["/ugv3/perception/scan_timeout"].value], [5.0, 0.4])
        self.check("fleet_sim.launch", "parameters")

    def test_models_are_named_or_given_by_their_paths(self):
        for file in ("agent.launch", "robot.launch", "emulated_robot.launch", "replay.launch"):
            self.check(file, "model", str(ROOT / "config/robots/rover.yaml"))
            self.assertIn("jackal", self.said(file, "model:=jackal"))


class OwnFootprints(unittest.TestCase):
    """What a world file says of one robot's footprint gets to all nodes of that robot, as parameters of its model."""
    FILE = ROOT / "launch/agent.launch"
    ROBOT = {"name": "ugv3", "model": "rover"}

    def values(self, **own):
        script = importlib.machinery.SourceFileLoader("launch_agents", str(ROOT / "scripts/launch_agents")).load_module()
        config = load(self.FILE, script.arguments({**self.ROBOT, **own}, "/world.yaml"))
        mine = "/ugv3/robot/"
        return {name[len(mine):]: param.value for name, param in config.params.items() if name.startswith(mine)}

    def test_a_world_file_gives_it(self):
        self.assertEqual(self.values(), {})
        self.assertEqual(self.values(radius=1), {"footprint": "disc", "footprint_radius": 1.0})
        self.assertEqual(self.values(footprint=[0.9, 0.6]), {"footprint": "rectangle", "footprint_length": 0.9, "footprint_width": 0.6})
        self.assertEqual(self.values(footprint=[[0.5, 0], [-0.2, 0.3], [-0.2, -0.3]]),
                         {"footprint": "polygon", "footprint_corners": "[[0.5, 0], [-0.2, 0.3], [-0.2, -0.3]]"})

    def test_they_are_values_of_the_model(self):
        schema = yaml.safe_load((ROOT / "config/robot.yaml").read_text())
        for own in ({"radius": 1}, {"footprint": [0.9, 0.6]}, {"footprint": [[0.5, 0], [-0.2, 0.3], [-0.2, -0.3]]}):
            self.assertLessEqual(set(self.values(**own)), set(schema))

    def test_another_start_forgets_them(self):
        self.assertIn("/ugv3/robot/", load(self.FILE).clear_params)


class RobotLaunch(unittest.TestCase):
    FILE = ROOT / "launch/robot.launch"
    STACK = {"perception", "global_planner", "local_replanner", "trajectory_broadcaster", "trajectory_tracker"}

    def started(self, *given):
        return {name[len("/ugv3/"):] for name in names_of(load(self.FILE, given))} - self.STACK - {"robot_state_publisher"}

    def test_what_is_started(self):
        self.assertEqual(self.started(), {"base_driver", "scan_localizer"})
        self.assertEqual(self.started("base:=false", "localizer:=false"), set())
        self.assertEqual(self.started("lidar_frame:=laser_link"), {"base_driver", "scan_localizer", "lidar_frame"})
        self.assertEqual(self.started("lidar_frame:=ugv3/laser", "rviz:=true"), {"base_driver", "scan_localizer", "rviz"})
        vendor = ROOT / "test/rostest/vendor_lidar.launch"
        self.assertEqual(self.started(f"lidar_launch:={vendor}"), {"base_driver", "scan_localizer", "vendor_lidar"})

    def test_the_map_is_for_localiser_and_perception_and_not_for_mapping(self):
        known = load(self.FILE, ["map_file:=/flat.bt"]).params
        self.assertEqual([known[f"/ugv3/{node}/map_file"].value for node in ("perception", "scan_localizer")], 2 * ["/flat.bt"])
        mapping = load(self.FILE, ["map_file:=/flat.bt", "mapping:=true"]).params
        self.assertEqual([mapping[f"/ugv3/{node}/map_file"].value for node in ("perception", "scan_localizer")], 2 * [""])
        self.assertEqual([params["/ugv3/scan_localizer/mapping"].value for params in (known, mapping)], [False, True])

    def test_scans_come_from_the_lidars_topic(self):
        config = load(self.FILE, ["lidar_topic:=/scan"])
        perception, = [node for node in config.nodes if node.type == "perception"]
        self.assertIn(["/ugv3/scan", "/scan"], perception.remap_args)


if __name__ == "__main__":
    unittest.main()
