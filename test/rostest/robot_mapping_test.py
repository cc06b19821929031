#!/usr/bin/python3
"""A robot that knows nothing drives through a flat and back, makes a map of it, and saves it; its localiser dies, and goes on in the same map;
in another one it takes that in."""

import math
import os
import shutil
import signal
import sys
import tempfile
import unittest

import rospy
import rostest
from geometry_msgs.msg import Pose2D
from mocha_ugv.msg import Localization, PoseGraph
from mocha_ugv.srv import GetKeyframes, LoadMap, SaveMap

from simulated_robot import SimulatedRobot
from waiting import wait_until

WAYPOINTS = [(1.0, 3.5), (6.2, 0.8), (6.0, 3.4), (0.0, 0.0)]  # all three rooms
MAP_ERROR_M = 0.15
SAVING_S = 31.0


class RobotMappingTest(unittest.TestCase):
    def setUp(self):
        self.directory = tempfile.mkdtemp()
        self.addCleanup(shutil.rmtree, self.directory)

    def drive(self, robot, x, y, origin=Pose2D()):
        """To a place of the simulator, by a map that begins at a pose there."""
        dx, dy, c, s = x - origin.x, y - origin.y, math.cos(origin.theta), math.sin(origin.theta)
        robot.send(c * dx + s * dy, c * dy - s * dx)
        robot.run_until(robot.done, 90.0, "it reaches (%.1f, %.1f)" % (x, y))
        self.assertEqual(robot.outcome()[0], "SUCCEEDED", robot.report())
        self.assertLess(robot.distance_to(x, y), MAP_ERROR_M, robot.report())
        print("%.3f m from (%.1f, %.1f)" % (robot.distance_to(x, y), x, y))

    def refusal(self, service, path):
        answer = service(path)
        self.assertFalse(answer.success)
        return answer.message

    @staticmethod
    def made_anew(robot):
        """How often perception has made its map anew."""
        return max(int(values.get("maps made anew of moved keyframes", 0)) for values in robot.values.values())

    def test_maps_a_flat(self):
        graphs, states = [], []
        rospy.Subscriber("/ugv3/pose_graph", PoseGraph, graphs.append)
        rospy.Subscriber("/ugv3/localization", Localization, states.append)
        robot = SimulatedRobot("ugv3")
        robot.start()
        for x, y in WAYPOINTS:
            self.drive(robot, x, y)
        self.assertEqual(robot.truth.contacts, 0)
        saved = os.path.join(self.directory, "flat.bt")
        answer = rospy.ServiceProxy("/ugv3/save_map", SaveMap)(saved)
        self.assertTrue(answer.success, answer.message)
        self.assertGreater(os.path.getsize(saved), 10000)
        keyframes = rospy.ServiceProxy("/ugv3/get_keyframes", GetKeyframes)(0).keyframes
        self.assertGreater(len(keyframes), 30)
        self.assertEqual(len(keyframes), len(graphs[-1].keyframes))
        self.assertGreater(min(len(keyframe.hits) for keyframe in keyframes), 50)

        robot.run(SAVING_S)
        before = robot.process("scan_localizer")
        os.kill(before, signal.SIGKILL)
        wait_until(lambda: robot.process("scan_localizer") not in (None, before), "the localiser is started again")
        del states[:]
        robot.run_until(lambda: any(state.state == Localization.LOCALIZED for state in states), 20.0, "it finds its place in the map that it has driven")
        self.assertNotEqual(states[0].state, Localization.LOCALIZED)  # it did not begin another one
        self.drive(robot, 1.0, 3.5)
        self.assertGreater(len(graphs[-1].keyframes), len(keyframes))
        self.assertEqual(robot.truth.contacts, 0)

        # Without the file it begins another map, and so does perception.
        before = robot.process("scan_localizer")
        earlier = rospy.get_param("/ugv3/scan_localizer/pose_graph_file")
        kept = os.path.join(self.directory, "earlier.g2o")
        shutil.move(earlier, kept)
        origin = robot.truth.pose
        os.kill(before, signal.SIGKILL)
        wait_until(lambda: robot.process("scan_localizer") not in (None, before), "the localiser is started again")
        del graphs[:]
        made = self.made_anew(robot)
        robot.run_until(lambda: graphs and len(graphs[-1].keyframes) == 1, 20.0, "another map is begun")
        robot.run_until(lambda: self.made_anew(robot) > made, 10.0, "perception has begun another map as well")

        # The earlier drive is merged into it; then places are known that only that one has seen.
        merge = rospy.ServiceProxy("/ugv3/merge_pose_graph", LoadMap)
        self.assertIn("nothing.g2o", self.refusal(merge, os.path.join(self.directory, "nothing.g2o")))
        made = self.made_anew(robot)
        answer = merge(kept)
        self.assertTrue(answer.success, answer.message)
        robot.run_until(lambda: len(graphs[-1].keyframes) > len(keyframes), 5.0, "the merged map is published")
        robot.run_until(lambda: self.made_anew(robot) > made, 20.0, "perception has made the merged map")
        self.drive(robot, 6.2, 0.8, origin)
        self.assertEqual(robot.truth.contacts, 0)


if __name__ == "__main__":
    rospy.init_node("robot_mapping_test")
    rostest.rosrun("mocha_ugv", "robot_mapping", RobotMappingTest, sys.argv)
