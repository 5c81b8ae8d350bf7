"""The paired Python client: sync and async."""

from rapidgen.client.aio import AsyncExecution, AsyncRobot
from rapidgen.client.cell import AsyncCell, Cell
from rapidgen.client.core import Timeouts
from rapidgen.client.errors import (
    ConnectionFailed,
    ConnectionLost,
    IncompatibleDriver,
    InvalidTrajectory,
    MotionError,
    MotionFailed,
    MotionStopped,
    NotReady,
    ProtocolError,
    RobotError,
    RobotTimeout,
    StopFailed,
    TrajectoryRefused,
)
from rapidgen.client.run import Result
from rapidgen.client.state import Driver, Progress, State, Status
from rapidgen.client.sync import Execution, Robot
from rapidgen.client.trajectory import Trajectory

__all__ = [
    "AsyncCell",
    "AsyncExecution",
    "AsyncRobot",
    "Cell",
    "ConnectionFailed",
    "ConnectionLost",
    "Driver",
    "Execution",
    "IncompatibleDriver",
    "InvalidTrajectory",
    "MotionError",
    "MotionFailed",
    "MotionStopped",
    "NotReady",
    "Progress",
    "ProtocolError",
    "Result",
    "Robot",
    "RobotError",
    "RobotTimeout",
    "State",
    "Status",
    "StopFailed",
    "Timeouts",
    "Trajectory",
    "TrajectoryRefused",
]
