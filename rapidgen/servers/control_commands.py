"""Commands of the control socket, one small function each."""

from collections.abc import Callable
from typing import get_args

from rapidgen._json import Json, Members
from rapidgen.controller.controller import VirtualController
from rapidgen.controller.operation import ACTIONS, OperatingMode
from rapidgen.controller.views import TaskView
from rapidgen.machine.event_log import Event
from rapidgen.machine.io import Signal
from rapidgen.machine.operator import Question
from rapidgen.motion.egm.sessions import EgmSession
from rapidgen.runtime.errors import RapidError
from rapidgen.runtime.task.pointer import CannotStep
from rapidgen.runtime.text import NotALiteral, parse_value, value_text
from rapidgen.runtime.values import Type
from rapidgen.servers.control_socket import Command, CommandError, Listener

_LARGEST = 1e300
_MODES: tuple[OperatingMode, ...] = get_args(OperatingMode)

READABLE = frozenset({"status", "signals", "get", "log", "screen", "questions", "where"})
"""Commands that only read; all others need the token."""


def commands(controller: VirtualController) -> dict[str, Command]:
    """Return the function of every request by its `do`."""
    remote = _Remote(controller)
    result: dict[str, Command] = {
        "status": remote.status,
        "mode": remote.mode,
        "override": remote.override,
        "signals": remote.signals,
        "set-signal": remote.set_signal,
        "get": remote.get,
        "set": remote.set,
        "log": remote.log,
        "screen": remote.screen,
        "questions": remote.questions,
        "answer": remote.answer,
        "where": remote.where,
        "step": remote.step,
    }
    for action in ACTIONS:
        result[action] = remote.action(action)
    return result


def subscribe(
    controller: VirtualController, listener: Listener, trusted: bool = True
) -> Callable[[], None]:
    """Send new log entries, screen texts and dialogs; return the end function.

    Dialogs wait for the client only if it is `trusted`: another one could not answer.
    """
    known: set[int] = set()

    def requested() -> None:
        for question in controller.operator.questions:
            if question.number not in known:
                known.add(question.number)
                listener({"event": "question", **_question(question)})

    ends = [
        controller.log.subscribe(lambda event: listener({"event": "log", **_event(event)})),
        controller.operator.subscribe(
            lambda task, text: listener({"event": "screen", "task": task, "text": text})
        ),
    ]
    if trusted:
        ends.append(controller.operator.attach())
    controller.operator.asked.add(requested)

    def end() -> None:
        for one in ends:
            one()
        controller.operator.asked.remove(requested)

    return end


class _Remote:
    """Commands executed on one controller, on its own thread."""

    def __init__(self, controller: VirtualController) -> None:
        self._controller = controller

    # -- state ------------------------------------------------------------------------------

    def status(self, _request: Members) -> Json:
        """Return modes, tasks, positions (rad, m in wire order)."""
        c = self._controller
        return {
            "name": c.system.name,
            "time": c.now,
            "mode": c.mode,
            "motors_on": c.motors_on,
            "e_stop": c.e_stop,
            "execution_error": c.execution_error,
            "failed": c.failed,
            "tasks": {t.name: t.state for t in c.tasks.values()},
            "groups": {
                name: {
                    "positions": list(group.positions()),
                    "standing": group.is_standing,
                    "override": group.override,
                }
                for name, group in c.motion.groups.items()
            },
            "egm": [_guidance(session) for session in c.egm.sessions],
            "listeners": {str(port): at[1] for port, at in c.network.listeners.items()},
        }

    def where(self, _request: Members) -> Json:
        """Return the position of each task."""
        return [*self._controller.where()]

    def action(self, name: str) -> Command:
        """Return the function of a request without arguments."""

        def perform(_request: Members) -> Json:
            self._controller.perform(name)
            return None

        return perform

    def mode(self, request: Members) -> Json:
        """Set the mode: `value` is auto, manual_reduced or manual_full."""
        expected = request.get("value")
        if expected not in _MODES:
            raise CommandError(f"value is one of {', '.join(_MODES)}")
        self._controller.set_mode(expected)
        return None

    def override(self, request: Members) -> Json:
        """Set the override: `value` in percent, of all groups or of `group`."""
        value = _number(request, "value")
        if not 0 <= value <= 100:
            raise CommandError("an override is 0 to 100 percent")
        groups = self._controller.motion.groups
        name = request.get("group")
        if name is not None and name not in groups:
            raise CommandError(f"there is no group {name!r}; there are {', '.join(groups)}")
        for group in groups.values() if name is None else [groups[name]]:
            group.override = value / 100
        return None

    # -- signals ----------------------------------------------------------------------------

    def signals(self, _request: Members) -> Json:
        """Return values by name."""
        return {s.name: s.value for s in self._controller.io.signals.values()}

    def set_signal(self, request: Members) -> Json:
        """Set a signal: `name`, `value`; inputs usually, outputs possible."""
        signal = self._signal(request)
        try:
            self._controller.io.set(signal, _number(request, "value"))
        except ValueError as error:
            raise CommandError(str(error)) from error
        return None

    def _signal(self, request: Members) -> Signal:
        name = _text(request, "name")
        signal = self._controller.io.get(name)
        if signal is None:
            raise CommandError(f"there is no signal '{name}'")
        return signal

    # -- variables --------------------------------------------------------------------------

    def get(self, request: Members) -> Json:
        """Return the value of `task`, `name` (`Module:datum`) as RAPID text."""
        task, name = self._datum(request)
        try:
            type_ = task.type_of(name)[0]
            _has_value(type_)
            return value_text(task[name], type_)
        except KeyError as error:
            raise CommandError(f"{task.name} has no data '{name}'") from error

    def set(self, request: Members) -> Json:
        """Set `task`, `name` to `value` as RAPID text."""
        task, name = self._datum(request)
        text = _text(request, "value")
        try:
            type_, dims = task.type_of(name)
            _has_value(type_)
            task[name] = parse_value(text, type_, dims)
        except KeyError as error:
            raise CommandError(f"{task.name} has no data '{name}' that can be set") from error
        except NotALiteral as error:
            raise CommandError(f"{text!r} is no literal of {name}'s type") from error
        except RapidError as error:
            raise CommandError(error.name) from error
        return None

    def step(self, request: Members) -> Json:
        """Execute one statement of `task`.

        `back` and `over` are true or false.
        """
        try:
            self._task(request).step(
                back=request.get("back") is True, over=request.get("over") is True
            )
        except CannotStep as error:
            raise CommandError(str(error)) from error
        return None

    def _datum(self, request: Members) -> tuple[TaskView, str]:
        name = _text(request, "name")
        return self._task(request), name

    def _task(self, request: Members) -> TaskView:
        expected = _text(request, "task")
        for task in self._controller.tasks.values():
            if task.name.lower() == expected.lower():
                return task
        raise CommandError(f"there is no task '{expected}'")

    # -- log, screen, dialogs ---------------------------------------------------------------

    def log(self, request: Members) -> Json:
        """Return events after sequence number `since`, oldest first."""
        since = request.get("since", 0)
        if not isinstance(since, int):
            raise CommandError("since is a sequence number")
        return [_event(event) for event in self._controller.log.since(since)]

    def screen(self, _request: Members) -> Json:
        """Return the rows of the operator window."""
        return list(self._controller.operator.rows)

    def questions(self, _request: Members) -> Json:
        """Return the open dialogs."""
        return [_question(question) for question in self._controller.operator.questions]

    def answer(self, request: Members) -> Json:
        """Answer a question: its `number` and a `value`.

        `value` is a choice's text or number, a number, or a text.
        """
        try:
            self._controller.operator.answer(
                int(_number(request, "number")), _text(request, "value")
            )
        except KeyError as error:
            raise CommandError("there is no such question") from error
        except ValueError as error:
            raise CommandError(str(error)) from error
        return None


def _has_value(type_: Type) -> None:
    if not type_.is_value:
        raise CommandError(f"{type_.name} is no value type")


def _guidance(session: EgmSession) -> Json:
    """Return a session of externally guided motion: rad, m and s; `age` is that of the answer."""
    latest = session.latest
    return {
        "task": session.task,
        "device": None if session.device is None else session.device.name,
        "guidance": session.guidance,
        "guided": session.guided,
        "streaming": session.streaming,
        "reference": None if latest.reference is None else list(latest.reference),
        "position": None if latest.position is None else list(latest.position),
        "age": latest.age,
    }


def _event(event: Event) -> dict[str, Json]:
    return {
        "sequence": event.sequence,
        "time": event.time,
        "code": event.code,
        "type": event.type.name.lower(),
        "title": event.title,
        "texts": list(event.texts),
        "task": event.task,
    }


def _question(question: Question) -> dict[str, Json]:
    return {
        "number": question.number,
        "task": question.task,
        "dialog": question.dialog,
        "text": question.text,
        "choices": list(question.choices),
    }


def _text(request: Members, key: str) -> str:
    value = request.get(key)
    if isinstance(value, int | float) and not isinstance(value, bool):
        return str(value)
    if not isinstance(value, str):
        raise CommandError(f"'{key}' is missing or no text")
    return value


def _number(request: Members, key: str) -> float:
    value = request.get(key)
    if isinstance(value, bool) or not isinstance(value, int | float):
        raise CommandError(f"'{key}' is missing or no number")
    if abs(value) > _LARGEST:
        raise CommandError(f"'{key}' is too large")
    return value
