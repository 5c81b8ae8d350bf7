"""The operator of the robot: questions with known answers, on a terminal or from a file."""

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Protocol

from rapidgen._reading import read_foreign
from rapidgen.config.yaml_tree import MAX_BYTES, data_of
from rapidgen.diagnostics import DiagnosticError, refusal, suggest

YES = "yes"
NO = "no"
AGAIN = "again"
KINDS = (
    "area", "pendant", "marks", "base", "move", "direction", "stop", "cable", "emergency",
    "reset", "restart", "return",
)  # fmt: skip
"""First parts of all questions' names."""


@dataclass(frozen=True, slots=True)
class Question:
    """A question; its name is a kind, or `KIND.JOINT`. `choices` are the accepted answers."""

    name: str
    text: str
    choices: tuple[str, ...] = (YES, NO)


class Operator(Protocol):
    """Answers questions. `assumed` is True if no person stands behind the answers."""

    assumed: bool

    def announce(self, text: str) -> None:
        """Show what comes next; called before everything that moves."""

    async def ask(self, question: Question) -> str:
        """Return one of the question's choices. Raises DiagnosticError RG689 without an answer."""


class PreparedAnswers:
    """Answers by name (`direction.joint_2`) or by kind (`direction`).

    With `otherwise`, it answers all other questions that have it as a choice.
    """

    def __init__(self, answers: Mapping[str, str], *, otherwise: str = "") -> None:
        self._answers = dict(answers)
        self._otherwise = otherwise
        self.assumed = True
        self.announced: list[str] = []

    def announce(self, text: str) -> None:
        """Keep the text."""
        self.announced.append(text)

    async def ask(self, question: Question) -> str:
        """Return the prepared answer. Raises DiagnosticError RG689."""
        self.announced.append(question.text)
        kind = question.name.partition(".")[0]
        answer = self._answers.get(question.name, self._answers.get(kind, self._otherwise))
        if answer not in question.choices:
            given = f"'{answer}'" if answer else "none"
            raise refusal(
                "RG689",
                None,
                f"the question '{question.name}' has no usable answer: {given}",
                f"answer one of {', '.join(question.choices)}",
                exit_code=2,
            )
        return answer


def read_answers(path: Path) -> PreparedAnswers:
    """Read answers from YAML: a mapping from questions to texts. Raises DiagnosticError RG689."""
    try:
        content = data_of(read_foreign(path, MAX_BYTES), str(path))
    except OSError as fault:
        raise _unusable(path, fault.strerror or str(fault)) from fault
    except DiagnosticError as fault:
        raise _unusable(path, fault.diagnostics[0].message) from fault
    if not isinstance(content, Mapping):
        raise _unusable(path, "it is no mapping from questions to answers")
    answers = {}
    for key, value in content.items():
        # YAML reads a bare yes or no as a truth value.
        answer = {True: YES, False: NO}.get(value, value) if isinstance(value, bool) else value
        kind = str(key).partition(".")[0]
        if kind not in KINDS:
            raise _unusable(path, f"unknown question '{key}'", suggest(kind, KINDS))
        if not isinstance(answer, str):
            raise _unusable(path, f"the answer to '{key}' is no text")
        answers[str(key)] = answer
    return PreparedAnswers(answers)


def _unusable(path: Path, reason: str, help: str = "") -> DiagnosticError:
    return refusal(
        "RG689",
        None,
        f"the answers in {path} cannot be used: {reason}",
        help or f"the questions are {', '.join(KINDS)}, each alone or as KIND.JOINT",
    )
