import sys
import time
from importlib.util import find_spec
from pathlib import Path

import pytest

sys.path[:0] = [str(Path(__file__).parent), str(Path(__file__).parents[1] / "client")]

IS_REAL = find_spec("rclpy") is not None
# `make ros-tests` runs these with the real rclpy; the stand-in is for Pythons that have none.
if not IS_REAL and (Path(__file__).parents[2] / "build" / "ros").exists():
    collect_ignore = ["test_node.py", "test_operator_node.py", "test_own_services.py"]

WITH_ROS = (
    "rapidgen.ros.node",
    "rapidgen.ros.operator_interface",
    "rapidgen.ros.user_services",
)
"""What looks at what is sourced when it is imported."""


@pytest.fixture
def sourced(monkeypatch):
    """A stand-in of ROS 2 in place of every package of it."""
    if IS_REAL:
        pytest.skip("only for the stand-in")
    import standin

    standin.install(monkeypatch)
    monkeypatch.setattr(standin.LifecycleNode, "clock", staticmethod(time.monotonic_ns))
    for name in WITH_ROS:
        sys.modules.pop(name, None)
    yield
    for name in WITH_ROS:
        sys.modules.pop(name, None)


@pytest.fixture(scope="session")
def _rclpy():
    import rclpy
    import real

    real.start()
    yield
    rclpy.try_shutdown()


@pytest.fixture
def driver_type(request):
    """The type of a node that a test can ask."""
    if IS_REAL:
        request.getfixturevalue("_rclpy")
        from real import Driver

        return Driver
    request.getfixturevalue("sourced")
    from rapidgen.ros.node import RobotNode

    return RobotNode
