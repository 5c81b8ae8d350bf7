import sys
import time
from pathlib import Path

import pytest

sys.path[:0] = [str(Path(__file__).parent), str(Path(__file__).parents[1] / "client")]

WITH_ROS = ("rapidgen.ros.node", "rapidgen.ros.user_services")
"""What looks at what is sourced when it is imported."""


@pytest.fixture
def sourced(monkeypatch):
    """A stand-in of ROS 2 in place of every package of it."""
    import standin

    standin.install(monkeypatch)
    monkeypatch.setattr(standin.LifecycleNode, "clock", staticmethod(time.monotonic_ns))
    for name in WITH_ROS:
        sys.modules.pop(name, None)
    yield
    for name in WITH_ROS:
        sys.modules.pop(name, None)


@pytest.fixture
def driver_type(sourced):
    from rapidgen.ros.node import RobotNode

    return RobotNode
