"""Who may write: masterships, write access of RobotWare 8, manual mode.

RobotWare 6 has the domains cfg, motion and rapid, 7 edit and motion, 8 one write access that
belongs to a control station and outlives the session [VC 6.16, VC 7.21, VC 8.1.1].
"""

from collections.abc import Callable
from typing import Literal

from rapidgen.controller.controller import VirtualController
from rapidgen.machine.operator import Question
from rapidgen.machine.scheduler import S, WaitSet
from rapidgen.servers.rws.messages import RequestDenied, RwsRequest, Session
from rapidgen.wire.rws.bodies import Generation

Domain = Literal["cfg", "motion", "rapid"]
Privilege = Literal["modify", "exec"]
PROMPT_SECONDS = 10.0
"""s for an answer of the pendant's user, from the last poll."""
_CHOICES = ("Grant", "Deny")


class ManualPrivilege:
    """Holder of remote writing in manual mode, or its applicant (RMMP).

    The question is a dialog of the virtual pendant (`RMMP`: Grant or Deny), answered as every other
    one. It stays open for 10 s after the last poll. A grant ends with the session, the mode or a
    cancel [RWS manual]. `exec` includes `modify`.
    """

    def __init__(self, controller: VirtualController, clock: Callable[[], float]) -> None:
        """`clock` returns the controller's time in s."""
        self._controller = controller
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
        controller = self._controller
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

        self._controller.scheduler.after(round(left * S), look)

    def _look_at_mode(self) -> None:
        if self._controller.mode == "auto":
            self._end()

    def _refuse(self, why: str) -> None:
        if self.session is not None:
            self._refused[self.session] = why
        self._end()

    def _end(self) -> None:
        self._withdraw()
        if self.session is not None:
            self._controller.operation.changed.remove(self._look_at_mode)
        self.session, self.granted = None, False

    def _withdraw(self) -> None:
        question, self._question = self._question, None
        if question is not None:
            self._controller.operator.withdraw(question)


def _read(text: str) -> str:
    for choice in _CHOICES:
        if text.strip().lower() == choice.lower():
            return choice
    raise ValueError("Grant or Deny")


class Masterships:
    """Mastership of one server."""

    def __init__(
        self,
        generation: Generation,
        mode: Callable[[], str],
        manual: ManualPrivilege,
        *,
        strict: bool = True,
    ) -> None:
        """`mode` is the controller's operating mode.

        `manual` holds the remote-writing privilege in manual mode.
        """
        self._generation = generation
        self._mode = mode
        self.manual = manual
        self._strict = strict
        self.holders: dict[str, Session] = {}
        self.changed = WaitSet()
        """Notified when a domain is taken or released."""
        self.stations: dict[str, str] = {}
        """Names of control stations by their id."""
        self.station = ""
        """The control station with write access."""
        self.motion_allowed = False

    @property
    def domains(self) -> tuple[str, ...]:
        """Return the domains of mastership."""
        one = self._generation is Generation.ONE
        return ("cfg", "motion", "rapid") if one else ("edit", "motion")

    def request(self, session: Session, domain: str) -> None:
        """Take a domain; taking it again is permitted.

        RequestDenied: another session has it.
        """
        self._check(domain)
        holder = self.holders.get(domain)
        if holder is None:
            self.holders[domain] = session
            self.changed.notify()
            session.on_end.append(lambda: self._drop(domain, session))
        elif holder is not session:
            raise RequestDenied(403, "E_RESOURCE_HELD", f"mastership of {domain} is held", -1)

    def release(self, session: Session, domain: str) -> None:
        """Release a domain. RequestDenied: this session does not hold it."""
        self._check(domain)
        if self.holders.get(domain) is not session:
            raise RequestDenied(
                403, "E_RESOURCE_NOT_HELD", f"mastership of {domain} is not held", -1
            )
        del self.holders[domain]
        self.changed.notify()

    def _drop(self, domain: str, session: Session) -> None:
        if self.holders.get(domain) is session:
            del self.holders[domain]
            self.changed.notify()

    def _check(self, domain: str) -> None:
        if domain not in self.domains:
            raise RequestDenied(404, "E_UNRESOLVED_URL", f"no domain {domain}")

    def need(self, request: RwsRequest, domain: Domain, *, by_itself: bool = False) -> None:
        """Check that a session has mastership for a request.

        RequestDenied: it does not. `by_itself`: the controller takes a free mastership for the
        request.
        """
        self.need_mode(request.session)
        if self._generation is Generation.EIGHT:
            if not request.session.station or request.session.station != self.station:
                raise RequestDenied(403, "E_NO_WRITE_ACCESS", "session does not have SPoC", -20_107)
            return
        name = domain if self._generation is Generation.ONE else "edit"
        holder = self.holders.get(name)
        if holder is request.session:
            return
        if holder is not None:
            raise RequestDenied(403, "E_RESOURCE_HELD", f"mastership of {name} is held", -1)
        implicit = by_itself or request.query.get("mastership") == "implicit"
        if not implicit and self._strict:
            raise RequestDenied(403, "E_MASTER_REJECT", f"mastership of {name} is missing", -4_501)

    @property
    def is_editing(self) -> bool:
        """True if a session holds a domain that a start of RAPID needs."""
        return self._generation is Generation.TWO and "edit" in self.holders

    def need_mode(self, session: Session, privilege: Privilege = "modify") -> None:
        """Check that a remote client may write.

        It may in automatic mode, and in manual mode with a grant.
        """
        if self._mode() == "auto" or not self._strict or self.manual.has(session, privilege):
            return
        raise RequestDenied(403, "E_MODE_REJECT", "neither automatic mode nor RMMP", -4_502)

    def need_start(self, request: RwsRequest) -> None:
        """Check a start: write access and motion allowed on RobotWare 8.

        [real 8.1.0]
        """
        if self._generation is Generation.EIGHT:
            self.need(request, "rapid")
            if not self.motion_allowed:
                raise RequestDenied(
                    403, "E_NO_WRITE_ACCESS", "motion control is not allowed", -20_107
                )
