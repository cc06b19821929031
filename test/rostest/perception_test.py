#!/usr/bin/python3
"""The perception node from outside: map, stamps, services and what it says when something is missing."""

import math
import os
import shutil
import signal
import tempfile
import unittest

import rospy
import rostest
import tf2_ros
from diagnostic_msgs.msg import DiagnosticArray
from geometry_msgs.msg import PoseStamped, TransformStamped
from mocha_ugv.msg import PredictedObstacles
from mocha_ugv.srv import LoadMap, PlanTrajectory, SaveMap
from nav_msgs.msg import OccupancyGrid
from sensor_msgs.msg import LaserScan
from std_srvs.srv import Trigger

from lockstep_clock import STEP_NS, LockstepClock
from map_listener import MapListener
from node_process import end, is_connected, pid_of
from waiting import wait_until

HALF_ROOM = 2.0  # m
BEYOND_DOOR = 4.0  # m, along -y
SCAN_STEPS = 5  # of the clock, from scan to scan


def scan_of_room(door=0.0):
    """What a lidar in the middle of a square room sees, which has a door of a width in its south wall."""
    scan = LaserScan()
    scan.header.frame_id = "ugv1/laser"
    beams = 720
    scan.angle_min = -math.pi
    scan.angle_increment = 2.0 * math.pi / beams
    scan.angle_max = scan.angle_min + (beams - 1) * scan.angle_increment
    scan.range_min = 0.1
    scan.range_max = 10.0
    angles = [scan.angle_min + i * scan.angle_increment for i in range(beams)]
    through = lambda a: math.sin(a) < 0.0 and abs(HALF_ROOM * math.cos(a) / math.sin(a)) < 0.5 * door
    scan.ranges = [-BEYOND_DOOR / math.sin(a) if through(a) else HALF_ROOM / max(abs(math.cos(a)), abs(math.sin(a))) for a in angles]
    return scan


def transform(stamp, parent, child):
    message = TransformStamped()
    message.header.frame_id = parent
    message.header.stamp = stamp
    message.child_frame_id = child
    message.transform.rotation.w = 1.0
    return message


class PerceptionTest(unittest.TestCase):
    def setUp(self):
        self.maps = MapListener()
        self.predictions = []
        self.words = {}
        rospy.Subscriber("/ugv1/predicted_obstacles", PredictedObstacles, self.predictions.append)
        rospy.Subscriber("/diagnostics", DiagnosticArray, self.on_diagnostics)
        self.scans = rospy.Publisher("/ugv1/scan", LaserScan, queue_size=5)
        self.transforms = tf2_ros.StaticTransformBroadcaster()
        self.directory = tempfile.mkdtemp()
        self.clock = LockstepClock({("ugv1", "perception")})
        self.clock.start()
        wait_until(lambda: is_connected("/ugv1/perception"), "perception is connected")

    def tearDown(self):
        shutil.rmtree(self.directory)

    def on_diagnostics(self, message):
        for status in message.status:
            if status.name.endswith("sensors"):
                self.words = {"level": status.level, "message": status.message,
                              "values": {value.key: value.value for value in status.values}}

    def wait_for(self, condition, seconds=10.0, scan=None):
        """Publishes scans at 10 Hz of simulated time until the condition holds. Whether it does."""
        end_s = self.clock.now_s + seconds
        while self.clock.now_s < end_s and not condition():
            if scan is not None:
                scan.header.stamp = self.clock.stamp()
                self.scans.publish(scan)
            self.clock.run(1e-9 * SCAN_STEPS * STEP_NS)
            self.clock.settle()
        return condition()

    def said(self, text):
        return text in self.words.get("message", "")

    def cell(self, x, y):
        return self.maps.cell(x, y)

    def publications(self):
        return len(self.maps.stamps_s())

    def test_a_robot_in_a_room(self):
        self.assertTrue(self.wait_for(lambda: self.said("no scan on /ugv1/scan for")), self.words)

        self.assertTrue(self.wait_for(lambda: self.said("no transform map <- ugv1/laser"), 10.0, scan_of_room()),
                        self.words)
        self.assertIsNone(self.maps.map)

        stamp = self.clock.stamp()
        self.transforms.sendTransform([transform(stamp, "map", "ugv1/base_link"), transform(stamp, "ugv1/base_link", "ugv1/laser")])
        self.assertTrue(self.wait_for(lambda: self.publications() >= 3, 10.0, scan_of_room()))
        self.assertTrue(self.wait_for(lambda: self.said("scans enter the map"), 5.0, scan_of_room()), self.words)
        self.assertEqual(self.maps.map.header.frame_id, "map")
        self.assertEqual(self.cell(1.0, 0.5), 0)
        self.assertEqual(self.cell(0.0, 0.0), 0)
        self.assertEqual(self.cell(HALF_ROOM + 0.01, 0.5), 100)
        self.assertEqual(self.cell(HALF_ROOM + 0.3, 0.5), -1)

        # Nothing moves, and every scan says so.
        self.assertGreaterEqual(len(self.predictions), self.publications())
        self.assertGreater(self.predictions[-1].header.stamp, self.predictions[0].header.stamp)
        self.assertEqual(self.predictions[-1].header.frame_id, "map")
        self.assertFalse(any(message.obstacles for message in self.predictions))

        # Zones to keep out of look occupied, seen or not, and nothing around them does.
        self.assertEqual(self.cell(-1.25, 0.75), 100)
        self.assertEqual(self.cell(-1.25, 1.2), 0)
        self.assertEqual(self.cell(4.9, 0.5), 100)
        self.assertEqual(self.cell(4.1, 0.8), -1)

        # An unchanged map gets a fresh stamp as long as scans come in, and only then.
        newest = self.maps.map.header.stamp
        self.assertTrue(self.wait_for(lambda: (self.maps.map.header.stamp - newest).to_sec() > 2.0, 5.0, scan_of_room()))
        self.clock.run(1.0)
        self.clock.settle()
        maps = self.publications()
        self.clock.run(1.5)
        self.clock.settle()
        self.assertEqual(self.publications(), maps)

        self.a_door_opens()

        for name in ("map.bt", "map.ot", "map.yaml"):
            self.save_clear_and_load(os.path.join(self.directory, name))
        self.malformed_scan()

    def plans_through_the_door(self):
        start, goal = PoseStamped(), PoseStamped()
        start.header.frame_id = goal.header.frame_id = "map"
        goal.pose.position.y = -3.0
        rospy.wait_for_service("/ugv1/plan", 30.0)
        return rospy.ServiceProxy("/ugv1/plan", PlanTrajectory)(start, goal).success

    def a_door_opens(self):
        """What changes comes as updates, and who comes late has it as well: so has a planner that is started again."""
        self.assertFalse(self.plans_through_the_door())
        room = scan_of_room(1.6)
        self.assertTrue(self.wait_for(lambda: self.cell(0.0, 0.3 - BEYOND_DOOR) == 0, 10.0, room), "the map has grown")
        grids, updates = len(self.maps.grids), len(self.maps.updates)
        self.assertTrue(self.wait_for(lambda: self.cell(0.0, -HALF_ROOM - 0.01) == 0 and self.plans_through_the_door(), 20.0, room))
        self.assertEqual(len(self.maps.grids), grids)
        self.assertGreater(len(self.maps.updates), updates)
        self.assertLess(max(update.width * update.height for update in self.maps.updates[updates:]), 0.2 * len(self.maps.map.data))

        before = self.maps
        before.unregister()
        self.maps = MapListener()
        wait_until(lambda: self.maps.map is not None, "who comes late has a map")
        self.assertEqual(self.maps.map.header.stamp, before.map.header.stamp)
        self.assertEqual(self.maps.map.data.tolist(), before.map.data.tolist())
        end("/ugv1/global_planner", signal.SIGKILL)
        self.assertTrue(self.wait_for(self.plans_again, 20.0, room))
        self.assertEqual(len(self.maps.grids), 1, "others do not hear it all again")
        self.who_listens_to_grids_alone_gets_them_whole(room)

    def who_listens_to_grids_alone_gets_them_whole(self, room):
        self.maps.unregister()
        grids = []
        alone = rospy.Subscriber("/ugv1/map", OccupancyGrid, grids.append)
        self.assertTrue(self.wait_for(lambda: len(grids) >= 4, 10.0, room))
        alone.unregister()
        self.maps = MapListener()
        wait_until(lambda: self.maps.map is not None, "the map is heard again")

    def plans_again(self):
        try:
            return self.plans_through_the_door()
        except rospy.ServiceException:
            return False  # it is just being started

    def save_clear_and_load(self, path):
        saved = rospy.ServiceProxy("/ugv1/save_map", SaveMap)(path)
        self.assertTrue(saved.success, saved.message)
        self.assertTrue(rospy.ServiceProxy("/ugv1/clear_map", Trigger)().success)
        self.assertTrue(self.wait_for(lambda: self.cell(1.0, 0.5) == -1), "a cleared map is published")
        self.assertEqual(self.cell(0.0, 0.0), 0, "what is under the body stays free")
        self.assertEqual(self.cell(-1.25, 0.75), 100)
        loaded = rospy.ServiceProxy("/ugv1/load_map", LoadMap)(path)
        self.assertTrue(loaded.success, loaded.message)
        self.assertTrue(self.wait_for(lambda: self.cell(1.0, 0.5) == 0))
        self.assertEqual(self.cell(HALF_ROOM + 0.01, 0.5), 100)
        missing = rospy.ServiceProxy("/ugv1/load_map", LoadMap)(path + ".none.bt")
        self.assertFalse(missing.success)
        self.assertIn(path + ".none.bt", missing.message)
        relative = os.path.relpath(path, os.readlink("/proc/%d/cwd" % pid_of("/ugv1/perception")))
        for service, kind, word in (("save_map", SaveMap, "saved "), ("load_map", LoadMap, "loaded ")):
            answer = rospy.ServiceProxy("/ugv1/" + service, kind)(relative)
            self.assertEqual((answer.success, answer.message), (True, word + path))

    def malformed_scan(self):
        scan = scan_of_room()
        scan.angle_increment = float("nan")
        key = "refused: scan: angles, times or ranges that are not finite"
        self.assertTrue(self.wait_for(lambda: key in self.words["values"], 10.0, scan), self.words)


if __name__ == "__main__":
    rospy.init_node("perception_test", disable_rostime=True)
    rostest.rosrun("mocha_ugv", "perception", PerceptionTest)
