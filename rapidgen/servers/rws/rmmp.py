"""Remote writing in manual mode: a session asks, and the pendant's user grants or denies it.

The question is a dialog of the virtual pendant (`RMMP`: Grant or Deny), answered as every other.
It stands for 10 s after the last poll, and what was granted ends with the session, the mode or a
cancel [RWS manual]. `exec` holds `modify`.
"""

from collections.abc import Callable
from typing import Literal

from rapidgen.controller.controller import VirtualController
from rapidgen.machine.operator import Question
from rapidgen.machine.scheduler import S
from rapidgen.servers.rws.sessions import Session

Privilege = Literal["modify", "exec"]
PATIENCE = 10.0
"""s that the pendant's user has, from the last poll on."""
_CHOICES = ("Grant", "Deny")


class ManualPrivilege:
    """Who may write from afar in manual mode, and who asks for it."""

    def __init__(self, now: Callable[[], VirtualController], clock: Callable[[], float]) -> None:
        """`now` gives the controller that runs, `clock` its time in s."""
        self._now = now
        self._clock = clock
        self.session: Session | None = None
        """Who asks, or has it."""
        self.privilege: Privilege = "modify"
        self.granted = False
        self._question: Question | None = None
        self._until = 0.0
        self._refused: dict[Session, str] = {}
        """What became of requests that ended without a grant."""

    def ask(self, session: Session, privilege: Privilege) -> bool:
        """Put the question on the pendant; False: somebody else asks, or has it."""
        if self.session not in (None, session):
            return False
        if self.session is session and self.granted and self._holds(privilege):
            return True
        self._end()
        self._refused.pop(session, None)
        self.session, self.privilege = session, privilege
        session.on_end.append(lambda: self.cancel(session))
        who = f"{session.alias or session.user} ({session.application or '?'})"
        text = f"{who} asks for remote {privilege} access in manual mode"
        controller = self._now()
        controller.operation.changed.add(self._look_at_mode)
        question = self._question = controller.operator.ask("", "RMMP", text, _CHOICES, _read)
        question.changed.add(lambda: self._answered(question))
        self.keep(session)
        self._watch()
        if question.answered:  # as soon as it was asked
            self._answered(question)
        return True

    def keep(self, session: Session) -> None:
        """A poll: the question stands for a while longer."""
        if session is self.session:
            self._until = self._clock() + PATIENCE

    def state(self, session: Session) -> str:
        """GRANTED or PENDING, else how a request ended: DENIED, TIMEOUT; NONE: there was none."""
        if session is self.session:
            return "GRANTED" if self.granted else "PENDING"
        return self._refused.get(session, "NONE")

    def has(self, session: Session, privilege: Privilege) -> bool:
        """Whether a session may do that in manual mode."""
        return session is self.session and self.granted and self._holds(privilege)

    def cancel(self, session: Session) -> None:
        """Ask no more, or give it back."""
        self._refused.pop(session, None)
        if session is self.session:
            self._end()

    def _holds(self, privilege: Privilege) -> bool:
        return self.privilege in (privilege, "exec")

    def _answered(self, question: Question) -> None:
        if question is not self._question or self.session is None:
            return
        if question.answer == "Grant":
            self._withdraw()
            self.granted = True
        else:
            self._refuse("DENIED")

    def _watch(self) -> None:
        left = max(self._until - self._clock(), 0.001)
        question = self._question

        def look() -> None:
            if question is not self._question or question is None:
                return
            if self._clock() < self._until:
                self._watch()
            else:
                self._refuse("TIMEOUT")

        self._now().scheduler.after(round(left * S), look)

    def _look_at_mode(self) -> None:
        if self._now().mode == "auto":
            self._end()

    def _refuse(self, why: str) -> None:
        if self.session is not None:
            self._refused[self.session] = why
        self._end()

    def _end(self) -> None:
        self._withdraw()
        if self.session is not None:
            self._now().operation.changed.remove(self._look_at_mode)
        self.session, self.granted = None, False

    def _withdraw(self) -> None:
        question, self._question = self._question, None
        if question is not None:
            self._now().operator.withdraw(question)


def _read(text: str) -> str:
    for choice in _CHOICES:
        if text.strip().lower() == choice.lower():
            return choice
    raise ValueError("Grant or Deny")
