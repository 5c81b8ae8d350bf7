"""Signals and routines as services of `rapidgen_interfaces`.

The package's messages are imported here only; `node` creates what `services` returns.
"""

from collections.abc import Callable, Coroutine, Sequence
from typing import Any, TypeAlias

from rapidgen.client.pose import Pose
from rapidgen.client.program import Argument, Left, Target
from rapidgen.ros.operator_services import OperatorServices, ToolAndLoad
from rapidgen.ros.robot_link import RobotLink

try:  # ros/rapidgen_interfaces, in the user's workspace or not.
    from rapidgen_interfaces.msg import Value
    from rapidgen_interfaces.srv import (
        Acknowledge,
        CallRoutine,
        ReadDialog,
        ReadSignal,
        ReadSymbol,
        ReadTool,
        SetSpeedRatio,
        WriteSignal,
        WriteSymbol,
        WriteTool,
    )
except ImportError:
    Value = CallRoutine = ReadSignal = WriteSignal = None
    ReadSymbol = SetSpeedRatio = WriteSymbol = None
    Acknowledge = ReadDialog = ReadTool = WriteTool = None

Message: TypeAlias = Any
"""Untyped object that ROS generates or passes."""
ARE_THERE = Value is not None
"""True if there are any."""
MISSING = "no services for signals and routines: rapidgen_interfaces is not in this workspace"
"""Log text if they are missing."""
Serve = Callable[[Message, Message], Coroutine[object, None, None]]
"""Executes a request on the link's loop and fills its response.

Raises RobotError, ValueError.
"""


def services(link: RobotLink) -> tuple[tuple[Message, str, Serve], ...]:
    """Return service type, name and handler.

    Empty if the package is not installed.
    """
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


def operator_services(operator: OperatorServices) -> tuple[tuple[Message, str, Serve], ...]:
    """Return the same for those of the operator that have messages of their own."""
    if not ARE_THERE:
        return ()

    async def set_speed_ratio(request: Message, response: Message) -> None:
        response.percent = await operator.set_speed_ratio(request.percent)

    async def read_symbol(request: Message, response: Message) -> None:
        response.value = await operator.read_symbol(request.path)

    async def write_symbol(request: Message, response: Message) -> None:
        response.value = await operator.write_symbol(request.path, request.value)

    async def read_signal(request: Message, response: Message) -> None:
        response.value = await operator.read_signal(request.name)

    async def write_signal(request: Message, response: Message) -> None:
        response.value = await operator.write_signal(request.name, request.value)

    async def read_dialog(_: Message, response: Message) -> None:
        if found := await operator.read_dialog():
            response.dialog, response.instruction = found.stack, found.kind
            given = found.parameters.items()
            response.parameters = [f"{name}:={value}" for name, value in given]

    async def acknowledge(request: Message, _: Message) -> None:
        await operator.acknowledge(request.dialog, request.answer)

    def put(read: ToolAndLoad, response: Message) -> None:
        response.tool, response.tool_data = read.tool, read.tool_data
        response.load, response.load_data = read.load, read.load_data

    async def read_tool(request: Message, response: Message) -> None:
        put(await operator.read_tool(request.unit), response)

    async def write_tool(request: Message, response: Message) -> None:
        given = (request.tool_data, request.load_data)
        put(await operator.write_tool(request.unit, *given), response)

    return (
        (ReadDialog, "read_dialog", read_dialog),
        (Acknowledge, "acknowledge", acknowledge),
        (ReadTool, "read_tool", read_tool),
        (WriteTool, "write_tool", write_tool),
        (ReadSignal, "read_controller_signal", read_signal),
        (WriteSignal, "write_controller_signal", write_signal),
        (SetSpeedRatio, "set_speed_ratio", set_speed_ratio),
        (ReadSymbol, "read_rapid_symbol", read_symbol),
        (WriteSymbol, "write_rapid_symbol", write_symbol),
    )


def _argument(value: Message) -> Argument:
    """Parse an argument. Raises ValueError for an unknown type."""
    if value.type == Value.NUM:
        return float(value.number)
    if value.type == Value.BOOL:
        return bool(value.boolean)
    if value.type == Value.STRING:
        return str(value.text)
    if value.type == Value.ROBTARGET:
        at, turned = value.pose.position, value.pose.orientation
        return Pose((at.x, at.y, at.z), (turned.w, turned.x, turned.y, turned.z))
    if value.type == Value.JOINTTARGET:
        return [float(joint) for joint in value.joints]
    raise ValueError(f"{value.type} is not a type of rapidgen_interfaces/Value")


def _values(results: Sequence[Left]) -> list[Message]:
    values = []
    for result in results:
        if isinstance(result, bool):
            values.append(Value(type=Value.BOOL, boolean=result))
        elif isinstance(result, str):
            values.append(Value(type=Value.STRING, text=result))
        elif isinstance(result, Target):
            (x, y, z), (w, a, b, c) = result.pose
            value = Value(type=Value.ROBTARGET)
            at, turned = value.pose.position, value.pose.orientation
            at.x, at.y, at.z = x, y, z
            turned.w, turned.x, turned.y, turned.z = w, a, b, c
            values.append(value)
        elif isinstance(result, tuple):
            values.append(Value(type=Value.JOINTTARGET, joints=list(result)))
        else:
            values.append(Value(type=Value.NUM, number=float(result)))
    return values
