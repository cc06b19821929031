"""For the tests here: skipped, with the reason, where this machine cannot play several hosts; and how they wait."""
import os
import sys
import unittest

import netns

sys.path.append(os.path.join(os.path.dirname(os.path.dirname(os.path.abspath(__file__))), "rostest"))
from waiting import wait_until  # noqa: E402 (the path comes first)


def run_tests():
    reason = netns.why_not()
    if reason:
        print("skipped, as this machine cannot play several hosts:", reason)
        sys.exit(netns.SKIPPED)
    unittest.main(verbosity=2, warnings="ignore")  # rospy's
