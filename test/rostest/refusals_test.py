#!/usr/bin/python3
"""Misspelt parameters and unusable worlds end a program at once, with one line that says what is wrong."""

import itertools
import os
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest

import rosnode
import rospkg
import rospy
import rostest
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus

from node_process import pid_of
from waiting import wait_until

NODES = ("perception", "global_planner", "local_replanner", "trajectory_broadcaster", "trajectory_tracker",
         "fleet_simulator")
PATIENCE_S = 60.0
ROOT = rospkg.RosPack().get_path("mocha_ugv")

WALLED_IN = """
bounds: {min: [-5, -5], max: [5, 5]}
circles: [[0.1, 0.0, 0.5]]
robots: [{name: ugv1, model: rover, start: [0.0, 0.0, 0.0], goal: [3.0, 0.0]}]
"""
NOT_A_NUMBER = WALLED_IN.replace("0.1, 0.0, 0.5", "3.0, .nan, 0.5")
OWN_FOOTPRINT = WALLED_IN.replace("0.1, 0.0, 0.5", "3.0, 0.0, 0.5").replace("model: rover", "model: rover, radius: 0.5")
MISSPELT = WALLED_IN.replace("circles", "circels")


class Launched:
    """A process in the background, and all that it says."""

    def __init__(self, command):
        self._log = tempfile.NamedTemporaryFile()
        self._process = subprocess.Popen(command, stdout=self._log, stderr=subprocess.STDOUT, env=dict(os.environ, ROSCONSOLE_STDOUT_LINE_BUFFERED="1"))

    def words(self):
        with open(self._log.name) as log:
            return log.read()

    def end(self):
        self._process.send_signal(signal.SIGINT)
        self._process.wait(PATIENCE_S)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.end()


def answers(node):
    try:
        return bool(pid_of(node))
    except (rosnode.ROSNodeException, OSError):
        return False


class RefusalsTest(unittest.TestCase):
    numbers = itertools.count()

    def check_node(self, node, words, *arguments, **environment):
        command = ["rosrun", "mocha_ugv", node, "__name:=refusing_%d" % next(self.numbers), *arguments]
        result = subprocess.run(command, env=dict(os.environ, ROS_NAMESPACE="ugv1", **environment), stdout=subprocess.PIPE,
                                stderr=subprocess.STDOUT, text=True, timeout=PATIENCE_S)
        self.assertEqual(result.returncode, 1, result.stdout)
        self.assertEqual(result.stdout.count("FATAL"), 1, result.stdout)
        for word in words:
            self.assertIn(word, result.stdout)

    def test_help_needs_no_master(self):
        for node in NODES + ("base_driver", "base_emulator", "scan_localizer"):
            with self.subTest(node):
                result = subprocess.run(["rosrun", "mocha_ugv", node, "--help"], env=dict(os.environ, ROS_MASTER_URI="http://localhost:1"),
                                        stdout=subprocess.PIPE, text=True, timeout=PATIENCE_S)
                self.assertEqual(result.returncode, 0)
                self.assertTrue(result.stdout.startswith("usage: rosrun mocha_ugv " + node), result.stdout)
                self.assertIn("\n  robot_model: " if node != "fleet_simulator" else "\n  world: ", result.stdout)

    def test_a_clock_that_nobody_publishes_is_missed(self):
        rospy.set_param("/use_sim_time", True)
        node = subprocess.Popen(["rosrun", "mocha_ugv", "perception", "__name:=waiting"], env=dict(os.environ, ROS_NAMESPACE="ugv9"),
                                stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        try:
            self.assertTrue(any("waits for /clock" in line for line in node.stdout))
        finally:
            rospy.delete_param("/use_sim_time")
            node.terminate()
            node.communicate(timeout=PATIENCE_S)

    def test_a_simulation_takes_its_clock_with_it(self):
        rospy.set_param("/use_sim_time", True)
        try:
            with Launched(["rosrun", "mocha_ugv", "fleet_simulator", "_lockstep_nodes:=", "_world:=" + ROOT + "/config/worlds/empty.yaml"]):
                wait_until(lambda: answers("/fleet_simulator"), "it is there", PATIENCE_S)
                self.assertTrue(rospy.get_param("/use_sim_time"))
                self.check_node("fleet_simulator", ["another node with the name /fleet_simulator"], "__ns:=/", "__name:=fleet_simulator")
                self.assertTrue(rospy.get_param("/use_sim_time"), "the other one still runs")
            self.assertFalse(rospy.get_param("/use_sim_time"))
        finally:
            rospy.delete_param("/use_sim_time")

    def test_misspelt_parameters(self):
        for node in NODES:
            with self.subTest(node):
                self.check_node(node, ["unknown parameter `robot_modl`"], "_robot_modl:=rover")

    def test_values_out_of_range(self):
        for node, name, allowed in (("perception", "map_rate", "0.1"), ("global_planner", "replan_period", "30"),
                                    ("local_replanner", "lease", "5"), ("trajectory_broadcaster", "heartbeat_rate", "100"),
                                    ("trajectory_tracker", "max_pose_age", "2"), ("fleet_simulator", "step", "0.1")):
            with self.subTest(node):
                self.check_node(node, [name + " = ", "-1", allowed], "_%s:=-1.0" % name)

    def test_robots_that_nobody_knows(self):
        for node in NODES[:-1]:
            with self.subTest(node):
                self.check_node(node, ["robots/hovercraft.yaml"], "_robot_model:=hovercraft")

    def test_bases_that_cannot_turn_in_place(self):
        with tempfile.TemporaryDirectory() as package:  # the same configuration, and one more robot
            shutil.copy(ROOT + "/package.xml", package)
            shutil.copytree(ROOT + "/config", package + "/config")
            with open(package + "/config/robots/car.yaml", "w") as model:
                model.write("min_turning_radius: 0.45\n")
            for node in NODES[:-1] + ("base_driver",):
                with self.subTest(node):
                    self.check_node(node, ["robots/car.yaml: min_turning_radius = 0.45 m", "bases that turn in place (0 m)"],
                                    "_robot_model:=car", ROS_PACKAGE_PATH=package + ":" + os.environ["ROS_PACKAGE_PATH"])

    def test_times_that_cannot_work_together(self):
        both = ["trajectory_tracker/max_lease = 0.2 s", "must be at least", "local_replanner/lease = 0.5 s"]
        self.check_node("trajectory_tracker", both, "_max_lease:=0.2")
        rospy.set_param("/ugv1/trajectory_tracker/max_lease", 0.2)
        try:
            self.check_node("local_replanner", both)
        finally:
            rospy.delete_param("/ugv1/trajectory_tracker/max_lease")

    def test_parameters_that_are_no_more(self):
        for node, name, words in (("global_planner", "priority", "that of trajectory_broadcaster"),
                                  ("trajectory_broadcaster", "initial_lease", "`lease` of local_replanner"),
                                  ("local_replanner", "answer_timeout", "follows from `settle_time`")):
            with self.subTest(node):
                self.check_node(node, ["parameter `%s` is gone" % name, words], "_%s:=1" % name)

    def test_footprints_that_the_stack_does_not_know(self):
        rospy.set_param("/use_sim_time", True)
        try:
            with tempfile.NamedTemporaryFile("w", suffix=".yaml") as world:
                world.write(OWN_FOOTPRINT)
                world.flush()
                self.check_node("fleet_simulator", [world.name, "ugv1 has a footprint of its own", "/ugv1/robot"],
                                "_world:=" + world.name, "_start_timeout:=0.1")
        finally:
            rospy.delete_param("/use_sim_time")

    def test_footprints_that_cannot_be(self):
        rospy.set_param("/ugv1/robot/footprint_radius", 7.0)
        try:
            for node in NODES[:-1] + ("base_driver",):
                with self.subTest(node):
                    self.check_node(node, ["/ugv1/robot: footprint_radius = 7: expected a value from 0.01 to 5"])
        finally:
            rospy.delete_param("/ugv1/robot")

    def launch(self, *arguments):
        """roslaunch, beside the one that runs this test."""
        return Launched(["roslaunch", "--wait", ROOT + "/test/rostest/respawned.launch", *arguments])

    def wait_until_said(self, node, words, times):
        """In /diagnostics, as an error."""
        heard = []

        def hear(message):
            heard.extend(status.message for status in message.status
                         if status.name == node + ": start" and status.level == DiagnosticStatus.ERROR and words in status.message)

        listener = rospy.Subscriber("/diagnostics", DiagnosticArray, hear)
        try:
            wait_until(lambda: len(heard) >= times, node + " says in /diagnostics: " + words, PATIENCE_S)
        finally:
            listener.unregister()

    def test_roslaunch_does_not_start_them_again_and_again(self):
        nodes = ("perception", "trajectory_tracker", "base_emulator")
        with self.launch("robot:=ugv7", "nodes:=" + ",".join(nodes), "parameters:={%s}" % ", ".join(
                node + ": {robot_model: hovercraft}" for node in nodes)) as launched:
            for node in nodes:
                self.wait_until_said("ugv7/" + node, "robots/hovercraft.yaml", 3)
        self.assertEqual(launched.words().count("FATAL"), len(nodes), launched.words())
        self.assertNotIn("escalating", launched.words(), "they end when they are told to")

    def test_what_may_be_there_later_is_tried_again(self):
        with self.launch("robot:=ugv7", "nodes:=trajectory_broadcaster", "parameters:={trajectory_broadcaster: {lcm_url: \"udpm://nowhere\"}}") as launched:
            self.wait_until_said("ugv7/trajectory_broadcaster", "LCM cannot use it", 3)
            wait_until(lambda: launched.words().count("FATAL") == 2, "another start", PATIENCE_S)

    def test_a_living_node_keeps_its_name(self):
        name = "/ugv8/trajectory_tracker"
        arguments = ("robot:=ugv8", "nodes:=trajectory_tracker")
        with self.launch(*arguments) as first:
            wait_until(lambda: answers(name), "the first is there", PATIENCE_S)
            pid = pid_of(name)
            with self.launch(*arguments) as second:
                self.wait_until_said(name[1:], "another node with the name " + name, 3)
                self.assertEqual(pid_of(name), pid)
                self.assertNotIn("FATAL", first.words())
                self.assertEqual(second.words().count("FATAL"), 1, second.words())
                self.check_node("trajectory_tracker", ["another node with the name"], "__ns:=ugv8", "__name:=trajectory_tracker")
                first.end()
                wait_until(lambda: answers(name) and pid_of(name) != pid, "the second takes the name that is free", PATIENCE_S)

    def test_a_dead_node_does_not_keep_its_name(self):
        name = "/ugv8/trajectory_tracker"
        with self.launch("robot:=ugv8", "nodes:=trajectory_tracker") as launched:
            wait_until(lambda: answers(name), "it is there", PATIENCE_S)
            pid = pid_of(name)
            os.kill(pid, signal.SIGKILL)
            wait_until(lambda: answers(name) and pid_of(name) != pid, "it is there again", PATIENCE_S)
        self.assertNotIn("FATAL", launched.words())

    def check_demo(self, words, world, *arguments):
        """The demo with a master of its own. Its own script builds first; here, what it then runs."""
        out = tempfile.mkdtemp()
        command = ["/usr/bin/python3", "-m", "mocha_scripts.demo", "--headless", "--no-plots", "--rate", "0", "--world", world,
                   "--out", out, *arguments]
        environment = dict(os.environ, PYTHONPATH=ROOT + "/scripts:" + os.environ["PYTHONPATH"], ROS_HOME=out)
        begun = time.monotonic()
        result = subprocess.run(command, env=environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                                timeout=PATIENCE_S)
        self.assertNotEqual(result.returncode, 0)
        for word in words:
            self.assertIn(word, result.stdout)
        self.assertNotIn("Traceback", result.stdout)
        self.assertLess(time.monotonic() - begun, PATIENCE_S)

    def test_demo_with_a_map_that_is_not_there(self):
        self.check_demo(["/no/such/map.bt: cannot be read", "FAILED"], ROOT + "/config/worlds/empty.yaml", "--map", "/no/such/map.bt")

    def test_demo_in_worlds_that_are_none(self):
        self.check_demo(["/no/such/world.yaml: cannot be read: No such file"], "/no/such/world.yaml")
        for text, words in (("robots: [", ["cannot be read"]),
                            (NOT_A_NUMBER, ["circles[0]", ".nan"]),
                            (WALLED_IN, ["ugv1", "start"]),
                            (MISSPELT, ["circels"])):
            with self.subTest(words), tempfile.NamedTemporaryFile("w", suffix=".yaml") as world:
                world.write(text)
                world.flush()
                self.check_demo([world.name] + words, world.name)


if __name__ == "__main__":
    rospy.init_node("refusals_test")
    rostest.rosrun("mocha_ugv", "refusals", RefusalsTest, sys.argv)
