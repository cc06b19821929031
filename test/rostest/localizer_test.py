#!/usr/bin/python3
"""The scan_localizer node from outside: where it says the robot is, and what it says when it cannot know."""

import math
import os
import signal
import sys
import unittest

import numpy
import rospkg
import rospy
import rostest
import tf2_ros
import yaml
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
from geometry_msgs.msg import PoseWithCovarianceStamped, TransformStamped
from mocha_ugv.msg import Localization
from sensor_msgs.msg import LaserScan
from std_srvs.srv import Empty

from lockstep_clock import STEP_NS, LockstepClock
from node_process import end, is_connected
from waiting import wait_until

BEAMS = 360
SCAN_STEPS = 5  # of the clock, from scan to scan
NODE = "/ugv1/scan_localizer"
MEMORY = NODE + "/last_known_pose"


class World:
    """Circles and walls of a world file, as rays see them."""

    def __init__(self, circles, walls):
        self.circles = numpy.array(circles, dtype=float).reshape(-1, 3)
        self.walls = [(numpy.array(a, dtype=float), numpy.array(b, dtype=float)) for a, b in walls]

    @staticmethod
    def load(name):
        path = os.path.join(rospkg.RosPack().get_path("mocha_ugv"), "config", "worlds", name)
        with open(path) as file:
            world = yaml.safe_load(file)
        walls = [(polygon[i - 1], polygon[i]) for polygon in world["polygons"] for i in range(len(polygon))]
        return World(world["circles"], walls)

    def ranges(self, x, y, yaw):
        angles = yaw - math.pi + 2.0 * math.pi / BEAMS * numpy.arange(BEAMS)
        ray = numpy.stack([numpy.cos(angles), numpy.sin(angles)])
        origin = numpy.array([x, y])
        nearest = numpy.full(BEAMS, numpy.inf)
        for cx, cy, radius in self.circles:
            to = numpy.array([cx, cy]) - origin
            along = to @ ray
            half = radius ** 2 - (to @ to - along ** 2)
            hit = (along > 0.0) & (half > 0.0)
            nearest[hit] = numpy.minimum(nearest[hit], along[hit] - numpy.sqrt(half[hit]))
        for a, b in self.walls:
            edge = b - a
            cross = ray[0] * edge[1] - ray[1] * edge[0]
            with numpy.errstate(divide="ignore", invalid="ignore"):
                length = ((a - origin)[0] * edge[1] - (a - origin)[1] * edge[0]) / cross
                share = ((a - origin)[0] * ray[1] - (a - origin)[1] * ray[0]) / cross
            hit = (length > 0.0) & (share >= 0.0) & (share <= 1.0)
            nearest[hit] = numpy.minimum(nearest[hit], length[hit])
        return nearest


def transform(stamp, parent, child, x=0.0, y=0.0, yaw=0.0):
    message = TransformStamped()
    message.header.frame_id = parent
    message.header.stamp = stamp
    message.child_frame_id = child
    message.transform.translation.x = x
    message.transform.translation.y = y
    message.transform.rotation.z = math.sin(0.5 * yaw)
    message.transform.rotation.w = math.cos(0.5 * yaw)
    return message


def initial_pose(x, y, yaw, frame="map"):
    message = PoseWithCovarianceStamped()
    message.header.frame_id = frame
    message.pose.pose.position.x = x
    message.pose.pose.position.y = y
    message.pose.pose.orientation.z = math.sin(0.5 * yaw)
    message.pose.pose.orientation.w = math.cos(0.5 * yaw)
    message.pose.covariance[0] = message.pose.covariance[7] = 0.25
    message.pose.covariance[35] = 0.07
    return message


class LocalizerTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.corridor = World.load("corridor.yaml")
        cls.elsewhere = World([], [((-3, -3), (3, -3)), ((3, -3), (3, 3)), ((3, 3), (-3, 3)), ((-3, 3), (-3, -3))])
        cls.state = None
        cls.pose = None
        cls.words = {}
        cls.transforms = tf2_ros.Buffer()
        cls.listener = tf2_ros.TransformListener(cls.transforms)
        cls.broadcaster = tf2_ros.TransformBroadcaster()
        cls.static = tf2_ros.StaticTransformBroadcaster()
        cls.clock = LockstepClock({("ugv1", "scan_localizer")})
        cls.static.sendTransform([transform(cls.clock.stamp(), "ugv1/base_link", "ugv1/laser")])
        cls.scans = rospy.Publisher("/ugv1/scan", LaserScan, queue_size=5)
        cls.said = rospy.Publisher("/ugv1/initialpose", PoseWithCovarianceStamped, queue_size=5)
        rospy.Subscriber("/ugv1/localization", Localization, lambda m: setattr(cls, "state", m))
        rospy.Subscriber("/ugv1/localized_pose", PoseWithCovarianceStamped, lambda m: setattr(cls, "pose", m))
        rospy.Subscriber("/diagnostics", DiagnosticArray, cls.on_diagnostics)
        cls.start()

    @classmethod
    def start(cls):
        """Until the node is there, and hears everything."""
        cls.clock.start()
        wait_until(lambda: is_connected(NODE), "the node is connected")

    def setUp(self):
        """It knows nothing of where it is."""
        rospy.ServiceProxy("/ugv1/global_localization", Empty)()
        self.clock.settle()
        LocalizerTest.state = LocalizerTest.pose = None

    @classmethod
    def on_diagnostics(cls, message):
        for status in message.status:
            if "localisation" in status.name:
                cls.words = {"level": status.level, "message": status.message,
                             "values": {value.key: value.value for value in status.values}}

    def see(self, world, place, condition, seconds):
        """Scans from a place, with odometry that stands still, until the condition holds. Whether it does."""
        end_s = self.clock.now_s + seconds
        while self.clock.now_s < end_s and not condition():
            scan = LaserScan()
            scan.header.frame_id = "ugv1/laser"
            scan.header.stamp = self.clock.stamp()
            scan.angle_min = -math.pi
            scan.angle_increment = 2.0 * math.pi / BEAMS
            scan.angle_max = scan.angle_min + (BEAMS - 1) * scan.angle_increment
            scan.range_min = 0.1
            scan.range_max = 25.0
            scan.ranges = world.ranges(*place)
            self.broadcaster.sendTransform(transform(self.clock.stamp(), "ugv1/odom", "ugv1/base_link", 5.0, 5.0, 1.0))
            self.scans.publish(scan)
            self.clock.run(1e-9 * SCAN_STEPS * STEP_NS)
            self.clock.settle()
        return condition()

    def is_localized(self):
        return self.state is not None and self.state.state == Localization.LOCALIZED

    def is_at(self, place):
        if not self.is_localized() or self.pose is None:
            return False
        pose = self.pose.pose.pose
        yaw = 2.0 * math.atan2(pose.orientation.z, pose.orientation.w)
        off = math.hypot(pose.position.x - place[0], pose.position.y - place[1])
        return off < 0.06 and abs(math.remainder(yaw - place[2], 2.0 * math.pi)) < 0.03

    def localize(self, place, seconds=8.0):
        self.assertTrue(self.see(self.corridor, place, lambda: self.is_at(place), seconds), f"{self.state} {self.pose}")

    def remembers(self, place):
        words = rospy.get_param(MEMORY, "").split()
        return len(words) == 3 and math.dist([float(word) for word in words[:2]], place[:2]) < 0.1

    def newest_transform_s(self):
        try:
            return self.transforms.lookup_transform("map", "ugv1/odom", rospy.Time(0)).header.stamp.to_sec()
        except tf2_ros.TransformException:
            return 0.0

    def test_without_scans_it_says_so(self):
        self.clock.run(2.5)
        wait_until(lambda: "no scan on /ugv1/scan for" in self.words.get("message", ""), lambda: self.words)
        self.assertEqual(self.words["level"], DiagnosticStatus.ERROR, self.words)

    def test_finds_its_place_unasked(self):
        place = (6.2, -0.9, 2.0)
        self.localize(place)
        message = self.transforms.lookup_transform("map", "ugv1/odom", rospy.Time(0))
        yaw = 2.0 * math.atan2(message.transform.rotation.z, message.transform.rotation.w)
        x = message.transform.translation.x + 5.0 * math.cos(yaw) - 5.0 * math.sin(yaw)
        y = message.transform.translation.y + 5.0 * math.sin(yaw) + 5.0 * math.cos(yaw)
        self.assertLess(math.hypot(x - place[0], y - place[1]), 0.06)
        self.assertLess(self.state.sigma_position, 0.05)
        self.assertGreater(self.state.quality, 0.9)
        for variance in (0, 7, 35):
            self.assertGreater(self.pose.pose.covariance[variance], 0.0)
        self.assertTrue(self.see(self.corridor, place, lambda: self.words.get("level") == DiagnosticStatus.OK, 3.0), self.words)

    def test_nonsense_does_not_move_it(self):
        place = (6.2, -0.9, 2.0)
        self.localize(place)
        nan = initial_pose(float("nan"), 0.0, 0.0)
        negative = initial_pose(0.0, 0.0, 0.0)
        negative.pose.covariance[1] = negative.pose.covariance[6] = 5.0
        for nonsense in (initial_pose(0.0, 0.0, 0.0, "ugv1/odom"), nan, negative):
            self.said.publish(nonsense)
        broken = LaserScan()
        broken.header.frame_id = "ugv1/laser"
        broken.header.stamp = self.clock.stamp()
        broken.ranges = [1.0] * 10
        self.scans.publish(broken)
        self.assertTrue(self.see(self.corridor, place, lambda: sum("refused" in key for key in self.words.get("values", {})) >= 4, 5.0),
                        self.words)
        self.assertTrue(self.is_at(place), f"{self.state} {self.pose}")

    def test_carried_away_it_says_so_and_finds_itself_again(self):
        self.localize((6.2, -0.9, 2.0))
        there = (12.0, 0.3, -0.4)
        # It soon believes the old place no more, and says nothing wrong before it knows the new one.
        self.assertTrue(self.see(self.corridor, there, lambda: not self.is_localized(), 1.0), self.state)
        silent_s = self.newest_transform_s()
        self.assertTrue(self.see(self.corridor, there, self.is_localized, 5.0), self.state)
        self.assertTrue(self.is_at(there), self.pose)
        self.assertGreater(self.newest_transform_s(), silent_s + 0.5)

    def test_in_another_place_it_is_lost(self):
        self.localize((6.2, -0.9, 2.0))
        self.assertTrue(self.see(self.elsewhere, (1.0, 0.5, 0.2), lambda: not self.is_localized(), 2.0))
        since_s = self.newest_transform_s()
        self.see(self.elsewhere, (1.0, 0.5, 0.2), self.is_localized, 5.0)
        self.assertFalse(self.is_localized(), self.state)
        self.assertLess(self.newest_transform_s(), since_s + 0.15)
        self.assertEqual(self.words["level"], DiagnosticStatus.ERROR, self.words)
        self.localize((6.2, -0.9, 2.0))

    def test_takes_a_word(self):
        self.localize((6.2, -0.9, 2.0))
        there = (16.8, 0.2, 3.0)
        self.said.publish(initial_pose(there[0] + 0.4, there[1] - 0.3, there[2] + 0.2))
        self.localize(there, 5.0)

    def test_searches_when_asked(self):
        place = (6.2, -0.9, 2.0)
        self.localize(place)
        rospy.ServiceProxy("/ugv1/global_localization", Empty)()
        self.assertTrue(self.see(self.corridor, place, lambda: not self.is_localized(), 1.0))
        self.localize(place, 5.0)

    def test_killed_it_is_back(self):
        place = (6.2, -0.9, 2.0)
        self.localize(place)
        self.see(self.corridor, place, lambda: self.remembers(place), 5.0)
        self.assertTrue(self.remembers(place), rospy.get_param(MEMORY, "nothing"))
        before = self.newest_transform_s()
        end(NODE, signal.SIGKILL)
        self.start()
        LocalizerTest.state = LocalizerTest.pose = None
        self.localize(place, 15.0)
        self.assertGreater(self.newest_transform_s(), before)

    def test_with_walls_that_are_new_for_good_it_learns_them(self):
        place, column = (6.2, -0.9, 2.0), (4.9, 0.4, 0.2)
        changed = World(numpy.vstack([self.corridor.circles, column]), self.corridor.walls)
        learned = rospy.get_param(NODE + "/learned_map_file")
        self.assertFalse(os.path.exists(learned))
        self.localize(place)
        self.see(changed, place, lambda: False, 5.0)
        strange = self.state.quality
        self.assertTrue(self.see(changed, place, lambda: os.path.exists(learned), 80.0))
        self.see(changed, place, lambda: False, 5.0)
        self.assertGreater(self.state.quality, strange + 0.02)
        end(NODE, signal.SIGTERM)
        self.start()
        LocalizerTest.state = LocalizerTest.pose = None
        self.assertTrue(self.see(changed, place, lambda: self.is_at(place), 15.0), f"{self.state} {self.pose}")
        self.see(changed, place, lambda: False, 5.0)
        self.assertGreater(self.state.quality, strange + 0.02)
        with open(learned) as file:
            image = yaml.safe_load(file)["image"]
        for path in (learned, os.path.join(os.path.dirname(learned), image)):
            os.remove(path)


if __name__ == "__main__":
    rospy.init_node("localizer_test", disable_rostime=True)
    rostest.rosrun("mocha_ugv", "localizer", LocalizerTest, sys.argv)
