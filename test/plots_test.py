#!/usr/bin/python3
"""What scripts/plots says of files that it cannot draw, and scripts/plan3d of those that it cannot write: a line, and no traceback."""
import contextlib
import io
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest
import unittest.mock

import rosbag
from std_msgs.msg import String

ROOT = pathlib.Path(__file__).resolve().parent.parent
sys.path[:0] = [str(ROOT / "scripts"), str(ROOT / "test")]
from mocha_scripts import plan3d, plots, worlds  # noqa: E402
from mocha_scripts.complaint import Complaint  # noqa: E402

WORLD = ROOT / "config/worlds/corridor.yaml"


class Plots(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)

    def write(self, name, text):
        path = pathlib.Path(self.folder.name) / name
        path.write_text(text)
        return path

    def check(self, *arguments, says):
        words = io.StringIO()
        with contextlib.redirect_stderr(words):
            status = plots.main([*map(str, arguments), "--out", self.folder.name])
        self.assertEqual(status, 1)
        self.assertRegex(words.getvalue(), rf"^plots: [^\n]*{says}[^\n]*\n$")

    def test_bags(self):
        for drawn in ("drive", "detour"):
            self.check(drawn, "/no/such.bag", "--world", WORLD, says="/no/such.bag: cannot be read: No such file")
            self.check(drawn, self.write("text.bag", "nothing"), "--world", WORLD, says="text.bag: cannot be read")
            other = pathlib.Path(self.folder.name) / "other.bag"
            with rosbag.Bag(str(other), "w") as bag:
                bag.write("/chatter", String("hello"))
            self.check(drawn, other, "--world", WORLD, says="other.bag: is no drive of the simulator")

    def test_worlds_and_maps(self):
        for text, says in (("[1, 2]", "is not a map in YAML"), ("{a: [", "cannot be read"), ("{robots: [{name: a}]}", "each need a name and a model")):
            self.check("drive", "/no/such.bag", "--world", self.write("world.yaml", text), says=says)
        self.check("classes", ROOT / "config/maps/corridor.bt", says="corridor.bt: cannot be read")
        self.check("classes", ROOT / "config/robots/rover.yaml", says="neither a world file nor")
        self.check("classes", self.write("map.yaml", "{image: map.pgm, resolution: 0.05, origin: [0, 0, 0]}"), says="--drive X0 Y0 X1 Y1")

    def test_recordings_are_drawn_without_benchmarks(self):
        """As where the package is installed."""
        modules = "animation, costs_plots, detour_plots, drive_plots"
        environment = {**os.environ, "PYTHONPATH": f"{ROOT / 'scripts'}:{os.environ.get('PYTHONPATH', '')}"}
        subprocess.run([sys.executable, "-c", f"from mocha_scripts import {modules}"], env=environment, cwd=self.folder.name, check=True)

    def test_models_of_a_world_are_beside_it(self):
        world = self.write("world.yaml", "{robots: [{name: a, model: mine.yaml}, {name: b, model: rover}]}")
        self.write("mine.yaml", "max_speed: 0.4")
        mine, other = [robot["model"] for robot in worlds.read_world(world)["robots"]]
        self.assertEqual((worlds.robot_values(mine)["max_speed"], other), (0.4, "rover"))
        self.assertRaises(Complaint, worlds.read_world, "/no/such.yaml")


class Plan3d(unittest.TestCase):
    def check(self, *arguments, says):
        """Before it plans: there is no such map."""
        words = io.StringIO()
        with contextlib.redirect_stderr(words), self.assertRaises(SystemExit) as ended:
            plan3d.main(["/no/such.bt", "--start", "0,0,0", "--goal", "1,0,0", *arguments])
        self.assertEqual(ended.exception.code, 2)
        self.assertRegex(words.getvalue(), f": {says}\n$")

    def test_files_to_write(self):
        for option in ("--json", "--picture"):
            for name in ("/tmp", "/tmp/", "no/such/", ""):
                self.check(option, name, says=f"argument {option}: {name}: expected the name of a file, not of a directory")
        for name in ("x.foo", "x", "out/.png", "png", "x.png.gz"):
            self.check("--picture", name, says=f"argument --picture: {name}: expected a name that ends in .png, .pdf or .svg")

    def test_ctrl_c_is_no_traceback(self):
        with unittest.mock.patch.object(plan3d, "run", side_effect=KeyboardInterrupt):
            self.assertEqual(plan3d.main(["map.bt", "--start", "0,0,0", "--goal", "1,0,0"]), 130)

    def test_pictures_that_can_be_drawn(self):
        for name in ("x.png", "out/x.pdf", "/x.y.SVG"):
            self.assertEqual(plan3d.parse(["map.bt", "--start", "0,0,0", "--goal", "1,0,0", "--picture", name]).picture, name)


if __name__ == "__main__":
    unittest.main()
