#!/usr/bin/python3
"""Two trajectory_broadcaster nodes settle crossing motions; this test proposes for both robots."""

import math
import sys
import threading
import time
import unittest

import rosnode
import rospy
import rostest
from diagnostic_msgs.msg import DiagnosticArray
from geometry_msgs.msg import Point
from mocha_ugv.msg import FleetTrajectories, Heartbeat, MotionPhase, PlannerStatus, Trajectory, WayRequest

RADIUS_M = 0.3
LEAD_S = 1.5  # long, so that a busy machine does not decide the test


class Robot:
    """The local replanner's side of one broadcaster."""

    def __init__(self, name):
        self.name = name
        self.sequence = 0
        self.committed = []
        self.settlements = {}
        self.fleet = None
        self.ways = []
        self.diagnosis = {}
        self.changed = threading.Condition()
        self.proposals = rospy.Publisher("/%s/proposed_trajectory" % name, Trajectory, queue_size=10)
        rospy.Subscriber("/%s/committed_trajectory" % name, Trajectory, self.on_committed)
        rospy.Subscriber("/%s/settlement" % name, PlannerStatus, self.on_settlement)
        rospy.Subscriber("/%s/fleet/trajectories" % name, FleetTrajectories, self.on_fleet)
        self.way_requests = rospy.Publisher("/%s/way_request" % name, WayRequest, queue_size=10)
        rospy.Subscriber("/%s/fleet/way_requests" % name, WayRequest, self.on_way)
        rospy.Subscriber("/diagnostics", DiagnosticArray, self.on_diagnostics)

    def on_committed(self, message):
        with self.changed:
            self.committed.append(message)
            self.changed.notify_all()

    def on_settlement(self, status):
        with self.changed:
            self.settlements[int(status.message.split()[1].rstrip(":"))] = status
            self.changed.notify_all()

    def on_fleet(self, fleet):
        with self.changed:
            self.fleet = fleet
            self.changed.notify_all()

    def on_way(self, request):
        with self.changed:
            self.ways.append(request)
            self.changed.notify_all()

    def on_diagnostics(self, array):
        for status in array.status:
            if status.hardware_id == self.name:
                with self.changed:
                    self.diagnosis.update({value.key: value.value for value in status.values})
                    self.changed.notify_all()

    def refused(self):
        return sum(int(self.diagnosis.get("refused " + what, 0)) for what in ("proposals", "messages"))

    def wait_for(self, condition, timeout_s=10.0):
        with self.changed:
            return self.changed.wait_for(condition, timeout_s)

    def propose(self, start, end, state=Trajectory.PROPOSED, **changes):
        """A straight drive from rest to rest at about 1 m/s; returns its sequence."""
        self.sequence += 1
        message = drive(start, end)
        message.agent = self.name
        message.sequence = self.sequence
        message.state = state
        for field, value in changes.items():
            setattr(message, field, value)
        self.proposals.publish(message)
        return self.sequence

    def settlement(self, sequence):
        assert self.wait_for(lambda: sequence in self.settlements), "no settlement of %d" % sequence
        return self.settlements[sequence]

    def await_committed(self, sequence):
        """The settlement may be heard before it: they are two topics."""
        drives = lambda: self.committed and self.committed[-1].sequence == sequence
        assert self.wait_for(drives), "%d is not committed" % sequence

    def set_down(self, place):
        """Puts the robot at rest somewhere, whatever it has promised: only an emergency may jump."""
        sequence = self.propose(place, place, Trajectory.EMERGENCY)
        self.settlement(sequence)
        self.await_committed(sequence)
        return sequence

    def bind(self, start, end):
        """Proposes until it is binding: a broadcaster that has just started refuses for a while."""
        for _ in range(20):
            sequence = self.propose(start, end)
            if self.settlement(sequence).reason == PlannerStatus.SOLVED:
                self.await_committed(sequence)
                return sequence
            time.sleep(0.3)
        raise AssertionError("never binding: " + self.settlements[sequence].message)


def drive(start, end):
    message = Trajectory()
    message.header.stamp = rospy.Time.now()
    message.header.frame_id = "map"
    message.footprint_radius = RADIUS_M
    message.start = rospy.Time.now() + rospy.Duration(LEAD_S)
    message.s = 3
    phase = MotionPhase()
    phase.kind = MotionPhase.DRIVE
    phase.direction = 1
    phase.durations = [max(1.0, math.dist(start, end))]
    phase.x = [start[0], end[0]]
    phase.y = [start[1], end[1]]
    phase.start_derivatives = phase.end_derivatives = [0.0] * 4  # from rest to rest
    message.phases = [phase]
    return message


def way_request(**changes):
    request = WayRequest(agent="race1", stuck=True, priority=-3, behalf="race0", radius=RADIUS_M, speed=1.0)
    request.header.frame_id = "map"
    request.way = [Point(1.5, 2.0, 0.0), Point(3.0, -4.25, 0.0)]
    for field, value in changes.items():
        setattr(request, field, value)
    return request


class BroadcasterTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.first, cls.second = Robot("race1"), Robot("race2")
        cls.promises = rospy.Publisher("/fleet/promises", Trajectory, queue_size=10)
        for robot in (cls.first, cls.second):
            deadline = time.time() + 20.0
            while robot.proposals.get_num_connections() == 0 and time.time() < deadline:
                time.sleep(0.05)
        rospy.wait_for_message("/fleet/heartbeats", Heartbeat, 20.0)
        time.sleep(2.0)  # the listening

    def test_1_exactly_one_of_two_crossing_motions_is_binding(self):
        for trial in range(5):
            y = 100.0 * trial
            begun = {robot.name: len(robot.committed) for robot in (self.first, self.second)}
            self.first.set_down((-3.0, y))
            self.second.set_down((0.0, y - 3.0))
            time.sleep(LEAD_S + 0.2)
            one = self.first.propose((-3.0, y), (3.0, y))
            two = self.second.propose((0.0, y - 3.0), (0.0, y + 3.0))
            winner = self.first.settlement(one)
            loser = self.second.settlement(two)
            solved = [status.reason == PlannerStatus.SOLVED for status in (winner, loser)]
            self.assertEqual(sum(solved), 1, (winner.message, loser.message))
            # The second may have been settled before the first was proposed.
            robot, sequence = (self.second, two) if solved[1] else (self.first, one)
            robot.await_committed(sequence)
            if solved[1]:
                loser = winner
            self.assertEqual(loser.reason, PlannerStatus.PEER_CONFLICT)
            self.assertEqual(loser.violated, PlannerStatus.SEPARATION)
            self.assertIn(loser.peer, ("race1", "race2"))
            self.assertGreater(loser.limit, 2 * RADIUS_M)
            self.assertLess(loser.value, loser.limit)
            self.assertLess(math.hypot(loser.place.x, loser.place.y - y), 1.5)
            total = sum(len(robot.committed) - begun[robot.name] for robot in (self.first, self.second))
            self.assertEqual(total, 3)  # two set down, one driven

    def test_2_the_peer_is_told(self):
        sequence = self.first.set_down((50.0, 50.0))
        told = lambda: self.second.fleet and any(
            each.agent == "race1" and abs(each.phases[-1].x[-1] - 50.0) < 1e-6
            for each in self.second.fleet.trajectories)
        self.assertTrue(self.second.wait_for(told))
        self.assertFalse(any(each.agent == "race2" for each in self.second.fleet.trajectories))
        committed = self.first.committed[-1]
        self.assertEqual(committed.state, Trajectory.EMERGENCY)
        self.assertEqual(committed.sequence, sequence)
        self.assertEqual(committed.agent, "race1")

    def test_3_bad_messages_are_refused_and_counted(self):
        here = (70.0, 70.0)
        self.first.set_down(here)
        before = self.first.refused()
        count = len(self.first.committed)
        for changes in ({"footprint_radius": -1.0}, {"footprint_radius": float("nan")}, {"agent": "race2"},
                        {"phases": []}, {"state": Trajectory.PLANNED}, {"s": 2}):
            status = self.first.settlement(self.first.propose(here, (72.0, 70.0), **changes))
            self.assertEqual(status.reason, PlannerStatus.INVALID_INPUT, status.message)
        status = self.first.settlement(self.first.propose((75.0, 70.0), (76.0, 70.0)))
        self.assertEqual(status.reason, PlannerStatus.INVALID_INPUT)
        self.assertIn("does not begin", status.message)
        impostor = drive(here, (72.0, 70.0))
        impostor.agent, impostor.epoch, impostor.sequence = "race1", 0, 1
        impostor.state = Trajectory.COMMITTED
        self.promises.publish(impostor)
        impostor.agent = "race3"
        impostor.phases[0].x = [70.0, float("nan")]
        self.promises.publish(impostor)
        counted = lambda: self.first.refused() >= before + 8
        self.assertTrue(self.first.wait_for(counted), self.first.diagnosis)
        self.assertEqual(len(self.first.committed), count)

    def test_4_way_requests_reach_the_others_in_the_own_name_only(self):
        before = self.first.refused()
        for changes in ({"agent": "race2"}, {"behalf": ""}, {"radius": float("nan")}, {"speed": 0.0},
                        {"way": [Point()] * 65}, {"way": [Point(float("inf"), 0.0, 0.0)]}):
            self.first.way_requests.publish(way_request(**changes))
        counted = lambda: self.first.refused() >= before + 6
        self.assertTrue(self.first.wait_for(counted), self.first.diagnosis)
        self.first.way_requests.publish(way_request())
        self.assertTrue(self.second.wait_for(lambda: self.second.ways))
        heard, = self.second.ways
        self.assertEqual((heard.agent, heard.behalf, heard.stuck, heard.priority), ("race1", "race0", True, -3))
        self.assertEqual([(point.x, point.y) for point in heard.way], [(1.5, 2.0), (3.0, -4.25)])
        self.assertGreater(heard.epoch, 0)
        self.assertFalse(self.first.ways)  # its own

    def test_5_a_killed_broadcaster_comes_back_with_a_new_epoch(self):
        self.second.set_down((-20.0, -20.0))
        time.sleep(LEAD_S + 0.2)
        self.second.bind((-20.0, -20.0), (-15.0, -20.0))
        epoch = self.second.committed[-1].epoch
        rosnode.kill_nodes(["/race2/trajectory_broadcaster"])
        time.sleep(1.0)
        deadline = time.time() + 20.0
        while self.second.proposals.get_num_connections() == 0 and time.time() < deadline:
            time.sleep(0.05)
        time.sleep(0.5)
        # Elsewhere: nothing is known to be binding any more, so no continuity is asked.
        self.second.bind((-20.0, -30.0), (-15.0, -30.0))
        self.assertEqual(self.second.committed[-1].epoch, epoch + 1)
        heard = lambda: any(each.agent == "race2" and each.epoch == epoch + 1
                            for each in self.first.fleet.trajectories)
        self.assertTrue(self.first.wait_for(heard))


if __name__ == "__main__":
    rospy.init_node("broadcaster_test")
    rostest.rosrun("mocha_ugv", "broadcaster_test", BroadcasterTest, sys.argv)
