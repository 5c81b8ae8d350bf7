"""Sessions of logged-in clients and their limits.

70 sessions in all, 300 s idle [RWS manual]; 20 requests a second on RWS 1.0 [RWS manual]. All times
are those of the controller's clock.
"""

import secrets
from collections import deque
from collections.abc import Callable
from dataclasses import dataclass, field

MOST = 70
IDLE = 300.0
"""s without a request that end a session."""
RATE = 20
"""Requests in a second of the controller's clock."""


@dataclass(slots=True, eq=False)
class Session:
    """Session of one client."""

    key: str
    user: str
    number: int
    seen: float
    application: str = ""
    location: str = ""
    alias: str = ""
    station: str = ""
    """Control station of RobotWare 8 to which it belongs."""
    on_end: list[Callable[[], None]] = field(default_factory=list)


class Sessions:
    """All sessions of a server."""

    def __init__(self, clock: Callable[[], float], *, limited: bool = True) -> None:
        """`limited`: at most RATE requests in a second."""
        self._clock = clock
        self._limited = limited
        self._sessions: dict[str, Session] = {}
        self._recent: deque[float] = deque()
        self._made = 0

    def __len__(self) -> int:
        return len(self._sessions)

    def all(self) -> tuple[Session, ...]:
        """All sessions, in the order of their start."""
        self._expire()
        return tuple(self._sessions.values())

    def is_too_fast(self) -> bool:
        """Count a request; True if it exceeds the rate."""
        if not self._limited:
            return False
        now = self._clock()
        while self._recent and self._recent[0] <= now - 1:
            self._recent.popleft()
        if len(self._recent) >= RATE:
            return True
        self._recent.append(now)
        return False

    def find(self, key: str) -> Session | None:
        """Return the session of a cookie and keep it alive; None if it ended."""
        self._expire()
        session = self._sessions.get(key)
        if session is not None:
            session.seen = self._clock()
        return session

    def begin(self, user: str) -> Session | None:
        """Create a session; None if there are too many."""
        self._expire()
        if len(self._sessions) >= MOST:
            return None
        self._made += 1
        session = Session(secrets.token_hex(16), user, self._made, self._clock())
        self._sessions[session.key] = session
        return session

    def end(self, session: Session) -> None:
        """End a session and everything that depends on it."""
        if self._sessions.pop(session.key, None) is not None:
            for act in tuple(session.on_end):
                act()

    def end_all(self) -> None:
        """End all sessions, for a restart."""
        for session in tuple(self._sessions.values()):
            self.end(session)
        self._recent.clear()

    def _expire(self) -> None:
        before = self._clock() - IDLE
        for session in tuple(self._sessions.values()):
            if session.seen < before:
                self.end(session)
