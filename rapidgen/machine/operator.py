"""Operator: FlexPendant screen and dialogs that wait for an answer.

A script (`DescriptionChoices`), the control socket or a test answers dialogs. Without any of them
there is no FlexPendant, and every dialog raises ERR_TP_NO_CLIENT.
"""

from collections import deque
from collections.abc import Callable, Iterable
from dataclasses import dataclass, field
from itertools import count
from pathlib import Path

from rapidgen._reading import read_foreign
from rapidgen.config.yaml_tree import MAX_BYTES, data_of
from rapidgen.diagnostics import DiagnosticError, Span, error
from rapidgen.machine.scheduler import S, Scheduler, WaitSet

ROW = 40
ROWS = 20
"""Characters of a row, and rows, of the operator window [S4 TPWrite]; rows are our choice."""


@dataclass(frozen=True, slots=True)
class Answer:
    """A scripted answer; empty conditions match every dialog.

    `task` and `dialog` are complete names (`TPReadNum`), `text` is a part of the question; `after`
    is the response time of the operator in s.
    """

    value: str
    task: str = ""
    dialog: str = ""
    text: str = ""
    after: float = 0.0

    def fits(self, question: "Question") -> bool:
        """Return True if this answers the question."""
        return (
            self.task.lower() in ("", question.task.lower())
            and self.dialog.lower() in ("", question.dialog.lower())
            and self.text.lower() in question.text.lower()
        )


@dataclass(slots=True, eq=False)
class Question:
    """A dialog; `check` returns an answer's value or raises ValueError."""

    number: int
    task: str
    dialog: str
    text: str
    choices: tuple[str, ...]
    check: Callable[[str], object]
    proposed: str = ""
    """Suggested answer of the program: a default, an initial value."""
    answer: object = None
    answered: bool = False
    refused: str = ""
    """The script's answer that did not fit, and why."""
    changed: WaitSet = field(default_factory=WaitSet)


class Operator:
    """Screen and dialogs of one controller."""

    def __init__(self, scheduler: Scheduler, answers: Iterable[Answer] | None = None) -> None:
        self._scheduler = scheduler
        self._script = None if answers is None else list(answers)
        self._numbers = count(1)
        self._listeners: list[Callable[[str, str], None]] = []
        self._attached = 0
        self.rows: deque[str] = deque(maxlen=ROWS)
        """Rows of the screen, oldest first."""
        self.questions: list[Question] = []
        """Dialogs that wait, in the order in which they came."""
        self.asked = WaitSet()
        """Notified when a question comes or goes."""

    @property
    def present(self) -> bool:
        """True if an operator or a script can answer."""
        return self._script is not None or self._attached > 0

    def attach(self) -> Callable[[], None]:
        """Register a source of answers; the result ends that."""
        self._attached += 1

        def detach() -> None:
            self._attached -= 1

        return detach

    # -- screen -----------------------------------------------------------------------------

    def show(self, text: str) -> None:
        """Show a text on new rows of 40 characters."""
        for start in range(0, max(len(text), 1), ROW):
            self.rows.append(text[start : start + ROW])

    def write(self, task: str, text: str) -> None:
        """Show a program's text; listeners receive the complete text."""
        self.show(text)
        for listener in tuple(self._listeners):
            listener(task, text)

    def erase(self) -> None:
        """Clear the screen."""
        self.rows.clear()

    def subscribe(self, listener: Callable[[str, str], None]) -> Callable[[], None]:
        """Call `listener(task, text)` for each text; the result ends that."""
        self._listeners.append(listener)
        return lambda: self._listeners.remove(listener)

    # -- dialogs ----------------------------------------------------------------------------

    def ask(
        self,
        task: str,
        dialog: str,
        text: str,
        choices: Iterable[str],
        check: Callable[[str], object],
        proposed: str = "",
    ) -> Question:
        """Show a dialog; the caller must `withdraw` it."""
        number = next(self._numbers)
        question = Question(number, task, dialog, text, tuple(choices), check, proposed)
        self.questions.append(question)
        for line in text.split("\n"):
            self.show(line)
        self.asked.notify()
        script = self._script or []
        answer = next((a for a in script if a.fits(question)), None)
        if answer is not None:
            script.remove(answer)
            self._scheduler.after(
                round(answer.after * S), lambda: self._scripted(question, answer.value)
            )
        return question

    def waits(self, task: str) -> str:
        """Return the dialog that a task waits for, or an empty text."""
        for question in self.questions:
            if question.task == task:
                requested = question.text.replace("\n", " ")
                reason = f"; {question.refused}" if question.refused else ""
                return f"{question.dialog} waits for an answer to '{requested}'{reason}"
        return ""

    def withdraw(self, question: Question) -> None:
        """Remove a dialog from the screen."""
        if question in self.questions:
            self.questions.remove(question)
            self.asked.notify()

    def answer(self, number: int, value: str) -> None:
        """Answer a question.

        KeyError: unknown question; ValueError: invalid answer.
        """
        for question in self.questions:
            if question.number == number:
                question.answer = question.check(value)
                question.answered = True
                question.changed.notify()
                return
        raise KeyError(number)

    def _scripted(self, question: Question, value: str) -> None:
        if question in self.questions:
            try:
                self.answer(question.number, value)
            except ValueError as fault:
                question.refused = f"answer '{value}' refused: {fault}"
                self.show(question.refused)


def read_answers(path: Path) -> list[Answer]:
    """Read a YAML list of values or of mappings with `answer`.

    Raises DiagnosticError RG420.
    """
    try:
        entries = data_of(read_foreign(path, MAX_BYTES), str(path))
    except OSError as fault:
        raise _unreadable(path, fault.strerror or str(fault)) from fault
    except DiagnosticError as fault:
        result = fault.diagnostics[0]
        raise _unreadable(path, result.message, result.span) from fault
    if not isinstance(entries, list):
        raise _unreadable(path, "it holds no list")
    return [_entry(path, i, entry) for i, entry in enumerate(entries, 1)]


def _entry(path: Path, number: int, entry: object) -> Answer:
    if not isinstance(entry, dict):
        return Answer(_text(entry))
    unknown = set(entry) - {"answer", "task", "dialog", "text", "after"}
    if unknown or "answer" not in entry:
        wrong = f"unknown key '{sorted(map(str, unknown))[0]}'" if unknown else "no 'answer'"
        raise _unreadable(path, f"entry {number}: {wrong}")
    after = entry.get("after", 0.0)
    if not isinstance(after, int | float) or after < 0:
        raise _unreadable(path, f"entry {number}: 'after' is no time")
    task, dialog, text = (_text(entry.get(key, "")) for key in ("task", "dialog", "text"))
    return Answer(_text(entry["answer"]), task, dialog, text, float(after))


def _text(value: object) -> str:
    if isinstance(value, bool):
        return "Yes" if value else "No"
    return str(value)


def _unreadable(path: Path, reason: str, span: Span | None = None) -> DiagnosticError:
    return DiagnosticError(
        error(
            "RG420",
            span or Span(str(path), 1, 1),
            f"the script of answers cannot be used: {reason}",
            "a YAML list: `- 2`, or `- {dialog: TPReadNum, text: parts, answer: 2}`",
        )
    )
