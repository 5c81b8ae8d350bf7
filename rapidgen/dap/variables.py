"""Scopes and variables of a paused controller.

A client gets numbers for frames and for values with parts, which are valid until the program
continues. A number stands for a function that returns the parts and one that sets a part.
"""

import math
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass

from rapidgen._json import Members
from rapidgen.controller.controller import VirtualController
from rapidgen.controller.debugger import Debugger, DisplayedValue, NotPaused
from rapidgen.dap.client import RequestRefused
from rapidgen.machine.io import Signal
from rapidgen.motion.group import MotionGroup
from rapidgen.runtime.errors import error_name
from rapidgen.runtime.task.task import Task

_MOST = 2000
"""Values of one list; clients request arrays in pages."""


@dataclass(frozen=True, slots=True)
class Parts:
    """Values with one number: `read(start, count)` lists them, `write(name, value)` sets one."""

    read: Callable[[int, int], Iterable[Members]]
    write: Callable[[str, str], Members] | None = None


class Variables:
    """Frames, scopes and values of one pause."""

    def __init__(self, controller: VirtualController, debugger: Debugger) -> None:
        self._controller = controller
        self._debugger = debugger
        self._frames: list[tuple[str, int]] = []
        self._parts: list[Parts] = []

    def clear(self) -> None:
        """Forget all numbers: the program continues."""
        self._frames.clear()
        self._parts.clear()

    # -- numbers ---------------------------------------------------------------------------------

    def number_of_frame(self, task: str, level: int) -> int:
        """Return the number of a frame, outermost level 0."""
        if (task, level) not in self._frames:
            self._frames.append((task, level))
        return self._frames.index((task, level)) + 1

    def frame(self, number: int) -> tuple[str, int]:
        """Return task and level of a frame. RequestRefused: unknown number."""
        if not 0 < number <= len(self._frames):
            raise RequestRefused("this frame does not exist any more")
        return self._frames[number - 1]

    def _number(self, parts: Parts) -> int:
        self._parts.append(parts)
        return len(self._parts)

    def parts(self, number: int) -> Parts:
        """Return the values with a number. RequestRefused: unknown number."""
        if not 0 < number <= len(self._parts):
            raise RequestRefused("these values do not exist any more")
        return self._parts[number - 1]

    def read(self, number: int, start: int, count: int) -> list[Members]:
        """Return some of the values with a number."""
        count = min(count, _MOST) if count > 0 else _MOST
        return list(self.parts(number).read(max(0, start), count))

    def write(self, number: int, name: str, value: str) -> Members:
        """Set one of the values with a number; return it."""
        write = self.parts(number).write
        if write is None:
            raise RequestRefused(f"{name} cannot be changed")
        return write(name, value)

    # -- scopes ----------------------------------------------------------------------------------

    def scopes(self, number: int) -> list[Members]:
        """Return the scopes of a frame."""
        task, level = self.frame(number)
        frame = self._debugger.frame(task, level)
        node = frame.routine.node
        given = {p.name.lower() for p in node.parameters} if node is not None else set()
        owner = self._controller.rapid_tasks[task]

        def own(parameters: bool) -> Iterator[DisplayedValue]:
            for value in self._debugger.variables(task, level):
                if (value.name.lower() in given) == parameters:
                    yield value

        def scope(name: str, parts: Parts, hint: str = "", *, costs: bool = False) -> Members:
            result: Members = {
                "name": name,
                "variablesReference": self._number(parts),
                "expensive": costs,
            }
            return result | ({"presentationHint": hint} if hint else {})

        def data(values: Callable[[], Iterable[DisplayedValue]]) -> Parts:
            return Parts(
                lambda start, count: self._each(task, level, values(), start, count),
                lambda name, value: self.assign(task, level, name, value),
            )

        result = [scope("Parameters", data(lambda: own(True)), "arguments")] if given else []
        return [
            *result,
            scope("Locals", data(lambda: own(False)), "locals"),
            scope(
                f"Module {frame.module.name}",
                data(lambda: self._debugger.module_data(task, level)),
            ),
            scope(
                f"Task {task}",
                data(lambda: self._globals(task, level, shared=False)),
                "globals",
                costs=True,
            ),
            scope("Shared PERS", data(lambda: self._globals(task, level, shared=True)), costs=True),
            scope("System", Parts(lambda start, count: _page(self._system(owner), start, count))),
            scope("Signals", Parts(self._signals, self._set_signal), costs=True),
            scope("Robots", Parts(lambda start, count: _page(self._robots(), start, count)),
                  costs=True),
        ]  # fmt: skip

    def _globals(self, task: str, level: int, *, shared: bool) -> Iterator[DisplayedValue]:
        """Return global data of the other modules, or PERS that several tasks declare."""
        tasks = self._controller.rapid_tasks
        own = self._debugger.frame(task, level).module
        for module in tasks[task].program.modules.values():
            for key, node in module.declarations.items():
                everywhere = node.kind == "PERS" and not node.scope
                others = everywhere and any(
                    key in m.declarations and not m.declarations[key].scope
                    for other in tasks.values()
                    if other.name != task
                    for m in other.program.modules.values()
                )
                if shared != others or node.scope == "LOCAL" or module.installed:
                    continue
                if shared or module is not own:
                    yield self._value(task, level, node.name)

    def _value(self, task: str, level: int, name: str) -> DisplayedValue:
        try:
            return self._debugger.evaluate(task, name, level)
        except NotPaused as reason:
            return DisplayedValue(name, "", f"({reason})", settable=False)

    # -- RAPID values ----------------------------------------------------------------------------

    def shown(self, task: str, level: int, value: DisplayedValue) -> Members:
        """Return a value as a variable of the client."""
        result: Members = {
            "name": _last(value.name),
            "value": value.text,
            "type": value.type,
            "evaluateName": value.name,
            "variablesReference": 0,
        }
        if not value.settable:
            result["presentationHint"] = {"attributes": ["readOnly"]}
        if value.parts:
            expression = value.name
            prefix = expression + "." if not value.type.endswith("}") else expression
            parts = Parts(
                lambda start, count: self._parts_of(task, level, expression, start, count),
                lambda name, new: self.assign(task, level, _joined(prefix, name), new),
            )
            result["variablesReference"] = self._number(parts)
            kind = "indexedVariables" if value.type.endswith("}") else "namedVariables"
            result[kind] = value.parts
        return result

    def _each(
        self, task: str, level: int, values: Iterable[DisplayedValue], start: int, count: int
    ) -> Iterator[Members]:
        for i, value in enumerate(values):
            if i >= start + count:
                return
            if i >= start:
                yield self.shown(task, level, value)

    def _parts_of(
        self, task: str, level: int, expression: str, start: int, count: int
    ) -> Iterator[Members]:
        for value in self._debugger.parts(task, expression, level, start, count):
            yield self.shown(task, level, value)

    def assign(self, task: str, level: int, name: str, value: str) -> Members:
        """Set a datum, an element or a component; return its variable. NotPaused."""
        return self.shown(task, level, self._debugger.assign(task, name, value, level))

    # -- the controller --------------------------------------------------------------------------

    def _system(self, task: Task) -> list[Members]:
        controller = self._controller
        trap = " (in a trap)" if task.in_trap else ""
        return [
            _plain("ERRNO", error_name(task.errno) if task.errno else "0", "errnum"),
            _plain("INTNO", f"{task.intno}{trap}", "intnum"),
            _plain("state", task.state),
            _plain("time", f"{controller.now:.6f} s"),
            _plain("mode", controller.mode),
            _plain("motors", "on" if controller.motors_on else "off"),
            _plain("emergency stop", "pressed" if controller.e_stop else "released"),
        ]

    def _signals(self, start: int, count: int) -> Iterator[Members]:
        signals = list(self._controller.io.signals.values())
        yield from map(_signal, signals[start : start + count])

    def _set_signal(self, name: str, value: str) -> Members:
        signal = self._controller.io.get(name)
        if signal is None:
            raise RequestRefused(f"there is no signal {name}")
        try:
            self._controller.io.set(signal, float(value))
        except (ValueError, OverflowError) as error:
            raise RequestRefused(str(error)) from error
        return _signal(signal)

    def _robots(self) -> list[Members]:
        def parts(group: MotionGroup) -> Parts:
            return Parts(lambda start, count: _page(_position(group), start, count))

        result = []
        for group in self._controller.motion.groups.values():
            state = "standing" if group.is_standing else "moving"
            shown = _plain(group.name, f"{state}, override {group.override:.0%}")
            result.append(shown | {"variablesReference": self._number(parts(group))})
        return result


def _position(group: MotionGroup) -> list[Members]:
    """Return axis values (deg, mm) and the flange (mm) of a robot."""
    actual = group.positions()
    result = []
    for joint, value in zip(group.config.joints, actual, strict=True):
        unit = (
            f"{math.degrees(value):.3f} deg"
            if joint.kind == "revolute"
            else f"{value * 1e3:.3f} mm"
        )
        result.append(_plain(joint.axis, unit, joint.name))
    if group.kinematics is not None:
        (x, y, z), turned = group.kinematics.forward(actual)
        result.append(_plain("flange", f"[{x * 1e3:.2f},{y * 1e3:.2f},{z * 1e3:.2f}] mm", "pos"))
        orientation = ",".join(f"{part:.6f}" for part in turned)
        result.append(_plain("flange orientation", f"[{orientation}]", "orient"))
    return result


def _plain(name: str, value: str, type: str = "") -> Members:
    hint: Members = {"attributes": ["readOnly"]}
    return {
        "name": name,
        "value": value,
        "type": type,
        "variablesReference": 0,
        "presentationHint": hint,
    }


def _signal(signal: Signal) -> Members:
    return {
        "name": signal.name,
        "value": f"{signal.value:g}",
        "type": signal.spec.type,
        "variablesReference": 0,
    }


def _page(values: list[Members], start: int, count: int) -> list[Members]:
    return values[start : start + count]


def _last(name: str) -> str:
    """Return the last part of an expression: `x` of `p.trans.x`, `{2}` of `a{2}`."""
    if "{" in name and name.rfind("{") > name.rfind("."):
        inside = name[name.rfind("{") + 1 :].rstrip("}")
        return "{" + inside + "}"
    return name[name.rfind(".") + 1 :]


def _joined(prefix: str, name: str) -> str:
    """Return the expression of a part with the name that `_last` has given it."""
    if prefix.endswith("."):
        return prefix + name
    return (
        prefix.partition("{")[0] + name if prefix.count("{") > prefix.count("}") else prefix + name
    )
