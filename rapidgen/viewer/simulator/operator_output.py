"""Operator output of a virtual controller: log, window, dialogs."""

from collections.abc import Iterable, Mapping
from typing import Literal

from rapidgen.controller.runner import ControllerRunner
from rapidgen.machine.event_log import Event, EventType
from rapidgen.viewer.messages import (
    AnswerQuestion,
    Dialog,
    Dialogs,
    Log,
    LogEntry,
    Request,
    Screen,
    ToPage,
)
from rapidgen.viewer.provider import Handler, RequestRejected

_KINDS: dict[EventType, Literal["info", "warning", "error"]] = {
    EventType.INFO: "info",
    EventType.WARNING: "warning",
    EventType.ERROR: "error",
}


class OperatorOutputProvider:
    """Log, screen and dialogs."""

    def __init__(self, runner: ControllerRunner) -> None:
        self._controller = runner.controller
        # Any viewer can answer: dialogs wait for that.
        runner.controller.operator.attach()
        self._sequence = 0
        self._rows: tuple[str, ...] = ()
        self._waiting: tuple[Dialog, ...] = ()

    def whole(self) -> Iterable[ToPage]:
        """Return everything that is stored."""
        yield Log(entries=tuple(map(_entry, self._controller.log)))
        yield Screen(rows=tuple(self._controller.operator.rows))
        yield Dialogs(waiting=self._questions())

    def changes(self) -> Iterable[ToPage]:
        """Return new events, and screen and dialogs if they differ."""
        entries = self._controller.log.since(self._sequence)
        if entries:
            self._sequence = entries[-1].sequence
            yield Log(entries=tuple(map(_entry, entries)))
        rows = tuple(self._controller.operator.rows)
        if rows != self._rows:
            self._rows = rows
            yield Screen(rows=rows)
        waiting = self._questions()
        if waiting != self._waiting:
            self._waiting = waiting
            yield Dialogs(waiting=waiting)

    def handlers(self) -> Mapping[type, Handler]:
        """Handlers of answers to dialogs."""
        return {AnswerQuestion: self._answer}

    def _questions(self) -> tuple[Dialog, ...]:
        return tuple(
            Dialog(number=q.number, task=q.task, dialog=q.dialog, text=q.text, choices=q.choices)
            for q in self._controller.operator.questions
        )

    def _answer(self, request: Request) -> str:
        assert isinstance(request, AnswerQuestion)
        try:
            self._controller.operator.answer(request.number, request.value)
        except KeyError as error:
            raise RequestRejected("the dialog is closed") from error
        except ValueError as error:
            raise RequestRejected(str(error)) from error
        return ""


def _entry(event: Event) -> LogEntry:
    return LogEntry(
        sequence=event.sequence,
        time=event.time,
        code=event.code,
        kind=_KINDS[event.type],
        title=event.title,
        texts=event.texts,
        task=event.task,
    )
