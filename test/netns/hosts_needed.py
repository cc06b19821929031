"""For the tests here: skipped, with the reason, where this machine cannot play several hosts."""
import os
import sys
import unittest

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../scripts"))
from mocha_scripts import netns  # noqa: E402


def run_tests():
    reason = netns.why_not()
    if reason:
        print("skipped, as this machine cannot play several hosts:", reason)
        sys.exit(netns.SKIPPED)
    unittest.main(verbosity=2, warnings="ignore")  # rospy's
