"""For the tests here: skipped, with the reason, where this machine cannot play several hosts."""
import sys
import unittest

import netns


def run_tests():
    reason = netns.why_not()
    if reason:
        print("skipped, as this machine cannot play several hosts:", reason)
        sys.exit(netns.SKIPPED)
    unittest.main(verbosity=2, warnings="ignore")  # rospy's
