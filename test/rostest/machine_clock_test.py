#!/usr/bin/python3
"""Without a simulated clock the simulator runs on that of the machine, at its rate, and waits for no node."""

import sys
import unittest

import rospy
import rostest
from nav_msgs.msg import Odometry

from waiting import wait_until

MESSAGES = 150
STEP_S = 0.02
LATE_S = 0.5  # on a busy machine


class MachineClockTest(unittest.TestCase):
    def test_runs_on_the_clock_of_the_machine(self):
        heard = []  # (stamp, when it came)
        subscriber = rospy.Subscriber("/ugv1/odom", Odometry,
                                      lambda odometry: heard.append((odometry.header.stamp.to_sec(), rospy.get_time())), tcp_nodelay=True)
        wait_until(lambda: len(heard) >= MESSAGES, "odometry", 30.0)
        subscriber.unregister()
        stamps = [stamp for stamp, _ in heard]
        for before, after in zip(stamps, stamps[1:]):
            self.assertAlmostEqual(after - before, STEP_S, places=6)
        for stamp, came in heard:
            self.assertGreater(came - stamp, -0.001)  # nothing from the future
            self.assertLess(came - stamp, LATE_S)


if __name__ == "__main__":
    rospy.init_node("machine_clock_test")
    rostest.rosrun("mocha_ugv", "machine_clock", MachineClockTest, sys.argv)
