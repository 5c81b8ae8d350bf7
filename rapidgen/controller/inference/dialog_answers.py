"""Dialogs in a guessed cell: nobody is there, so each is answered as by one who tries every choice.

The first time a question is asked its default is taken, or the first choice; when the same task
asks it again the next one, and so in turn: a menu is walked through. What no default and no choice
tells is answered by small numbers.
"""

from collections import Counter
from collections.abc import Sequence
from functools import partial
from typing import Final

from rapidgen.machine.operator import Operator, Question
from rapidgen.machine.scheduler import S, Scheduler

Said = tuple[str, float | str]
"""A guessed input, or a dialog with its text, and what it became."""
_THOUGHT: Final = 0.5
"""Seconds that a question stays on the screen."""
_NUMBERS: Final = (*(str(n) for n in range(1, 11)), "0", "100")


class DialogResponder:
    """Answers the dialogs of one controller; `message` grows by (dialog and text, answer)."""

    def __init__(self, operator: Operator, scheduler: Scheduler, message: list[Said]) -> None:
        self._operator = operator
        self._scheduler = scheduler
        self._said = message
        self._seen: set[int] = set()
        self._turns: Counter[tuple[object, ...]] = Counter()
        operator.attach()
        operator.asked.add(self._look)

    def _look(self) -> None:
        for question in self._operator.questions:
            if question.number not in self._seen:
                self._seen.add(question.number)
                self._scheduler.after(round(_THOUGHT * S), partial(self._give, question))

    def _give(self, question: Question) -> None:
        if question not in self._operator.questions:
            return
        key = (question.task, question.dialog, question.text, question.choices)
        answers = _answers(question)
        for _ in answers:
            answer = answers[self._turns[key] % len(answers)]
            self._turns[key] += 1
            try:
                self._operator.answer(question.number, answer)
            except ValueError:
                continue
            requested = question.text.replace("\n", " ").strip()
            self._said.append((f"{question.dialog} '{requested}'", answer))
            return


def _answers(question: Question) -> Sequence[str]:
    """What may be answered, in turn."""
    given = question.choices or _NUMBERS
    first = (question.proposed,) if question.proposed else ()
    return (*first, *(choice for choice in given if choice != question.proposed))
