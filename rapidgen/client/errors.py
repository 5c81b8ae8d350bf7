"""What can go wrong, split by what the caller can do about it.

    RobotError                    is a DiagnosticError; carries .messages and .states
    ├── InvalidTarget             no such configuration, group or address: mend what was given
    ├── ConnectionFailed          nobody answers: start it, mend the address; nothing was sent
    ├── ConnectionLost            the link broke: look at the robot, connect again
    ├── RobotTimeout              the link stands and the answer did not come in time
    ├── StopFailed                a STOP was not confirmed: USE THE EMERGENCY STOP
    ├── ProtocolError             the peer does not speak simple_message
    ├── IncompatibleDriver        another version or joint map: build and deploy again
    ├── NotReady                  motors, mode, e-stop, or a motion under way: mend that, try again
    ├── NotSupported              this driver cannot do that: build another one, or do without
    ├── RoutineFailed             a routine that was called has raised an error: `number`
    ├── RequestRefused            a pause, a speed or a signal was refused; nothing else changed
    ├── InvalidTrajectory         mend the trajectory; nothing was sent
    ├── InvalidProgram            mend the program; nothing was sent
    ├── TrajectoryRefused         the controller said no; nothing moved
    └── MotionError               the robot moved, and not to the end
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
    """Something about a robot went wrong; see this module's head for the kinds."""

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
        """One with a finding that has no place in a text; `report` is what its kind takes."""
        return cls(fault(code, message, help, *notes), **report)

    def amend(self, message: str, help: str) -> None:
        """Add to the message what has become of the robot since, and replace the help."""
        first, *others = self.diagnostics
        changed = replace(first, message=f"{first.message}; {message}", help=help)
        # Made again from the diagnostics.
        self.__dict__.pop("__notes__", None)
        DiagnosticError.__init__(self, [changed, *others], exit_code=self.exit_code)


class InvalidTarget(RobotError):
    """What was given to connect to is no sound configuration, no group of it, or no address."""


class ConnectionFailed(RobotError):
    """No connection could be made; nothing was sent."""


class ConnectionLost(RobotError):
    """A connection broke. The robot may still move: look at it."""


class RobotTimeout(RobotError):
    """The connection stands, and what was waited for did not come in time."""


class StopFailed(RobotError):
    """A STOP was not confirmed. Use the emergency stop."""


class ProtocolError(RobotError):
    """The peer sent bytes that no driver of this protocol sends."""


class IncompatibleDriver(RobotError):
    """The driver on the controller is of another version or has another joint map."""


class NotReady(RobotError):
    """The robot cannot move now: motors, mode, emergency stop, or a motion under way."""


class NotSupported(RobotError):
    """The driver on the controller, or the configuration, does not have what was asked for."""


class _ControllerReason(RobotError):
    """What the controller says of it: `reason`, None when it gave none; `point` from 0 (-1 none)
    and `joint` from 1 (0 none) at fault; `reached` points, None where it does not say."""

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
    """The controller did not do what was asked over the control port; `reason` says why."""


class RoutineFailed(RobotError):
    """A procedure that was called has raised an error: `number` is its ERRNO, `name` what RAPID or
    the program calls it, empty: nothing does. Or an error that it did not handle has stopped the
    program of the robot: `event` is the controller's, with the place."""

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


class InvalidProgram(RobotError):
    """Every fault of a program, found before a byte of it was sent."""


class TrajectoryRefused(_ControllerReason):
    """The controller refused the whole trajectory or program, for `reason`, at `point` and `joint`;
    nothing moved."""


class MotionError(_ControllerReason):
    """The robot began to move and did not reach the end: `reached`, and `reason`, `point` and
    `joint` of the fault."""


class MotionStopped(MotionError):
    """Stopped on request."""


class MotionFailed(MotionError):
    """Ended by the controller, or the robot stands where it should not."""


def fault(code: str, message: str, help: str = "", *notes: str) -> Diagnostic:
    """An error without a place in a text."""
    return error(code, None, message, help, notes=notes)


def not_reached(where: str, raised: OSError, timeout: float) -> ConnectionFailed:
    """Nobody answers at `where` (host and port); `timeout` in s is what a TimeoutError waited."""
    if isinstance(raised, TimeoutError):
        message = f"no answer from {where} within {timeout:g} s"
        help = "is the controller on, and this machine in its network?"
    else:
        message = f"cannot connect to {where}: {os_reason(raised)}"
        help = "is the driver's task running? `rapidgen sim` starts a virtual controller"
    if isinstance(raised, socket.gaierror):
        help = "mend the name of the host; for a configuration give its file, with the suffix .yaml"
    # Who named no address meant this machine, and what runs there may have other ports.
    notes = _simulators() if where.startswith("127.0.0.1 ") else ()
    return ConnectionFailed.because("RG601", message, help, *notes)


def _simulators() -> tuple[str, ...]:
    return tuple(
        f"a simulator of {one.name} runs at {' and '.join(one.addresses.values())}: `--to sim`"
        for one in running()[0]
        if one.addresses
    )


def os_reason(raised: OSError) -> str:
    """What the operating system says, in its own words and small letters."""
    if isinstance(raised, socket.gaierror):
        return "no host has this name"
    return (os.strerror(raised.errno) if raised.errno else str(raised)).lower()
