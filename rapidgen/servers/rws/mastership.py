"""Mastership of RobotWare 6 and 7, write access of RobotWare 8.

RobotWare 6 has the domains cfg, motion and rapid, 7 edit and motion, 8 one write access that
belongs to a control station and outlives the session [VC 6.16, VC 7.21, VC 8.1.1].
"""

from collections.abc import Callable
from typing import Literal

from rapidgen.machine.scheduler import WaitSet
from rapidgen.servers.rws.messages import RequestDenied, RwsRequest
from rapidgen.servers.rws.rmmp import ManualPrivilege, Privilege
from rapidgen.servers.rws.sessions import Session
from rapidgen.wire.rws.bodies import Generation

Domain = Literal["cfg", "motion", "rapid"]


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
