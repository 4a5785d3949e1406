"""Waiting for a node, and what it tells of itself: the same with ROS 1 and ROS 2."""

import time

PATIENCE = 60.0  # [s]


def until(condition, what):
    """Waits for it; `what` says for what, and how far it is."""
    end = time.monotonic() + PATIENCE
    while not condition():
        assert time.monotonic() < end, f"waited {PATIENCE} s in vain: {what() if callable(what) else what}"
        time.sleep(0.02)


def diagnosed(peer, key):
    """A value of the last diagnostics."""
    return {pair.key: pair.value for pair in peer.heard["/diagnostics"][-1].status[0].values}[key]
