"""Waiting for what a test needs: on conditions, never for a fixed time."""

import time

POLL_S = 0.01


def wait_until(condition, what, timeout_s=60.0):
    """Returns as soon as the condition holds; the time-out only bounds a failure. `what` is words, or makes them then."""
    deadline = time.monotonic() + timeout_s
    while not condition():
        if time.monotonic() > deadline:
            raise AssertionError("not within %.0f s: %s" % (timeout_s, what() if callable(what) else what))
        time.sleep(POLL_S)
