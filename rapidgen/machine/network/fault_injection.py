"""Injection of network faults by rules."""

from collections import deque
from dataclasses import dataclass, replace
from typing import Literal

from rapidgen.machine.network.interface import (
    BUFFER,
    Endpoint,
    Network,
    NetworkFault,
    NetworkReason,
    SocketAddress,
    taken,
)
from rapidgen.machine.scheduler import S, Scheduler

# -- Rules -----------------------------------------------------------------------------------------
#
# Rules of what goes wrong with connections, as data; `faulty.py` carries them out.


NetworkAction = Literal["split", "merge", "delay", "reset", "half-open", "silent", "slow"]
Direction = Literal["in", "out", "both"]


@dataclass(frozen=True, slots=True)
class NetworkRule:
    """A fault of a port's connections after `after` bytes.

    `port` 0 and `connection` 0 mean all; a direction is seen from the program (`in`: received
    data). `bytes`: size of the pieces (split) or bytes per second (slow). `seconds`: the gap
    between pieces (split), the time to collect bytes (merge) or to delay them (delay).
    """

    do: NetworkAction
    port: int = 0
    direction: Direction = "both"
    connection: int = 0
    after: int = 0
    bytes: int = 1
    seconds: float = 0.001

    def concerns(self, port: int, connection: int) -> bool:
        """Return True if the rule applies to a connection, counted from 1."""
        return self.port in (0, port) and self.connection in (0, connection)


# -- Injection -------------------------------------------------------------------------------------
#
# A network with planned faults: it wraps either implementation, on the controller's side.
#
# TCP loses no bytes in the middle of a stream, so a rule never drops single bytes: they arrive in
# other pieces, later, or not at all from some byte on. Both directions of an affected connection
# pass through queues here; all others pass directly.


class _Lane:
    """A direction of a connection: pieces with their times."""

    def __init__(self, scheduler: Scheduler, rules: list[NetworkRule]) -> None:
        self._scheduler = scheduler
        self._rules = rules
        self._taken = 0
        self._last = 0
        self.pieces: deque[tuple[int, bytes]] = deque()
        self.waiting = 0
        """Bytes in the queue."""

    @property
    def active(self) -> bool:
        """True if a rule applies to this direction."""
        return bool(self._rules)

    def ended_by(self) -> NetworkRule | None:
        """Return the rule that blocks further bytes."""
        for rule in self._rules:
            if rule.do in ("reset", "silent") and self._taken >= rule.after:
                return rule
        return None

    def obey(self, rules: list[NetworkRule]) -> None:
        """Use other rules from the next byte on."""
        self._rules = [replace(rule, after=self._taken + rule.after) for rule in rules]

    def half_open(self) -> bool:
        """Return True if the program does not see the connection's end."""
        return any(r.do == "half-open" and self._taken >= r.after for r in self._rules)

    def put(self, data: bytes) -> None:
        """Split bytes into pieces with times; discard bytes after an end."""
        while data:
            limits = [r.after - self._taken for r in self._rules if r.after > self._taken]
            if self.ended_by() is not None:
                return
            part, data = (
                data[: min(limits, default=len(data))],
                data[min(limits, default=len(data)) :],
            )
            self._put_part(part)
            self._taken += len(part)

    def _put_part(self, part: bytes) -> None:
        rules = [r for r in self._rules if self._taken >= r.after]
        size, gap, hold, gather = len(part), 0.0, 0.0, 0.0
        for rule in rules:
            if rule.do == "split":
                size, gap = max(1, rule.bytes), rule.seconds
            elif rule.do == "slow":
                size = max(1, min(size, rule.bytes // 10 or 1))
                gap = size / max(1, rule.bytes)
            elif rule.do == "delay":
                hold = rule.seconds
            elif rule.do == "merge":
                gather = rule.seconds
        now = self._scheduler.now
        for start in range(0, len(part), size):
            time = max(now + round(hold * S), self._last + round(gap * S))
            if gather:
                # All bytes of an interval pass at its end.
                stretch = round(gather * S)
                time = -(-time // stretch) * stretch
            self._last = time
            self.pieces.append((time, part[start : start + size]))
        self.waiting += len(part)

    def take(self) -> tuple[int, bytes]:
        """Remove and return the first piece and its time."""
        time, piece = self.pieces.popleft()
        self.waiting -= len(piece)
        return time, piece

    def give_back(self, time: int, remaining: bytes) -> None:
        """Put back the rest of the first piece."""
        self.pieces.appendleft((time, remaining))
        self.waiting += len(remaining)


class _Line:
    """A connection under a plan."""

    def __init__(self, lane_in: _Lane, lane_out: _Lane) -> None:
        self.lane_in = lane_in
        self.lane_out = lane_out
        self.ready = bytearray()
        self.end: bytes | NetworkFault | None = None
        """How the connection ended for us: b"" or the fault."""
        self.closing = False
        self.alarm = 0
        self.broken_sends = 0


class FaultyNetwork(Network):
    """`inner` with rules; endpoints are those of `inner`."""

    def __init__(
        self, inner: Network, scheduler: Scheduler, rules: tuple[NetworkRule, ...]
    ) -> None:
        super().__init__()
        self._inner = inner
        self._scheduler = scheduler
        self._rules = rules
        self._lines: dict[Endpoint, _Line] = {}
        self._ports: dict[Endpoint, int] = {}
        self._counts: dict[int, int] = {}
        self.address = inner.address
        self.listeners = inner.listeners
        self.listening = inner.listening

    def bind(self, host: str, port: int, *, datagram: bool = False) -> Endpoint:
        """See `Network.bind`."""
        endpoint = self._inner.bind(host, port, datagram=datagram)
        self._ports[endpoint] = port
        return endpoint

    def listen(self, endpoint: Endpoint) -> None:
        """See `Network.listen`."""
        self._inner.listen(endpoint)

    def accept(self, endpoint: Endpoint) -> Endpoint | None:
        """See `Network.accept`."""
        client = self._inner.accept(endpoint)
        if client is not None:
            self._watch(client, self._ports.get(endpoint, 0))
        return client

    def connect(self, host: str, port: int) -> Endpoint:
        """See `Network.connect`."""
        endpoint = self._inner.connect(host, port)
        self._watch(endpoint, port)
        return endpoint

    def send(self, endpoint: Endpoint, data: bytes, to: SocketAddress | None = None) -> int:
        """See `Network.send`."""
        line = self._lines.get(endpoint)
        if line is None or not line.lane_out.active or not endpoint.connected:
            return self._inner.send(endpoint, data, to)
        if isinstance(line.end, NetworkFault) and not line.lane_out.half_open():
            raise line.end
        if line.end is not None and line.lane_out.half_open():
            # The peer is gone: the first send succeeds, its answer is a reset.
            line.broken_sends += 1
            if line.broken_sends > 1:
                raise NetworkFault(NetworkReason.RESET, "half-open")
            return len(data)
        self._reset_by_plan(endpoint, line, line.lane_out)
        free = BUFFER - line.lane_out.waiting
        line.lane_out.put(data[:free])
        self._advance(endpoint, line)
        return len(data[:free])

    def receive(
        self, endpoint: Endpoint, count: int, *, exact: bool = False, peek: bool = False
    ) -> bytes | None:
        """See `Network.receive`."""
        line = self._lines.get(endpoint)
        if line is None or not line.lane_in.active:
            return self._inner.receive(endpoint, count, exact=exact, peek=peek)
        self._advance(endpoint, line)
        data = taken(line.ready, count, exact=exact, peek=peek)
        if data is not None:
            return data
        self._reset_by_plan(endpoint, line, line.lane_in)
        if line.lane_in.pieces or line.end is None or line.lane_in.ended_by() is not None:
            return None
        if line.lane_in.half_open():
            return None
        if isinstance(line.end, NetworkFault):
            raise line.end
        return b""

    def close(self, endpoint: Endpoint, *, abort: bool = False) -> None:
        """See `Network.close`."""
        self._ports.pop(endpoint, None)
        line = self._lines.get(endpoint)
        if line is not None and line.lane_out.pieces and not abort:
            line.closing = True
            self._advance(endpoint, line)
            return
        self._lines.pop(endpoint, None)
        self._inner.close(endpoint, abort=abort)

    def shut_down(self) -> None:
        """See `Network.shut_down`."""
        self._lines.clear()
        self._inner.shut_down()

    def obey(self, rules: tuple[NetworkRule, ...]) -> None:
        """Use another plan for future connections."""
        self._rules = rules

    def inject_fault(self, endpoint: Endpoint, rule: NetworkRule) -> None:
        """Apply one rule to a connection instead of those of the plan.

        Waiting bytes pass before.
        """
        line = self._lines.get(endpoint)
        if line is None:
            self._put_under(endpoint, [rule])
            return
        for way, lane in (("in", line.lane_in), ("out", line.lane_out)):
            lane.obey([rule] if rule.direction in (way, "both") else [])
        self._advance(endpoint, line)

    # -- inside -----------------------------------------------------------------------------

    def _watch(self, endpoint: Endpoint, port: int) -> None:
        number = self._counts[port] = self._counts.get(port, 0) + 1
        rules = [rule for rule in self._rules if rule.concerns(port, number)]
        if rules:
            self._put_under(endpoint, rules)

    def _put_under(self, endpoint: Endpoint, rules: list[NetworkRule]) -> None:
        lanes = [
            _Lane(self._scheduler, [r for r in rules if r.direction in (way, "both")])
            for way in ("in", "out")
        ]
        line = self._lines[endpoint] = _Line(*lanes)
        endpoint.changed.add(lambda: self._advance(endpoint, line))
        self._advance(endpoint, line)

    def _advance(self, endpoint: Endpoint, line: _Line) -> None:
        """Read arrived data, pass on due data, and schedule the next call."""
        if self._lines.get(endpoint) is not line:
            return
        if line.lane_in.active:
            self._pull(endpoint, line)
        now = self._scheduler.now
        arrived = line.lane_in.pieces
        while arrived and arrived[0][0] <= now:
            line.ready += line.lane_in.take()[1]
        leaving = line.lane_out.pieces
        while leaving and leaving[0][0] <= now:
            time, piece = line.lane_out.take()
            taken = self._offer(endpoint, line, piece)
            if taken < len(piece):
                line.lane_out.give_back(time, piece[taken:])
                break
        if line.closing and not leaving:
            self._lines.pop(endpoint, None)
            self._inner.close(endpoint)
            return
        due = [lane[0][0] for lane in (arrived, leaving) if lane and lane[0][0] > now]
        if due and not now < line.alarm <= min(due):
            line.alarm = min(due)
            self._scheduler.at(line.alarm, endpoint.changed.notify)

    def _pull(self, endpoint: Endpoint, line: _Line) -> None:
        while line.end is None and endpoint.connected:
            free = BUFFER - line.lane_in.waiting - len(line.ready)
            if free <= 0:
                return
            try:
                data = self._inner.receive(endpoint, free)
            except NetworkFault as fault:
                line.end = fault
                return
            if data is None:
                return
            if data:
                line.lane_in.put(data)
            else:
                line.end = b""

    def _offer(self, endpoint: Endpoint, line: _Line, piece: bytes) -> int:
        try:
            return self._inner.send(endpoint, piece)
        except NetworkFault as fault:
            line.end = fault
            return len(piece)

    def _reset_by_plan(self, endpoint: Endpoint, line: _Line, lane: _Lane) -> None:
        rule = lane.ended_by()
        if rule is not None and rule.do == "reset" and not lane.pieces:
            self._lines.pop(endpoint, None)
            self._inner.close(endpoint, abort=True)
            raise NetworkFault(NetworkReason.RESET, "by plan")
