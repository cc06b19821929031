#!/usr/bin/python3
"""What the demo recorded replays: the map comes out as the world is, plans on it are certified, and nothing commands a base."""

import math
import os
import shutil
import subprocess
import sys
import tempfile
import time
import unittest

import numpy as np
import rosgraph
import rospkg
import rospy
import rostest
from geometry_msgs.msg import PoseStamped
from mocha_ugv.msg import PlannerStatus
from mocha_ugv.srv import PlanTrajectory
from rosgraph_msgs.msg import Clock

from map_listener import MapListener
from world_shapes import distance_to_circles, distance_to_surfaces, load_shapes, occupied_places

ROOT = rospkg.RosPack().get_path("mocha_ugv")
WORLD = os.path.join(ROOT, "config/worlds/corridor.yaml")
RECORDED_S = 9.0
PLANNING_FROM_S = 5.0  # into the recording
GOAL = (18.5, 1.2)
SEEN_X_M = 6.0  # what lies before this has been seen well by then
NEAR_M = 0.1  # a cell and its noise


def record(out):
    """A few seconds of the demo, which ends too early to arrive: that is its exit status 1."""
    environment = dict(os.environ, PYTHONPATH=ROOT + "/scripts:" + os.environ["PYTHONPATH"], ROS_HOME=out)
    return subprocess.run(["/usr/bin/python3", "-m", "mocha_scripts.demo", "--headless", "--rate", "0", "--world", WORLD,
                           "--limit", str(RECORDED_S), "--out", out],
                          env=environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, timeout=120.0)


class ReplayTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.out = tempfile.mkdtemp()
        cls.demo = record(cls.out)
        cls.maps = MapListener()
        cls.changed = cls.maps.changed
        cls.clocks = []
        rospy.Subscriber("/clock", Clock, cls.on_clock)
        log = open(os.path.join(cls.out, "replay.log"), "w")
        cls.replay = subprocess.Popen(["roslaunch", "--wait", "mocha_ugv", "replay.launch",
                                       "bag:=" + os.path.join(cls.out, "drive.bag")],
                                      stdout=log, stderr=subprocess.STDOUT)
        with cls.changed:
            cls.changed.wait_for(lambda: cls.maps.map is not None and cls.clocks and cls.clocks[-1] > 1.0 + PLANNING_FROM_S, 60.0)
        goal = PoseStamped()
        goal.header.frame_id = "map"
        goal.pose.position.x, goal.pose.position.y = GOAL
        cls.answer = rospy.ServiceProxy("/ugv1/plan", PlanTrajectory)(PoseStamped(), goal)
        cls.publishers = dict(rosgraph.Master("/replay_test").getSystemState()[0])
        cls.replay.wait(60.0)  # ends with the bag

    @classmethod
    def tearDownClass(cls):
        cls.replay.terminate()
        cls.replay.wait(20.0)
        shutil.rmtree(cls.out)

    @classmethod
    def on_clock(cls, message):
        with cls.changed:
            cls.clocks.append(message.clock.to_sec())
            cls.changed.notify_all()

    def log(self):
        with open(os.path.join(self.out, "replay.log")) as file:
            return self.demo.stdout + file.read()[-3000:]

    def test_the_demo_records_and_draws(self):
        for name in ("drive.bag", "map.png", "dynamics.png", "clearance.png", "separation.png"):
            self.assertGreater(os.path.getsize(os.path.join(self.out, name)), 5000, self.demo.stdout)
        self.assertIn("the limit of 9 simulated seconds is over", self.demo.stdout)
        self.assertEqual(self.demo.returncode, 1)

    def test_plans_are_certified_and_nothing_drives(self):
        self.assertEqual(self.answer.status.reason, PlannerStatus.SOLVED, self.answer.status.message + self.log())
        phases = self.answer.trajectory.phases
        self.assertLess(math.dist((phases[-1].x[-1], phases[-1].y[-1]), GOAL), 0.2)
        self.assertNotIn("/ugv1/cmd_vel", self.publishers)
        self.assertEqual([node for node in self.publishers["/ugv1/committed_trajectory"] if not node.startswith("/play")], [])
        self.assertIn("/ugv1/local_replanner", self.publishers["/ugv1/proposed_trajectory"])

    def test_the_map_is_as_the_world_is(self):
        circles, polygons = load_shapes(WORLD)
        places = occupied_places(self.maps.map)
        error = distance_to_surfaces(places, circles, polygons)
        self.assertGreater(len(places), 500)
        self.assertGreater(np.mean(error < NEAR_M), 0.99, "%d cells are occupied by nothing" % np.sum(error >= NEAR_M))
        for circle in circles[circles[:, 0] < SEEN_X_M]:
            seen = np.sum(distance_to_circles(places, circle[None, :]) < NEAR_M)
            self.assertGreater(seen * self.maps.map.info.resolution, circle[2], "too little of %s" % circle)
        for y in (-2.5, 2.5):
            wall = np.array([(x, y) for x in np.arange(-2.0, SEEN_X_M, 0.2)])
            nearest = np.linalg.norm(wall[:, None, :] - places[None, :, :], axis=2).min(axis=1)
            self.assertGreater(np.mean(nearest < NEAR_M), 0.9)


if __name__ == "__main__":
    rospy.init_node("replay_test")
    rostest.rosrun("mocha_ugv", "replay", ReplayTest, sys.argv)
