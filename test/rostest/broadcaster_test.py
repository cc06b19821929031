#!/usr/bin/python3
"""Two trajectory_broadcaster nodes settle crossing motions; this test proposes for both robots, and is their clock."""

import math
import signal
import sys
import unittest

import rospy
import rostest
from diagnostic_msgs.msg import DiagnosticArray
from geometry_msgs.msg import Point
from mocha_ugv.msg import (FleetTrajectories, Lease, MotionPhase, PassingInstruction, PassingIntent, PassingProgress, PassingTurn, Settlement,
                           Trajectory)

from lockstep_clock import LockstepClock
from node_process import end, is_connected
from waiting import wait_until

RADIUS_M = 0.3
LEAD_S = 1.0
LEASE_S = 2.0  # as the launch file grants at first: what this test hears and says may take many steps of its quick clock
SHORT_LEASE_S = 0.5
LISTENING_S = 2.0  # at least reach_timeout
NODES = {("race1", "trajectory_broadcaster"), ("race2", "trajectory_broadcaster")}


class Robot:
    """The local replanner's and the tracker's side of one broadcaster."""

    def __init__(self, name, clock):
        self.name = name
        self.clock = clock
        self.sequence = 0
        self.committed = []
        self.settlements = {}
        self.breaches = []
        self.fleet = None
        self.intents = []
        self.instructions = []
        self.diagnosis = {}
        self.driven = rospy.Publisher("/%s/driven_trajectory" % name, Trajectory, queue_size=1, latch=True)
        self.driven.publish(Trajectory())  # nothing yet
        self.proposals = rospy.Publisher("/%s/proposed_trajectory" % name, Trajectory, queue_size=10, tcp_nodelay=True)
        rospy.Subscriber("/%s/committed_trajectory" % name, Trajectory, self.on_committed, tcp_nodelay=True)
        rospy.Subscriber("/%s/settlement" % name, Settlement, self.on_settlement, tcp_nodelay=True)
        rospy.Subscriber("/%s/fleet/trajectories" % name, FleetTrajectories, self.on_fleet, tcp_nodelay=True)
        self.passing_intents = rospy.Publisher("/%s/passing_intent" % name, PassingIntent, queue_size=10, tcp_nodelay=True)
        self.passing_instructions = rospy.Publisher("/%s/passing_instruction" % name, PassingInstruction, queue_size=10, tcp_nodelay=True)
        rospy.Subscriber("/%s/fleet/passing_intents" % name, PassingIntent, self.intents.append, tcp_nodelay=True)
        rospy.Subscriber("/%s/fleet/passing_instructions" % name, PassingInstruction, self.instructions.append, tcp_nodelay=True)
        rospy.Subscriber("/diagnostics", DiagnosticArray, self.on_diagnostics)
        self.renews = True
        self.lease_s = LEASE_S
        self.leased_until = rospy.Time()
        self.leases = rospy.Publisher("/%s/lease" % name, Lease, queue_size=10, tcp_nodelay=True)
        clock.after_step.append(self.renew)

    def on_committed(self, message):
        self.committed.append(message)
        self.driven.publish(message)

    def renew(self):
        """The lease of what is driven, at every step of the clock."""
        if not self.renews or not self.committed:
            return
        committed = self.committed[-1]
        lease = Lease(epoch=committed.epoch, sequence=committed.sequence)
        lease.header.stamp = self.clock.stamp()
        self.leased_until = lease.valid_until = self.clock.stamp() + rospy.Duration(self.lease_s)
        self.leases.publish(lease)

    def on_settlement(self, settlement):
        if settlement.result == Settlement.BREACHED:
            self.breaches.append(settlement)
        else:
            self.settlements[settlement.sequence] = settlement

    def on_fleet(self, fleet):
        self.fleet = fleet

    def on_diagnostics(self, array):
        for status in array.status:
            if status.hardware_id == self.name:
                self.diagnosis.update({value.key: value.value for value in status.values})

    def refused(self):
        return sum(int(self.diagnosis.get("refused " + what, 0)) for what in ("proposals", "messages"))

    def diagnosed_refusals(self):
        """How many, once diagnostics have come round."""
        self.clock.run(1.2)
        self.clock.settle()
        return self.refused()

    def propose(self, start, end, state=Trajectory.PROPOSED, **changes):
        """A straight drive from rest to rest at about 1 m/s; returns its sequence."""
        self.sequence += 1
        message = drive(self.clock, start, end)
        message.agent = self.name
        message.sequence = self.sequence
        message.state = state
        for field, value in changes.items():
            setattr(message, field, value)
        self.proposals.publish(message)
        self.clock.settle()
        return self.sequence

    def settlement(self, sequence):
        self.clock.run_until(lambda: sequence in self.settlements, 10.0, "%d is settled" % sequence)
        return self.settlements[sequence]

    def await_committed(self, sequence):
        """The settlement may be heard before it: they are two topics."""
        self.clock.run_until(lambda: self.committed and self.committed[-1].sequence == sequence, 10.0, "%d is committed" % sequence)

    def set_down(self, place):
        """Puts the robot at rest somewhere, whatever it has promised: only an emergency may jump."""
        sequence = self.propose(place, place, Trajectory.EMERGENCY)
        self.settlement(sequence)
        self.await_committed(sequence)
        self.clock.run(LEAD_S + 0.2)  # until that has begun
        return sequence

    def bind(self, start, end):
        """Proposes until it is binding: a broadcaster that has just started refuses for a while."""
        for _ in range(20):
            sequence = self.propose(start, end)
            if self.settlement(sequence).result == Settlement.SETTLED:
                self.await_committed(sequence)
                return sequence
            self.clock.run(0.3)
        raise AssertionError("never binding: " + self.settlements[sequence].message)


def drive(clock, start, end):
    message = Trajectory()
    message.header.stamp = clock.stamp()
    message.header.frame_id = "map"
    message.footprint_radius = RADIUS_M
    message.deceleration, message.max_acceleration = 0.48, 0.8
    message.start = clock.stamp() + rospy.Duration(LEAD_S)
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


def changed(message, changes):
    message.header.frame_id = "map"
    for field, value in changes.items():
        setattr(message, field, value)
    return message


def passing_intent(**changes):
    return changed(PassingIntent(agent="race1", priority=-3, calls=True, radius=RADIUS_M, has_goal=True, goal=Point(3.0, -4.25, 0.0),
                                 leader="race0", number=5, turns=2), changes)


def passing_turn(path=((1.5, 2.0), (3.0, -4.25)), after=()):
    return PassingTurn(path=[Point(x, y, 0.0) for x, y in path], after=[PassingProgress(robot=robot, turns=turns) for robot, turns in after])


def passing_instruction(**changes):
    return changed(PassingInstruction(agent="race1", number=5, robot="race2", robots=["race1", "race2"], turns=9, alone_from=8, first=7,
                                      part=[passing_turn(after=[(0, 3)])]), changes)


class BroadcasterTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.clock = LockstepClock(NODES)
        cls.first, cls.second = Robot("race1", cls.clock), Robot("race2", cls.clock)
        cls.promises = rospy.Publisher("/fleet/promises", Trajectory, queue_size=10)
        cls.start()

    @classmethod
    def start(cls):
        """Until both broadcasters are there, and have listened for as long as they do at first."""
        cls.clock.start()
        wait_until(lambda: all(is_connected("/%s/%s" % node) for node in NODES), "the broadcasters are connected")
        cls.clock.run(LISTENING_S)

    def test_exactly_one_of_two_crossing_motions_is_binding(self):
        for trial in range(5):
            y = 100.0 * trial
            begun = {robot.name: len(robot.committed) for robot in (self.first, self.second)}
            self.first.set_down((-3.0, y))
            self.second.set_down((0.0, y - 3.0))
            one = self.first.propose((-3.0, y), (3.0, y))
            two = self.second.propose((0.0, y - 3.0), (0.0, y + 3.0))
            winner = self.first.settlement(one)
            loser = self.second.settlement(two)
            solved = [each.result == Settlement.SETTLED for each in (winner, loser)]
            self.assertEqual(sum(solved), 1, (winner.message, loser.message))
            # The second may have been settled before the first was proposed.
            robot, sequence = (self.second, two) if solved[1] else (self.first, one)
            robot.await_committed(sequence)
            if solved[1]:
                loser = winner
            self.assertEqual(loser.result, Settlement.REJECTED)
            self.assertIn(loser.refusal, (Settlement.PEER_PROMISE, Settlement.PEER_PROPOSAL))
            self.assertIn(loser.peer, ("race1", "race2"))
            self.assertGreater(loser.required, 2 * RADIUS_M)
            self.assertLess(loser.distance, loser.required)
            self.assertLess(math.hypot(loser.place.x, loser.place.y - y), 1.5)
            total = sum(len(robot.committed) - begun[robot.name] for robot in (self.first, self.second))
            self.assertEqual(total, 3)  # two set down, one driven

    def test_the_peer_is_told(self):
        sequence = self.first.set_down((50.0, 50.0))
        told = lambda: self.second.fleet and any(
            each.agent == "race1" and abs(each.phases[-1].x[-1] - 50.0) < 1e-6
            for each in self.second.fleet.trajectories)
        self.clock.run_until(told, 10.0, "the second one knows")
        self.assertFalse(any(each.agent == "race2" for each in self.second.fleet.trajectories))
        committed = self.first.committed[-1]
        self.assertEqual(committed.state, Trajectory.EMERGENCY)
        self.assertEqual(committed.sequence, sequence)
        self.assertEqual(committed.agent, "race1")

    def test_bad_messages_are_refused_and_counted(self):
        here = (70.0, 70.0)
        self.first.set_down(here)
        before = self.first.diagnosed_refusals()
        count = len(self.first.committed)
        for changes in ({"footprint_radius": -1.0}, {"footprint_radius": float("nan")}, {"deceleration": 0.0},
                        {"deceleration": float("inf")}, {"max_acceleration": float("nan")}, {"agent": "race2"},
                        {"phases": []}, {"state": Trajectory.PLANNED}, {"s": 2}):
            status = self.first.settlement(self.first.propose(here, (72.0, 70.0), **changes))
            self.assertEqual(status.result, Settlement.INVALID, status.message)
        status = self.first.settlement(self.first.propose(here, (84.0, 70.0)))
        self.assertEqual(status.result, Settlement.INVALID)
        self.assertIn("leads 14.0", status.message)
        status = self.first.settlement(self.first.propose((75.0, 70.0), (76.0, 70.0)))
        self.assertEqual((status.result, status.refusal), (Settlement.REJECTED, Settlement.DISCONTINUOUS), status.message)
        impostor = drive(self.clock, here, (72.0, 70.0))
        impostor.agent, impostor.epoch, impostor.sequence = "race1", 0, 1
        impostor.state = Trajectory.COMMITTED
        self.promises.publish(impostor)
        impostor.agent = "race3"
        impostor.phases[0].x = [70.0, float("nan")]
        self.promises.publish(impostor)
        self.clock.run_until(lambda: self.first.refused() >= before + 12, 10.0, lambda: "all are counted: %s" % self.first.diagnosis)
        self.assertEqual(self.first.refused(), before + 12)
        self.assertEqual(len(self.first.committed), count)

    def test_what_is_said_about_passing_reaches_the_others_in_the_own_name_only(self):
        before = self.first.diagnosed_refusals()
        for changes in ({"agent": "race2"}, {"agent": ""}, {"radius": float("nan")}, {"turns": 401}, {"leader": ""},
                        {"goal": Point(float("inf"), 0.0, 0.0)}):
            self.first.passing_intents.publish(passing_intent(**changes))
        for changes in ({"agent": "race2"}, {"number": 0}, {"robot": "race3"}, {"turns": 7}, {"turns": 401},
                        {"robots": ["robot%d" % i for i in range(32)] + ["race2"]}, {"part": [passing_turn(path=[(1.0, 2.0)])]},
                        {"part": [passing_turn(after=[(2, 1)])]}, {"part": [passing_turn(path=[(float("nan"), 0.0)] * 2)]}):
            self.first.passing_instructions.publish(passing_instruction(**changes))
        self.clock.run_until(lambda: self.first.refused() >= before + 15, 10.0, lambda: "all are counted: %s" % self.first.diagnosis)
        self.first.passing_intents.publish(passing_intent())
        self.first.passing_instructions.publish(passing_instruction())
        self.clock.run_until(lambda: self.second.intents and self.second.instructions, 10.0, "both are heard")
        intent, = self.second.intents
        self.assertEqual((intent.agent, intent.calls, intent.priority, intent.radius), ("race1", True, -3, RADIUS_M))
        self.assertEqual((intent.has_goal, intent.goal.x, intent.goal.y), (True, 3.0, -4.25))
        self.assertEqual((intent.leader, intent.number, intent.turns), ("race0", 5, 2))
        self.assertGreater(intent.epoch, 0)
        instruction, = self.second.instructions
        self.assertEqual((instruction.agent, instruction.number, instruction.robot), ("race1", 5, "race2"))
        self.assertEqual((instruction.robots, instruction.turns, instruction.alone_from, instruction.first), (["race1", "race2"], 9, 8, 7))
        turn, = instruction.part
        self.assertEqual([(place.x, place.y) for place in turn.path], [(1.5, 2.0), (3.0, -4.25)])
        self.assertEqual([(other.robot, other.turns) for other in turn.after], [(0, 3)])
        self.assertEqual(instruction.epoch, intent.epoch)
        self.assertFalse(self.first.intents or self.first.instructions)  # its own

    def test_a_killed_broadcaster_comes_back_with_a_new_epoch_and_what_is_driven(self):
        self.first.set_down((-17.0, -25.0))
        self.second.set_down((-20.0, -20.0))
        self.second.bind((-20.0, -20.0), (-15.0, -20.0))
        driven = self.second.committed[-1]
        epoch = driven.epoch
        end("/race2/trajectory_broadcaster", signal.SIGTERM)
        self.start()
        resumed = self.second.committed[-1]
        self.assertEqual((resumed.epoch, resumed.sequence), (epoch + 1, driven.sequence))
        self.assertAlmostEqual(resumed.phases[-1].x[-1], -15.0, delta=1e-3)
        across = self.first.settlement(self.first.propose((-17.0, -25.0), (-15.0, -20.0)))
        self.assertEqual((across.refusal, across.peer), (Settlement.PEER_PROMISE, "race2"), across.message)
        self.second.set_down((-20.0, -30.0))
        self.second.bind((-20.0, -30.0), (-15.0, -30.0))
        self.assertEqual(self.second.committed[-1].epoch, epoch + 1)
        heard = lambda: any(each.agent == "race2" and each.epoch == epoch + 1
                            for each in self.first.fleet.trajectories)
        self.clock.run_until(heard, 10.0, "the first one knows")

    def test_a_settlement_says_which_proposal(self):
        here = (-60.0, 60.0)
        self.first.set_down(here)
        replaced = self.first.propose(here, (-58.0, 60.0))
        dropped = self.first.propose(here, (-57.0, 60.0))
        stop = self.first.propose(here, here, Trajectory.EMERGENCY)
        for sequence, result, refusal in ((replaced, Settlement.REJECTED, Settlement.REPLACED),
                                          (dropped, Settlement.REJECTED, Settlement.EMERGENCY),
                                          (stop, Settlement.SETTLED, Settlement.NONE)):
            settlement = self.first.settlement(sequence)
            self.assertEqual((settlement.result, settlement.refusal), (result, refusal), settlement.message)
            self.assertEqual(settlement.epoch, self.first.committed[-1].epoch)

    def test_a_breach_is_told(self):
        self.first.set_down((80.0, -80.0))
        self.second.set_down((-20.0, -30.0))
        self.first.breaches.clear()
        self.second.set_down((80.4, -80.0))
        self.clock.run_until(lambda: self.first.breaches, 10.0, "the breach is told")
        breach = self.first.breaches[0]
        self.assertEqual((breach.peer, breach.sequence), ("race2", self.first.sequence))
        self.assertAlmostEqual(breach.distance, 0.4, delta=0.01)
        self.second.set_down((-20.0, -30.0))

    def test_when_the_leases_cease_the_peers_hear_the_stop(self):
        start, end = (30.0, -60.0), (38.0, -60.0)
        self.first.set_down(start)
        driven = self.first.bind(start, end)
        self.clock.run(LEAD_S + 2.0)  # on its way
        self.assertEqual(self.first.committed[-1].sequence, driven)
        self.first.lease_s = SHORT_LEASE_S
        self.clock.step()
        self.first.renews = False
        try:
            self.first.await_committed(driven + 1)
        finally:
            self.first.renews, self.first.lease_s = True, LEASE_S
        stop = self.first.committed[-1]
        self.assertEqual(stop.state, Trajectory.EMERGENCY)
        self.assertAlmostEqual((stop.start - self.first.leased_until).to_sec(), 0.0, delta=1e-5)
        x = stop.phases[-1].x
        self.assertGreater(x[0], start[0] + 0.5)
        self.assertLess(x[-1] - x[0], 2.5)
        self.assertLess(x[-1], end[0] - 1.0)
        heard = lambda: any(each.agent == "race1" and abs(each.phases[-1].x[-1] - x[-1]) < 1e-4
                            for each in self.second.fleet.trajectories)
        self.clock.run_until(heard, 10.0, "the stop is heard")
        # What was proposed before the stop was known is void; numbers go on after it.
        del self.first.settlements[driven + 1]
        late = self.first.settlement(self.first.propose((x[-1], end[1]), end))
        self.assertEqual((late.sequence, late.result), (driven + 1, Settlement.INVALID))
        self.first.bind((x[-1], end[1]), end)


if __name__ == "__main__":
    rospy.init_node("broadcaster_test", disable_rostime=True)
    rostest.rosrun("mocha_ugv", "broadcaster_test", BroadcasterTest, sys.argv)
