"""Signals and routines as services, where the package `rapidgen_interfaces` was built.

Its messages are imported here only; `node` creates what `services` gives.
"""

from collections.abc import Callable, Coroutine, Sequence
from typing import Any, TypeAlias

from rapidgen.client.program import Argument, Left, Target
from rapidgen.ros.robot_link import RobotLink

try:  # ros/rapidgen_interfaces, in the user's workspace or not.
    from rapidgen_interfaces.msg import Value
    from rapidgen_interfaces.srv import CallRoutine, ReadSignal, WriteSignal
except ImportError:
    Value = CallRoutine = ReadSignal = WriteSignal = None

Message: TypeAlias = Any
"""What ROS generates or hands over: it has no types."""
ARE_THERE = Value is not None
"""Whether there are any."""
MISSING = "no services for signals and routines: rapidgen_interfaces is not in this workspace"
"""What the log says without them."""
Serve = Callable[[Message, Message], Coroutine[object, None, None]]
"""Carries out a request on the link's loop, fills its response. Raises RobotError, ValueError."""


def services(link: RobotLink) -> tuple[tuple[Message, str, Serve], ...]:
    """Service type, name and what serves it; none where the package is not there."""
    if not ARE_THERE:
        return ()

    async def read_signal(request: Message, response: Message) -> None:
        response.value = await link.read_signal(request.name)

    async def write_signal(request: Message, response: Message) -> None:
        response.value = await link.write_signal(request.name, request.value)

    async def call_routine(request: Message, response: Message) -> None:
        given = [_argument(value) for value in request.arguments]
        response.results = _values(await link.call(request.name, given))

    return (
        (ReadSignal, "read_signal", read_signal),
        (WriteSignal, "write_signal", write_signal),
        (CallRoutine, "call_routine", call_routine),
    )


def _argument(value: Message) -> Argument:
    """Raises ValueError for a type that is none."""
    if value.type == Value.NUM:
        return float(value.number)
    if value.type == Value.BOOL:
        return bool(value.boolean)
    if value.type == Value.STRING:
        return str(value.text)
    if value.type == Value.ROBTARGET:
        at, turned = value.pose.position, value.pose.orientation
        return (at.x, at.y, at.z), (turned.w, turned.x, turned.y, turned.z)
    if value.type == Value.JOINTTARGET:
        return [float(joint) for joint in value.joints]
    raise ValueError(f"{value.type} is no type of rapidgen_interfaces/Value")


def _values(results: Sequence[Left]) -> list[Message]:
    told = []
    for result in results:
        if isinstance(result, bool):
            told.append(Value(type=Value.BOOL, boolean=result))
        elif isinstance(result, str):
            told.append(Value(type=Value.STRING, text=result))
        elif isinstance(result, Target):
            (x, y, z), (w, a, b, c) = result.pose
            value = Value(type=Value.ROBTARGET)
            at, turned = value.pose.position, value.pose.orientation
            at.x, at.y, at.z = x, y, z
            turned.w, turned.x, turned.y, turned.z = w, a, b, c
            told.append(value)
        elif isinstance(result, tuple):
            told.append(Value(type=Value.JOINTTARGET, joints=list(result)))
        else:
            told.append(Value(type=Value.NUM, number=float(result)))
    return told
