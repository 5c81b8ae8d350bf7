"""Remote writing in manual mode, granted by the pendant's user.

The question is a dialog of the virtual pendant (`RMMP`: Grant or Deny), answered as every other
one. It stays open for 10 s after the last poll. A grant ends with the session, the mode or a cancel
[RWS manual]. `exec` includes `modify`.
"""

from collections.abc import Callable
from typing import Literal

from rapidgen.controller.controller import VirtualController
from rapidgen.machine.operator import Question
from rapidgen.machine.scheduler import S
from rapidgen.servers.rws.sessions import Session

Privilege = Literal["modify", "exec"]
PROMPT_SECONDS = 10.0
"""s for an answer of the pendant's user, from the last poll."""
_CHOICES = ("Grant", "Deny")


class ManualPrivilege:
    """Holder of remote writing in manual mode, or its applicant."""

    def __init__(self, now: Callable[[], VirtualController], clock: Callable[[], float]) -> None:
        """`now` returns the running controller, `clock` its time in s."""
        self._now = now
        self._clock = clock
        self.session: Session | None = None
        """Session that requests or holds it."""
        self.privilege: Privilege = "modify"
        self.granted = False
        self._question: Question | None = None
        self._until = 0.0
        self._refused: dict[Session, str] = {}
        """Results of requests that ended without a grant."""

    def ask(self, session: Session, privilege: Privilege) -> bool:
        """Open the prompt on the pendant.

        False: another session has requested or holds it.
        """
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
        if question.answered:  # as soon as it was requested
            self._answered(question)
        return True

    def keep(self, session: Session) -> None:
        """Poll: keep the prompt open for another period."""
        if session is self.session:
            self._until = self._clock() + PROMPT_SECONDS

    def state(self, session: Session) -> str:
        """Return GRANTED or PENDING, or how a request ended.

        That is DENIED, TIMEOUT, or NONE without a request.
        """
        if session is self.session:
            return "GRANTED" if self.granted else "PENDING"
        return self._refused.get(session, "NONE")

    def has(self, session: Session, privilege: Privilege) -> bool:
        """True if a session has this privilege in manual mode."""
        return session is self.session and self.granted and self._holds(privilege)

    def cancel(self, session: Session) -> None:
        """Cancel the request, or release the privilege."""
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
