#!/usr/bin/python3
"""What scripts/fleet_view shows of a world, a bag, and of robots by name."""
import math
import os
import pathlib
import subprocess
import tempfile
import unittest

import genpy
import rosbag
import yaml
from nav_msgs.msg import OccupancyGrid
from sensor_msgs.msg import LaserScan

ROOT = pathlib.Path(__file__).resolve().parent.parent
PLUGIN = "lib/libmocha_rviz_panel.so"
SHOWN_PX = (1120, 760)


class FleetView(unittest.TestCase):
    def setUp(self):
        directory = tempfile.TemporaryDirectory()
        self.addCleanup(directory.cleanup)
        self.directory = pathlib.Path(directory.name)

    def run_it(self, *options, panel=True):
        (self.directory / PLUGIN).parent.mkdir(exist_ok=True)
        (self.directory / PLUGIN).touch()
        prefix = str(self.directory) if panel else "/nowhere"
        environment = {**os.environ, "ROS_PACKAGE_PATH": f"{ROOT}:/usr/share", "CMAKE_PREFIX_PATH": prefix, "ROS_MASTER_URI": "http://localhost:1"}
        return subprocess.run([ROOT / "scripts/fleet_view", "--write", self.directory / "view", *options], env=environment, capture_output=True, text=True)

    def view(self, *options, panel=True):
        run = self.run_it(*options, panel=panel)
        self.assertEqual(run.returncode, 0, run.stderr)
        return yaml.safe_load((self.directory / "view").read_text())

    def complaint(self, *options):
        run = self.run_it(*options)
        self.assertNotEqual(run.returncode, 0)
        self.assertNotIn("Traceback", run.stderr)
        return run.stderr

    def world(self, bounds, names=("ugv1",)):
        path = self.directory / "world.yaml"
        path.write_text(yaml.safe_dump({"bounds": bounds, "robots": [{"name": name} for name in names]}))
        return path

    @staticmethod
    def groups(config):
        return {display["Name"]: display["Displays"] for display in config["Visualization Manager"]["Displays"] if display["Class"] == "rviz/Group"}

    @staticmethod
    def eye(config):
        return config["Visualization Manager"]["Views"]["Current"]

    def test_all_of_a_world_is_in_view(self):
        for bounds in ({"min": [-2.0, 1.0], "max": [98.0, 101.0]}, {"min": [0.0, -4.0], "max": [24.0, 4.0]}):
            eye = self.eye(self.view("--world", self.world(bounds)))
            self.assertEqual(eye["Target Frame"], "map")
            for axis, name in enumerate("XY"):
                half_m = 0.5 * SHOWN_PX[axis] / eye["Scale"]
                self.assertLess(eye[name] - half_m, bounds["min"][axis])
                self.assertGreater(eye[name] + half_m, bounds["max"][axis])

    def test_every_shipped_world_is_shown(self):
        for world in (ROOT / "config/worlds").glob("*.yaml"):
            names = {robot["name"] for robot in yaml.safe_load(world.read_text())["robots"]}
            config = self.view("--world", world)
            self.assertEqual(set(self.groups(config)), names, world)
            self.assertNotIn("ROBOT", yaml.safe_dump(config), world)

    def test_where_a_world_has_no_bounds_the_first_robot_is_followed(self):
        for bounds in (None, 3, {"min": [0, 0]}, {"min": [0, 0], "max": [0, 9]}, {"min": ["a", 0], "max": [1, 9]}, {"min": [0], "max": [9]},
                       {"min": [1, 1], "max": [0, 0]}, {"min": [0, 0], "max": [math.nan, 1]}, {"min": [0, 0], "max": [math.inf, 1]}):
            self.assertEqual(self.eye(self.view("--world", self.world(bounds)))["Target Frame"], "ugv1/base_link", bounds)

    def test_robots_of_any_names_and_number(self):
        names = [f"tractor_{number}" for number in range(12)]
        groups = self.groups(self.view("--robots", *names))
        self.assertEqual(list(groups), names)
        maps = [display["Enabled"] for displays in groups.values() for display in displays if display["Name"] == "Map"]
        self.assertEqual(maps, [True] + 11 * [False])
        scans = {display["Color"] for displays in groups.values() for display in displays if display["Name"] == "Scan"}
        self.assertEqual(len(scans), 12)
        topics = [display["Topic"] for display in groups["tractor_7"] if "Topic" in display]
        self.assertTrue(topics and all(topic.startswith("/tractor_7/") for topic in topics))

    def test_remappings_of_roslaunch_are_no_robots(self):
        config = self.view("--robots", "ugv3", "__name:=rviz", "/ugv3/scan:=scan")
        self.assertEqual(set(self.groups(config)), {"ugv3"})

    def test_a_bag_shows_its_map_and_its_robots(self):
        path = self.directory / "drive.bag"
        with rosbag.Bag(str(path), "w") as bag:
            grid = OccupancyGrid()
            grid.info.width, grid.info.height, grid.info.resolution = 40, 20, 0.5
            grid.info.origin.position.x, grid.info.origin.position.y = 100.0, -50.0
            grid.data = [-1] * 800
            grid.data[5 * 40 + 10] = 0     # one corner of what is known
            grid.data[14 * 40 + 29] = 100  # the other
            bag.write("/cart/map", grid, genpy.Time(1))
            bag.write("/cart/scan", LaserScan(), genpy.Time(1))
        config = self.view("--bag", path)
        self.assertEqual(set(self.groups(config)), {"cart"})
        eye = self.eye(config)
        self.assertAlmostEqual(eye["X"], 110.0)
        self.assertAlmostEqual(eye["Y"], -45.0)
        self.assertLess(eye["Scale"], SHOWN_PX[0] / 10.0)

    def test_without_the_panel_nothing_of_it_is_asked_for(self):
        self.assertIn("mocha_ugv/FleetPanel", yaml.safe_dump(self.view("--robots", "ugv1")))
        self.assertNotIn("mocha_ugv/", yaml.safe_dump(self.view("--robots", "ugv1", panel=False)))

    def test_complaints_are_one_line(self):
        self.assertIn("nowhere.yaml", self.complaint("--world", "nowhere.yaml"))
        self.assertIn("nowhere.bag", self.complaint("--bag", "nowhere.bag"))
        self.assertIn("no ROS master answers", self.complaint())
        self.assertIn("no ROS master answers", self.complaint("--world", self.world(None, names=())))
        (self.directory / "broken.bag").write_text("no bag")
        self.assertIn("broken.bag", self.complaint("--bag", self.directory / "broken.bag"))


if __name__ == "__main__":
    unittest.main()
