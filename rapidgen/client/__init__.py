"""The paired Python client: sync and async."""

import logging
from typing import TYPE_CHECKING

from rapidgen.client.aio import AsyncExecution, AsyncProgramRun, AsyncRobot, AsyncStream
from rapidgen.client.cell import AsyncCell, Cell
from rapidgen.client.core.motion import Result
from rapidgen.client.core.robot import Timeouts
from rapidgen.client.core.state import Driver, Event, Feedback, Progress, State, Status
from rapidgen.client.errors import (
    ConnectionFailed,
    ConnectionLost,
    IncompatibleDriver,
    InvalidProgram,
    InvalidTarget,
    InvalidTrajectory,
    MotionError,
    MotionFailed,
    MotionStopped,
    NotReady,
    NotSupported,
    ProtocolError,
    RequestRefused,
    RobotError,
    RobotTimeout,
    RoutineFailed,
    StopFailed,
    TrajectoryRefused,
)
from rapidgen.client.pose import Pose, from_degrees
from rapidgen.client.program import (
    Program,
    Speed,
    Target,
    Trigger,
    UserTool,
    UserWorkObject,
    Zone,
    pulse,
)
from rapidgen.client.sync import Execution, ProgramRun, Robot, Stream
from rapidgen.client.trajectory import Trajectory, Waypoint
from rapidgen.wire.simple_message.spec import EventType, Reason, TrajectoryState

if TYPE_CHECKING:
    from rapidgen.client.rws import AsyncController, Controller

# Log records go nowhere unless the application configures a handler.
logging.getLogger("rapidgen").addHandler(logging.NullHandler())

__all__ = [
    "AsyncCell",
    "AsyncController",
    "AsyncExecution",
    "AsyncProgramRun",
    "AsyncRobot",
    "AsyncStream",
    "Cell",
    "ConnectionFailed",
    "ConnectionLost",
    "Controller",
    "Driver",
    "Event",
    "EventType",
    "Execution",
    "Feedback",
    "IncompatibleDriver",
    "InvalidProgram",
    "InvalidTarget",
    "InvalidTrajectory",
    "MotionError",
    "MotionFailed",
    "MotionStopped",
    "NotReady",
    "NotSupported",
    "Pose",
    "Program",
    "ProgramRun",
    "Progress",
    "ProtocolError",
    "Reason",
    "RequestRefused",
    "Result",
    "Robot",
    "RobotError",
    "RobotTimeout",
    "RoutineFailed",
    "Speed",
    "State",
    "Status",
    "StopFailed",
    "Stream",
    "Target",
    "Timeouts",
    "Trajectory",
    "TrajectoryRefused",
    "TrajectoryState",
    "Trigger",
    "UserTool",
    "UserWorkObject",
    "Waypoint",
    "Zone",
    "from_degrees",
    "pulse",
]


def __getattr__(name: str) -> object:
    # Clients of a driver alone must not pay for HTTP and websockets.
    if name in ("AsyncController", "Controller"):
        from rapidgen.client import rws

        return getattr(rws, name)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
