#!/usr/bin/python3
"""Parameters changed while the stack runs: offered as the schemas say, in force at once, clamped or refused as a whole, and
there again after a respawn."""

import math
import os
import signal
import sys
import unittest

import rospkg
import rospy
import rostest
import yaml
from diagnostic_msgs.msg import DiagnosticArray
from dynamic_reconfigure.client import Client
from dynamic_reconfigure.msg import BoolParameter, Config, DoubleParameter, IntParameter, StrParameter
from dynamic_reconfigure.srv import Reconfigure
from geometry_msgs.msg import PoseStamped, Vector3Stamped
from mocha_ugv.msg import Fallback, PlannerStatus
from mocha_ugv.srv import PlanTrajectory

from map_listener import MapListener
from simulated_robot import SimulatedRobot, pose

NODES = ("global_planner", "perception", "trajectory_tracker")
BEHIND_THE_BLOCK = (-3.0, 2.95)
TIMEOUT_S = 20.0  # wall time
PATIENCE_S = 20.0  # simulated time for words and messages to come round
CONFIG = rospkg.RosPack().get_path("mocha_ugv") + "/config/"


def schema(node):
    with open(CONFIG + node + ".yaml") as file:
        return {name: entry for name, entry in yaml.safe_load(file).items() if entry.get("live")}


class LiveParametersTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.robot = SimulatedRobot()
        cls.diagnosed = {}  # node -> newest values in diagnostics
        cls.maps = MapListener()
        cls.errors = []
        cls.fallbacks = []  # of the newest status
        rospy.Subscriber("/diagnostics", DiagnosticArray, cls.on_diagnostics)
        rospy.Subscriber("/ugv1/planner_status", PlannerStatus, cls.on_status)
        rospy.Subscriber("/ugv1/tracking_error", Vector3Stamped, cls.errors.append)
        cls.plan = rospy.ServiceProxy("/ugv1/plan", PlanTrajectory)
        cls.robot.start()

    @classmethod
    def on_diagnostics(cls, message):
        for status in message.status:
            node = status.name.split(":")[0].split("/")[-1]
            cls.diagnosed.setdefault(node, {}).update((entry.key, entry.value) for entry in status.values)

    @classmethod
    def on_status(cls, status):
        cls.fallbacks = status.effort.fallbacks

    def client(self, node="global_planner"):
        client = Client("/ugv1/" + node, timeout=TIMEOUT_S)
        self.addCleanup(client.close)
        self.assertIsNotNone(client.get_parameter_descriptions(TIMEOUT_S))
        self.assertIsNotNone(client.get_configuration(TIMEOUT_S))
        return client

    def setUp(self):
        for node in NODES:
            self.client(node).update_configuration({name: entry["default"] for name, entry in schema(node).items()})

    def refused(self):
        return int(self.diagnosed["global_planner"]["parameter changes refused"])

    def ways(self):
        """How many paths to a place behind the block the planner optimises."""
        answer = self.plan(PoseStamped(), pose(*BEHIND_THE_BLOCK))
        self.assertTrue(answer.success, answer.status.message)
        return len(answer.candidates)

    def test_offers_what_the_schemas_mark_as_live(self):
        types = {"int": int, "double": float, "str": str, "bool": bool}
        for node in NODES:
            declared = schema(node)
            client = self.client(node)
            offered = {entry["name"]: entry for entry in client.get_parameter_descriptions()}
            self.assertEqual(set(offered), set(declared))
            for name, entry in offered.items():
                self.assertIs(types[entry["type"]], type(declared[name]["default"]), name)
                self.assertEqual(entry["default"], declared[name]["default"])
                self.assertEqual(client.get_configuration()[name], declared[name]["default"])
                self.assertIn(declared[name]["about"], entry["description"])
                if "choices" in declared[name]:
                    choices = [constant["value"] for constant in eval(entry["edit_method"])["enum"]]
                    self.assertEqual(choices, declared[name]["choices"])
                else:
                    self.assertEqual((entry["min"], entry["max"]), (declared[name]["min"], declared[name]["max"]))

    def test_a_change_is_in_force_at_once(self):
        self.assertGreater(self.ways(), 1)
        client = self.client()
        answer = client.update_configuration({"classes": 1, "roadmap": "VISIBILITY_PRM"})
        self.assertEqual((answer["classes"], answer["roadmap"]), (1, "visibility_prm"))
        self.assertEqual(self.ways(), 1)
        self.assertEqual(self.client().get_configuration()["classes"], 1)
        self.assertEqual(rospy.get_param("/ugv1/global_planner/roadmap"), "visibility_prm")
        client.update_configuration({"classes": 6, "roadmap": "best"})
        self.assertGreater(self.ways(), 1)

    def test_says_that_paths_are_the_lattices_where_the_roadmap_has_too_few_samples(self):
        words = "a path of the lattice: the roadmap led nowhere"
        self.client().update_configuration({"roadmap": "visibility_prm", "prm_samples": 1})
        answer = self.plan(PoseStamped(), pose(*BEHIND_THE_BLOCK))
        self.assertEqual([one.kind for one in answer.candidates[0].status.effort.fallbacks if one.message.startswith(words)], [Fallback.LATTICE_PATH])
        before = int(self.diagnosed["global_planner"]["plans with " + words])
        self.robot.send(*BEHIND_THE_BLOCK)
        self.robot.run_until(lambda: int(self.diagnosed["global_planner"]["plans with " + words]) > before, PATIENCE_S, "diagnostics count it")
        self.assertIn(words + ", at (", self.diagnosed["global_planner"]["the last plan fell back on"])
        told = [one for one in self.fallbacks if one.kind == Fallback.LATTICE_PATH]
        self.assertEqual([(one.in_last_plan, one.plans > before) for one in told], [(True, True)])
        self.robot.client.cancel_all_goals()
        self.robot.run_until(self.robot.done, PATIENCE_S, "it gives the goal up")

    def test_a_tolerance_counts_for_the_next_look_at_a_goal(self):
        x, y = self.robot.place()
        self.client().update_configuration({"goal_tolerance": 1.0})
        self.robot.send(x + 0.6, y)
        self.robot.run_until(self.robot.done, PATIENCE_S, "it is there already")
        self.assertEqual(self.robot.outcome()[0], "SUCCEEDED", self.robot.report())
        self.assertLess(self.robot.distance_to(x, y), 0.1, "it need not move")

    def test_values_out_of_range_are_clamped(self):
        since = self.robot.now
        answer = self.client().update_configuration({"classes": 0, "longest_ratio": math.inf})
        self.assertEqual((answer["classes"], answer["longest_ratio"]), (1, 100.0))
        self.robot.run_until(lambda: self.robot.said("classes = 0: clamped to 1", since), PATIENCE_S, "the log says so")
        self.assertEqual(self.ways(), 1)

    def test_why_a_change_was_refused_is_in_diagnostics(self):
        for node in NODES:
            with self.subTest(node):
                request = Config(doubles=[DoubleParameter("gian", 1.0)])
                with self.assertRaises(rospy.ServiceException):
                    rospy.ServiceProxy("/ugv1/%s/set_parameters" % node, Reconfigure)(request)
                self.robot.run_until(lambda: "gian" in self.diagnosed[node].get("last refused change", ""), PATIENCE_S, "diagnostics say why")

    def test_refused_as_a_whole(self):
        client = self.client()
        service = rospy.ServiceProxy("/ugv1/global_planner/set_parameters", Reconfigure)
        before = dict(client.get_configuration())
        counted = self.refused()
        wrong = (({"ints": [IntParameter("clases", 2)]}, "unknown parameter `clases`"),
                 ({"ints": [IntParameter("longest_ratio", 3)]}, "longest_ratio = 3: expected a number"),
                 ({"doubles": [DoubleParameter("longest_ratio", math.nan)]}, "longest_ratio = nan"),
                 ({"doubles": [DoubleParameter("planning_time", 1.0)]}, "planning_time: is read at the start only"),
                 ({"bools": [BoolParameter("goal_timeout", True)]}, "goal_timeout = true: expected a number"),
                 ({"strs": [StrParameter("roadmap", "streets")]}, "roadmap = streets: expected one of best"))
        for values, words in wrong:
            request = Config(**values)
            request.doubles.append(DoubleParameter("min_improvement", 0.5))
            with self.subTest(words), self.assertRaises(rospy.ServiceException):
                service(request)
            self.robot.run_until(lambda: self.robot.said(words), PATIENCE_S, words)
        self.robot.run_until(lambda: self.refused() == counted + len(wrong), PATIENCE_S, "all are counted")
        answer = service(Config()).config
        self.assertEqual({value.name: value.value for value in answer.doubles + answer.ints + answer.strs},
                         {name: value for name, value in before.items() if name != "groups"})

    def test_map_rate(self):
        def maps_of(seconds):
            self.robot.run(1.0)
            since = self.robot.now
            self.robot.run(seconds)
            return sum(since < stamp_s <= since + seconds for stamp_s in self.maps.stamps_s())

        self.assertGreater(maps_of(4.0), 5)
        self.client("perception").update_configuration({"map_rate": 0.5})
        self.assertLessEqual(maps_of(4.0), 3)

    def drive(self, x, y, gains):
        """Turns and drives across the hall, as soon as it moves with other weights and gains; the mean error across [m]."""
        del self.errors[:]
        self.robot.send(x, y)
        self.robot.run_until(lambda: not self.robot.standing(), PATIENCE_S, "it moves")
        self.client("trajectory_tracker").update_configuration(gains)
        self.client().update_configuration({"weight_duration": 2.0, "soft_margin": 0.3})
        self.robot.run_until(self.robot.done, 60.0, "it arrives")
        self.assertEqual(self.robot.outcome()[0], "SUCCEEDED", self.robot.report())
        return sum(abs(error.vector.y) for error in self.errors) / len(self.errors)

    def test_weights_and_gains_change_while_driving(self):
        self.robot.arrive(4.0, -1.5)
        stiff_m = self.drive(-4.0, 1.5, {"across_gain": 2.5})
        slack_m = self.drive(4.0, -1.5, {"across_gain": 0.1, "max_bandwidth": 0.1, "heading_gain": 0.1, "damping": 0.3})
        self.assertGreater(slack_m, 5.0 * stiff_m)

    def test_a_respawned_node_has_them_again(self):
        self.client().update_configuration({"classes": 1, "min_improvement": 0.3})
        os.kill(self.robot.process("global_planner"), signal.SIGKILL)
        self.robot.run(2.0)
        self.robot.wait_for_node("global_planner")
        self.robot.run_until(lambda: self.plan(PoseStamped(), pose(*BEHIND_THE_BLOCK)).success, PATIENCE_S, "it has a map again")
        values = self.client().get_configuration()
        self.assertEqual((values["classes"], values["min_improvement"]), (1, 0.3))
        self.assertEqual(self.ways(), 1)
        self.assertEqual(self.robot.truth.contacts, 0)


if __name__ == "__main__":
    rospy.init_node("live_parameters_test")
    rostest.rosrun("mocha_ugv", "live_parameters", LiveParametersTest, sys.argv)
