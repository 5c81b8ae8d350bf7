"""The console of a session: operator dialogs, commands, and names for completion.

A dialog of the program is an event `rapidgen/question` for clients that know it, and a text with
the command `:answer` for all others.
"""

import math
from collections.abc import Callable, Iterator

from rapidgen._json import Members
from rapidgen.controller.controller import VirtualController
from rapidgen.controller.debugger import Debugger, NotPaused
from rapidgen.dap.client import Client, RequestRefused
from rapidgen.machine.operator import Question

_COMMANDS = {
    ":answer": "answer the oldest dialog: `:answer OK`",
    ":questions": "list the dialogs that wait for an answer",
    ":run": "let time pass and pause again: `:run 0.5`, in s",
    ":start": "start the program, as the button of the FlexPendant",
    ":stop": "stop the program, as the button of the FlexPendant",
    ":time": "show the controller's time",
    ":help": "list these commands",
}
_LONGEST = 1e6
"""s of `:run`."""
_MOST = 200
"""Names of one completion."""


class Console:
    """Dialogs and commands of one controller."""

    def __init__(self, controller: VirtualController, debugger: Debugger, client: Client) -> None:
        self._controller = controller
        self._debugger = debugger
        self._client = client
        self._open: dict[int, Question] = {}

    # -- dialogs ---------------------------------------------------------------------------------

    def attach(self) -> Callable[[], None]:
        """Answer dialogs from now on; the result ends that."""
        operator = self._controller.operator
        detach = operator.attach()
        operator.asked.add(self._asked)
        self._asked()

        def end() -> None:
            detach()
            operator.asked.remove(self._asked)

        return end

    def _asked(self) -> None:
        now = {question.number: question for question in self._controller.operator.questions}
        for number in [number for number in self._open if number not in now]:
            del self._open[number]
            self._client.event("rapidgen/questionClosed", {"number": number})
        for number, question in now.items():
            if number not in self._open:
                self._open[number] = question
                self._client.event("rapidgen/question", _as_data(question))
                if not self._client.reads_questions:
                    self._client.output(_as_text(question), "important")

    def answer(self, number: int, value: str) -> None:
        """Answer a dialog. RequestRefused: it is closed, or the answer does not fit."""
        try:
            self._controller.operator.answer(number, value)
        except KeyError as error:
            raise RequestRefused("this dialog is closed") from error
        except ValueError as error:
            raise RequestRefused(str(error)) from error

    # -- commands --------------------------------------------------------------------------------

    def command(self, line: str) -> str:
        """Execute a command and return its output. RequestRefused, NotPaused."""
        name, _, value = line.partition(" ")
        value = value.strip()
        match name:
            case ":answer":
                if not self._open:
                    raise RequestRefused("no dialog waits for an answer")
                self.answer(next(iter(self._open)), value)
                return "answered"
            case ":questions":
                return "\n".join(map(_as_text, self._open.values())) or "no dialog is open"
            case ":run":
                return self._run(value)
            case ":start":
                if not self._controller.start_program():
                    raise RequestRefused("the start was rejected: the event log says why")
                return "started"
            case ":stop":
                self._controller.stop_program()
                return "stopped"
            case ":time":
                return f"{self._controller.now:.6f} s"
            case ":help":
                return "\n".join(f"{name:<12}{text}" for name, text in _COMMANDS.items())
        raise RequestRefused(f"there is no command {name}; `:help` lists them")

    def _run(self, value: str) -> str:
        try:
            seconds = float(value)
        except ValueError:
            seconds = math.nan
        if not 0 < seconds <= _LONGEST:
            raise RequestRefused(f"':run {value}' is not ':run SECONDS'")
        self._debugger.run_for(seconds)
        return f"running for {seconds:g} s"

    # -- completion ------------------------------------------------------------------------------

    def completions(self, typed: str) -> list[Members]:
        """Return the commands that begin with a text."""
        return [
            {"label": name, "detail": text, "start": 0, "length": len(typed)}
            for name, text in _COMMANDS.items()
            if name.startswith(typed)
        ]

    def names(self, task: str, level: int, typed: str) -> list[Members]:
        """Return the data, or the components of a record, that complete a text."""
        word = _word_at_end(typed)
        base, dot, part = word.rpartition(".")
        start = len(typed) - len(part)
        if dot:
            try:
                known = [v.name[len(base) + 1 :] for v in self._debugger.parts(task, base, level)]
            except NotPaused:
                known = []
        else:
            known = sorted(set(self._visible(task, level)), key=str.lower)
        fitting = [name for name in known if name.lower().startswith(part.lower())]
        return [
            {"label": name, "type": "variable", "start": start, "length": len(part)}
            for name in fitting[:_MOST]
        ]

    def _visible(self, task: str, level: int) -> Iterator[str]:
        frame = self._debugger.frame(task, level)
        yield from (value.name for value in self._debugger.variables(task, level))
        for module in self._controller.rapid_tasks[task].program.modules.values():
            for node in module.declarations.values():
                if module is frame.module or node.scope != "LOCAL":
                    yield node.name


def _word_at_end(typed: str) -> str:
    """Return the name, element or component in which a text ends: `p{1}.tr`."""
    i, depth = len(typed), 0
    while i > 0:
        letter = typed[i - 1]
        depth += (letter == "}") - (letter == "{")
        if depth < 0 or not (depth or letter.isalnum() or letter in "_.{"):
            break
        i -= 1
    return typed[i:]


def _as_data(question: Question) -> Members:
    return {
        "number": question.number,
        "task": question.task,
        "dialog": question.dialog,
        "text": question.text,
        "choices": [*question.choices],
        "proposed": question.proposed,
    }


def _as_text(question: Question) -> str:
    choices = f" [{', '.join(question.choices)}]" if question.choices else ""
    example = question.choices[0] if question.choices else question.proposed or "1"
    return (
        f"{question.task} asks ({question.dialog}): {question.text}{choices}\n"
        f"    answer with `:answer {example}`"
    )
