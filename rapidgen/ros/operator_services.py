"""What an operator does at the pendant, over Robot Web Services: motors, program, speed, data.

Services that can make a robot move are refused unless the node's parameter `operate` names them:
otherwise anyone who can call a service would have the operator's authority. Stopping the
program and switching the motors off need no permission. In manual mode the controller itself
refuses all of them.
"""

import asyncio
import math
import re
from collections.abc import AsyncIterator, Callable, Coroutine, Sequence
from contextlib import asynccontextmanager
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from rapidgen._extras import named
from rapidgen.client.errors import (
    ConnectionLost,
    NotReady,
    RequestRefused,
    RobotError,
    RobotTimeout,
)

if TYPE_CHECKING:
    from rapidgen.client.rws import AsyncController
    from rapidgen.client.rws.model import Dialog, LogEvent
    from rapidgen.client.rws.values import RapidValue

LOG_PERIOD = 1.0
"""s between two readings of the event log; a controller answers 20 requests in a second."""
GUARDED = frozenset(
    {
        "motors_on",
        "start_program",
        "pp_to_main",
        "set_speed_ratio",
        "write_rapid_symbol",
        "write_controller_signal",
        "acknowledge",
        "write_tool",
    }
)
"""Services that need permission, because the robot may move or move otherwise afterwards."""
_PREDEFINED = {
    "tool0": "[TRUE,[[0,0,0],[1,0,0,0]],[0.001,[0,0,0.001],[1,0,0,0],0,0,0]]",
    "load0": "[0.001,[0,0,0.001],[1,0,0,0],0,0,0]",
}
"""Tool and load of every controller, as the RAPID reference manual defines them (3HAC050917)."""
_NOT_ON = {
    "emergencystop": "an emergency stop is active: release it",
    "emergencystopreset": "the emergency stop was not reset: switch the motors on at the panel",
    "guardstop": "a guard stop is active: close the guard",
    "sysfail": "system failure: restart the controller",
}
"""By state of the panel: why motors cannot be switched on."""


@dataclass(frozen=True, slots=True)
class OperatorAccess:
    """Where and as whom the node uses Robot Web Services, and what it may do there."""

    address: str
    user: str
    password: str = field(repr=False)
    fingerprint: str
    allowed: frozenset[str]


@dataclass(frozen=True, slots=True)
class ToolAndLoad:
    """Tool and load of a unit: TASK/MODULE/NAME (or tool0, load0), and RAPID literals."""

    tool: str
    tool_data: str
    load: str
    load_data: str


class OperatorServices:
    """Requests of services, on the links' loop; the connection is made when it is needed."""

    def __init__(self, access: OperatorAccess, is_moving: Callable[[], bool]) -> None:
        """`is_moving` tells whether a goal is executed."""
        self._access = access
        self._is_moving = is_moving
        self._controller: AsyncController | None = None
        self._one_at_a_time = asyncio.Lock()

    async def motors_on(self) -> None:
        """Switch the motors on. Raises RobotError."""
        async with self._permitted("motors_on") as controller:
            panel = await controller.panel()
            if reason := _NOT_ON.get(panel.state):
                raise NotReady.because("RG621", f"the motors stay off: {reason}")
            await controller.motors(True)

    async def motors_off(self) -> None:
        """Switch the motors off; a motion is stopped. Raises RobotError."""
        async with self._connected() as controller:
            await controller.motors(False)

    async def start_program(self) -> None:
        """Start the program from its pointer. Raises RobotError."""
        async with self._permitted("start_program") as controller:
            panel = await controller.panel()
            if panel.state != "motoron":
                raise NotReady.because(
                    "RG621", f"the motors are not on ({panel.state})", "call motors_on first"
                )
            await controller.start()

    async def stop_program(self) -> None:
        """Stop the program. It is no safety function. Raises RobotError."""
        async with self._connected() as controller:
            await controller.stop()

    async def pp_to_main(self) -> None:
        """Set all program pointers to main. Raises RobotError."""
        async with self._permitted("pp_to_main") as controller:
            if (await controller.execution()).running:
                raise NotReady.because(
                    "RG621", "the program is executing", "call stop_program first"
                )
            await controller.pp_to_main()

    async def set_speed_ratio(self, percent: float) -> float:
        """Set the controller's speed override, 0 to 100 %; return it as read afterwards.

        Unlike the node's parameter `speed` it stays. Raises RobotError, ValueError.
        """
        if not 0 <= percent <= 100 or percent != int(percent):
            raise ValueError(f"a speed ratio is a whole number from 0 to 100 %, not {percent:g}")
        async with self._permitted("set_speed_ratio") as controller:
            await controller.set_speed(int(percent))
            return float((await controller.panel()).speed)

    async def read_symbol(self, path: str) -> str:
        """Return a value as RAPID text; `path` is TASK/MODULE/NAME. Raises RobotError."""
        async with self._connected() as controller:
            return await controller.symbol_text(_checked(path))

    async def write_symbol(self, path: str, value: str) -> str:
        """Set a PERS or VAR from RAPID text and return it as read afterwards.

        Refused while a goal is executed: data of the driver and of the program steer motions.
        Raises RobotError, ValueError (no RAPID literal).
        """
        from rapidgen.client.rws import values

        literal = values.read(value)
        async with self._permitted("write_rapid_symbol") as controller:
            self._need_rest()
            await controller.set_symbol(_checked(path), literal)
            return await controller.symbol_text(path)

    async def read_dialog(self) -> "Dialog | None":
        """Return the open dialog of a program; None if there is none. Raises RobotError."""
        async with self._connected() as controller:
            return await controller.dialog()

    async def acknowledge(self, stack: str, answer: str) -> None:
        """Answer the dialog that `read_dialog` returned, with a RAPID literal.

        Refused if another dialog is open by now, and while a goal is executed: the program goes
        on, and may move the robot. Raises RobotError, ValueError (no RAPID literal).
        """
        from rapidgen.client.rws import values

        literal = values.read(answer)
        async with self._permitted("acknowledge") as controller:
            self._need_rest()
            if (mode := (await controller.panel()).mode) != "AUTO":
                reason = f"the operating mode is {mode}: a person may be at the robot"
                raise NotReady.because("RG621", reason, "answer at the pendant")
            found = await controller.dialog()
            if found is None or found.stack != stack:
                reason = f"{found.kind} is open at {found.stack}" if found else "no dialog is open"
                raise NotReady.because("RG621", reason, "call read_dialog again")
            await controller.answer_dialog(literal)

    async def read_tool(self, unit: str) -> ToolAndLoad:
        """Return the tool and load that are chosen for a mechanical unit. Raises RobotError."""
        async with self._connected() as controller:
            return await _read_tool(controller, unit)

    async def write_tool(self, unit: str, tool_data: str, load_data: str) -> ToolAndLoad:
        """Set data of a unit's tool and load from RAPID text; an empty text leaves them.

        Both are checked before the first is set. Refused for tool0 and load0, and while a goal is
        executed. Raises RobotError, ValueError (no tooldata, no loaddata).
        """
        from rapidgen.client.rws import values

        given: list[RapidValue | None] = [None, None]
        if tool_data:
            given[0] = _checked_tool(values.read(tool_data), tool_data)
        if load_data:
            given[1] = _checked_load(values.read(load_data), load_data)
        async with self._permitted("write_tool") as controller:
            self._need_rest()
            found = await _read_tool(controller, unit)
            chosen = [
                (p, v)
                for p, v in zip((found.tool, found.load), given, strict=True)
                if v is not None
            ]
            for path, _ in chosen:
                if path in _PREDEFINED:
                    reason = f"{path} is predefined and cannot be set"
                    raise NotReady.because("RG621", reason, "choose another one at the pendant")
            for path, value in chosen:
                await controller.set_symbol(path, value)
            return await _read_tool(controller, unit)

    async def read_signal(self, name: str) -> float:
        """Return a signal of the controller, by its name or as NETWORK/DEVICE/NAME.

        Raises RobotError.
        """
        async with self._connected() as controller:
            return float((await controller.signal(name)).value)

    async def write_signal(self, name: str, value: float) -> float:
        """Set a signal of the controller and return it as read afterwards.

        Signals can start motions of other machines and of programs. Raises RobotError, ValueError.
        """
        if not math.isfinite(value):
            raise ValueError(f"a signal has a finite value, not {value}")
        async with self._permitted("write_controller_signal") as controller:
            return float((await controller.set_signal(name, value)).value)

    async def follow_log(
        self, publish: "Callable[[LogEvent], None]", note: Callable[[str], None]
    ) -> None:
        """Publish each new event of the controller's log until cancelled."""
        newest, reported = -1, ""
        while True:
            try:
                async with self._connected() as controller:
                    events = await controller.log(after=max(newest, 0), count=50)
                if newest >= 0:
                    for event in events:
                        publish(event)
                newest = max([newest, 0, *(event.number for event in events)])
                reported = ""
            except RobotError as error:
                if str(error) != reported:
                    reported = str(error)
                    note(f"no event log: {error}")
            await asyncio.sleep(LOG_PERIOD)

    async def close(self) -> None:
        """Log out."""
        async with self._one_at_a_time:
            await self._disconnect()

    def _need_rest(self) -> None:
        if self._is_moving():
            raise NotReady.because("RG621", "a goal is executed", "wait for its end")

    @asynccontextmanager
    async def _permitted(self, name: str) -> "AsyncIterator[AsyncController]":
        if name not in self._access.allowed:
            raise RequestRefused.because(
                "RG625",
                f"{name} is not permitted here",
                f"-p operate:=['{name}'] permits it to every node that can call these services",
            )
        async with self._connected() as controller:
            yield controller

    @asynccontextmanager
    async def _connected(self) -> "AsyncIterator[AsyncController]":
        async with self._one_at_a_time:
            if self._controller is None:
                with named():
                    from rapidgen.client.rws import AsyncController

                access = self._access
                made = AsyncController(
                    access.address,
                    user=access.user,
                    password=access.password,
                    fingerprint=access.fingerprint,
                )
                try:
                    await made.connect()
                except RobotError:
                    await made.close()
                    raise
                self._controller = made
            try:
                yield self._controller
            except (ConnectionLost, RobotTimeout):
                await self._disconnect()
                raise

    async def _disconnect(self) -> None:
        controller, self._controller = self._controller, None
        if controller is not None:
            await controller.close()


Act = Callable[[], Coroutine[object, None, None]]


def triggers(operator: OperatorServices) -> tuple[tuple[str, Act], ...]:
    """Services of type std_srvs/Trigger: names and what they do."""
    return (
        ("motors_on", operator.motors_on),
        ("motors_off", operator.motors_off),
        ("start_program", operator.start_program),
        ("stop_program", operator.stop_program),
        ("pp_to_main", operator.pp_to_main),
    )


def _checked(path: str) -> str:
    if len(path.split("/")) != 3 or not all(path.split("/")):
        raise NotReady.because("RG621", f"'{path}' is not TASK/MODULE/NAME", "T_ROB1/main/count")
    return path


async def _read_tool(controller: "AsyncController", unit: str) -> ToolAndLoad:
    if not unit.isidentifier():
        raise NotReady.because("RG621", f"'{unit}' is no mechanical unit", "for example ROB_1")
    chosen = await controller.mechanical_unit(unit)
    read = []
    for name, kind in ((chosen.tool, "tooldata"), (chosen.load, "loaddata")):
        if name.lower() in _PREDEFINED:
            read += [name.lower(), _PREDEFINED[name.lower()]]
            continue
        found = await controller.symbols(chosen.task, kind="per", pattern=f"^{re.escape(name)}$")
        paths = [one.path for one in found if one.type.rpartition("/")[2].lower() == kind]
        if len(paths) != 1:
            reason = f"{chosen.task} has {len(paths)} persistent {kind} called '{name}'"
            raise NotReady.because("RG621", reason, "use the services of RAPID symbols")
        read += [paths[0], await controller.symbol_text(paths[0])]
    return ToolAndLoad(*read)


def _checked_tool(value: "RapidValue", text: str) -> "RapidValue":
    """Return tooldata. Raises ValueError if it has another form, or its load is refused."""
    match value:
        case (bool(), ((_, _, _) as place, (_, _, _, _) as turned), load):
            if _numbers(*place) and _is_unit(turned):
                _checked_load(load, text)
                return value
    raise ValueError(f"no tooldata: {text[:60]!r}")


def _checked_load(value: "RapidValue", text: str) -> "RapidValue":
    """Return loaddata. Raises ValueError: it has another form, or a mass of 0 kg or less."""
    match value:
        case (mass, (_, _, _) as centre, (_, _, _, _) as axes, x, y, z):
            weights = _numbers(mass, x, y, z)
            if weights and _numbers(*centre) and _is_unit(axes):
                if weights[0] > 0 and min(weights) >= 0:
                    return value
                raise ValueError(f"a mass is above 0 kg, an inertia not below 0: {text[:60]!r}")
    raise ValueError(f"no loaddata: {text[:60]!r}")


def _is_unit(parts: "Sequence[RapidValue]") -> bool:
    # The tolerance is that of a quaternion typed with four decimals.
    return abs(math.hypot(*_numbers(*parts)) - 1) <= 1e-3


def _numbers(*parts: "RapidValue") -> list[float]:
    """Return the parts, or nothing if one of them is no finite number."""
    found = [float(p) for p in parts if isinstance(p, int | float) and math.isfinite(p)]
    return found if len(found) == len(parts) and not any(isinstance(p, bool) for p in parts) else []
