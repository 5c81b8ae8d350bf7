"""Errors of a robot, divided by what the caller can do about them::

    RobotError                    is a DiagnosticError; carries .messages and .states
    ├── InvalidTarget             no such configuration, group or address: correct the argument
    ├── ConnectionFailed          no answer: start the driver, or correct the address; nothing sent
    ├── ConnectionLost            the connection broke: look at the robot, connect again
    ├── RobotTimeout              the connection is open, and the answer did not arrive in time
    ├── StopFailed                a STOP was not confirmed: USE THE EMERGENCY STOP
    ├── ProtocolError             the peer does not speak simple_message
    ├── IncompatibleDriver        another version or joint map: build and deploy again
    ├── NotReady                  motors, mode, e-stop, or an active motion: fix this, try again
    ├── NotSupported              this driver lacks the feature: build another one, or do without
    ├── RoutineFailed             a called routine has raised an error: `number`
    ├── RequestRefused            a pause, a speed or a signal was refused; nothing else changed
    ├── InvalidTrajectory         correct the trajectory; nothing was sent
    ├── TargetRejected                a target of EGM was not sent: correct it, or wait
    ├── InvalidProgram            correct the program; nothing was sent
    ├── TrajectoryRefused         the controller refused the order; the robot did not move
    └── MotionError               the robot moved, and did not reach the end
        ├── MotionStopped         by a stop() or cancel()
        └── MotionFailed          by the controller

`.messages` are the last messages received, oldest first, as (time, text); `.states` the last
states. Time is that of the client's clock, s.
"""

import os
import socket
from collections.abc import Iterable
from dataclasses import replace
from typing import TYPE_CHECKING, Any

from rapidgen._compat import Self
from rapidgen._simulator_registry import running
from rapidgen.diagnostics import Diagnostic, DiagnosticError, error

if TYPE_CHECKING:
    from rapidgen.client.core.state import Event, State
    from rapidgen.wire.simple_message.spec import Reason


class RobotError(DiagnosticError):
    """An error of a robot; see this module's docstring for the kinds."""

    exit_code = 1

    def __init__(
        self,
        diagnostics: Diagnostic | Iterable[Diagnostic],
        *,
        messages: Iterable[tuple[float, str]] = (),
        states: "Iterable[State]" = (),
        exit_code: int = 1,
    ) -> None:
        super().__init__(diagnostics, exit_code=exit_code)
        self.messages = tuple(messages)
        self.states = tuple(states)

    @classmethod
    def because(cls, code: str, message: str, help: str = "", *notes: str, **report: Any) -> Self:  # noqa: ANN401
        """Create an error with a finding without a place in a text.

        `report` holds the arguments of its type.
        """
        return cls(fault(code, message, help, *notes), **report)

    def amend(self, message: str, help: str) -> None:
        """Append later information to the message, and replace the help."""
        first, *others = self.diagnostics
        changed = replace(first, message=f"{first.message}; {message}", help=help)
        # Made again from the diagnostics.
        self.__dict__.pop("__notes__", None)
        DiagnosticError.__init__(self, [changed, *others], exit_code=self.exit_code)


class InvalidTarget(RobotError):
    """The connection target is not a valid configuration, group or address."""


class ConnectionFailed(RobotError):
    """No connection could be made; nothing was sent."""


class ConnectionLost(RobotError):
    """A connection broke. The robot may still move: look at it."""


class RobotTimeout(RobotError):
    """The connection is open, and the awaited answer did not arrive in time."""


class StopFailed(RobotError):
    """A STOP was not confirmed. Use the emergency stop."""


class ProtocolError(RobotError):
    """The peer sent bytes that no driver of this protocol sends."""


class IncompatibleDriver(RobotError):
    """The driver has another version or joint map."""


class NotReady(RobotError):
    """The robot cannot move now: motors, mode, emergency stop, active motion."""


class NotSupported(RobotError):
    """The driver on the controller, or the configuration, lacks a feature."""


class _ControllerReason(RobotError):
    """Reason that the controller gives.

    `reason` is None if it gave none; `point` counts from 0 (-1 none) and `joint` from 1 (0 none);
    `reached` is the number of points, None if unknown.
    """

    def __init__(
        self,
        diagnostic: Diagnostic,
        *,
        reason: "Reason | None" = None,
        reached: int | None = None,
        point: int = -1,
        joint: int = 0,
        messages: Iterable[tuple[float, str]] = (),
        states: "Iterable[State]" = (),
    ) -> None:
        super().__init__(diagnostic, messages=messages, states=states)
        self.reason = reason
        self.reached = reached
        self.point = point
        self.joint = joint


class RequestRefused(_ControllerReason):
    """The controller refused a request on the control port, for `reason`."""


class RoutineFailed(RobotError):
    """A called procedure has raised an error.

    `number` is its ERRNO, `name` its name in RAPID or the program (empty if it has none). If an
    error without a handler has stopped the robot's program, `event` is the controller's, with the
    place.
    """

    def __init__(
        self,
        diagnostic: Diagnostic,
        *,
        number: int,
        name: str = "",
        event: "Event | None" = None,
        messages: Iterable[tuple[float, str]] = (),
        states: "Iterable[State]" = (),
    ) -> None:
        super().__init__(diagnostic, messages=messages, states=states)
        self.number = number
        self.name = name
        self.event = event


class InvalidTrajectory(RobotError):
    """Every fault of a trajectory, found before a byte of it was sent."""


class TargetRejected(RobotError):
    """A target of externally guided motion that was not sent."""


class InvalidProgram(RobotError):
    """Every fault of a program, found before a byte of it was sent."""


class TrajectoryRefused(_ControllerReason):
    """The controller refused the whole trajectory or program.

    It gives `reason`, `point` and `joint`; the robot did not move.
    """


class MotionError(_ControllerReason):
    """The robot began to move and did not reach the end.

    `reached`, `reason`, `point` and `joint` describe the fault.
    """


class MotionStopped(MotionError):
    """Stopped on request."""


class MotionFailed(MotionError):
    """The controller ended the motion, or the robot is at rest elsewhere."""


def fault(code: str, message: str, help: str = "", *notes: str) -> Diagnostic:
    """An error without a place in a text."""
    return error(code, None, message, help, notes=notes)


def not_reached(where: str, raised: OSError, timeout: float) -> ConnectionFailed:
    """Return the error of a failed connection to `where` (host and port).

    `timeout` in s is the time waited in case of a TimeoutError.
    """
    if isinstance(raised, TimeoutError):
        message = f"no answer from {where} within {timeout:g} s"
        help = "is the controller on, and this machine in its network?"
    else:
        message = f"cannot connect to {where}: {os_reason(raised)}"
        help = "is the driver's task running? `rapidgen sim` starts a virtual controller"
    if isinstance(raised, socket.gaierror):
        help = (
            "correct the name of the host; for a configuration give its file, with the suffix .yaml"
        )
    # Without an address this machine was meant, and its simulator may use other ports.
    notes = _simulators() if where.startswith("127.0.0.1 ") else ()
    return ConnectionFailed.because("RG601", message, help, *notes)


def _simulators() -> tuple[str, ...]:
    return tuple(
        f"a simulator of {one.name} runs at {' and '.join(one.addresses.values())}: `--to sim`"
        for one in running()[0]
        if one.addresses
    )


def os_reason(raised: OSError) -> str:
    """Return the operating system's reason, starting in lower case."""
    if isinstance(raised, socket.gaierror):
        return "no host has this name"
    return (os.strerror(raised.errno) if raised.errno else str(raised)).lower()
