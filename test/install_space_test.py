#!/usr/bin/python3
"""The package as it is installed, away from its sources: robot.launch finds its nodes and the robot's description.

    install_space_test.py BUILD_DIRECTORY     (of which all targets have been built)"""
import pathlib
import subprocess
import sys
import tempfile
import unittest

BUILD = sys.argv.pop()


class InstallSpace(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        directory = tempfile.TemporaryDirectory()
        cls.addClassCleanup(directory.cleanup)
        cls.directory = directory.name
        cls.run_it("cmake", "--install", BUILD)
        cls.prefix, = [path.parent for path in pathlib.Path(directory.name).rglob("env.sh")]

    @classmethod
    def run_it(cls, *command):
        clean = {"PATH": "/usr/bin:/bin", "DESTDIR": cls.directory, "ROS_HOME": cls.directory + "/ros_home"}
        result = subprocess.run(command, env=clean, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        assert result.returncode == 0, result.stdout
        return result.stdout

    def roslaunch(self, *options):
        return self.run_it(str(self.prefix / "env.sh"), "roslaunch", *options, "mocha_ugv", "robot.launch", "robot:=ugv3")

    def test_nodes_are_found(self):
        ours = {path.stem[:-len("_node")] for path in (pathlib.Path(__file__).parent.parent / "src/nodes").glob("*_node.cpp")}
        nodes = [node for node in self.roslaunch("--nodes").split() if node.startswith("/ugv3/") and node.split("/")[-1] in ours]
        self.assertGreater(len(nodes), 5)
        for node in nodes:
            self.assertIn(str(self.prefix / "lib/mocha_ugv"), self.roslaunch("--args", node))

    def test_description_is_found(self):
        self.assertIn("ugv3/laser", self.roslaunch("--dump-params"))


if __name__ == "__main__":
    unittest.main()
