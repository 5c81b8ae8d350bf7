"""Subscriptions: groups of resources with events over a websocket.

Priority 0 is 5 s, 1 is 200 ms, 2 at once and only for signals and persistents [RWS manual]. Events
are XHTML in either generation; a signal's event repeats the text that was subscribed.
"""

from collections.abc import Callable, Iterable
from dataclasses import dataclass, field

from rapidgen.machine.scheduler import Scheduler, Timer
from rapidgen.servers.rws.messages import RequestDenied, RwsRequest
from rapidgen.servers.rws.sessions import Session
from rapidgen.wire.rws.bodies import Generation, Item
from rapidgen.wire.rws.events import WantedResource, write_events

_PERIODS = {0: 5_000_000_000, 1: 200_000_000, 2: 0}
MOST_RESOURCES, MOST_GROUPS, MOST_HIGH = 1000, 2, 64
MOST_SOCKETS = 19
"""Sessions that may hold a websocket [RWS 2.0 manual]."""
Send = Callable[[bytes], None]


Notify = Callable[[Item | None], None]
"""Callback for a change.

It has the event if only the source knows it.
"""


@dataclass(frozen=True, slots=True)
class EventSource:
    """A resource: `item()` is its current event.

    `watch(notify)` starts watching and returns the function that ends it.
    """

    item: Callable[[], Item]
    watch: Callable[[Notify], Callable[[], None]]
    fast: bool = False
    has_state: bool = True


@dataclass(slots=True, eq=False)
class _Watch:
    """One resource of a group."""

    wanted: WantedResource
    seen: EventSource
    timer: Timer | None = None
    end: Callable[[], None] = lambda: None


@dataclass(slots=True, eq=False)
class EventGroup:
    """One subscription. `send` is set while a websocket is connected."""

    number: int
    session: Session
    watches: list[_Watch] = field(default_factory=list)
    send: Send | None = None
    hang_up: Callable[[], None] = lambda: None
    spent: bool = False
    """RWS 2.0: its websocket has existed; it cannot be opened again."""
    waiting: list[Item] = field(default_factory=list)
    """Events before a websocket is connected."""


class Groups:
    """All subscriptions of a server."""

    def __init__(
        self,
        generation: Generation,
        scheduler: Callable[[], Scheduler],
        watched: Callable[[RwsRequest, WantedResource], EventSource],
    ) -> None:
        """`watched` returns the source of a resource, or refuses it."""
        self._generation = generation
        self._scheduler = scheduler
        self._watched = watched
        self._groups: dict[str, EventGroup] = {}
        self._made = 0

    def find(self, number: str, session: Session) -> EventGroup:
        """Return a group of a session. RequestDenied: it has no such group."""
        group = self._groups.get(number)
        if group is None or group.session is not session:
            raise RequestDenied(404, "E_UNRESOLVED_URL", f"no subscription {number}")
        return group

    def of(self, session: Session) -> list[EventGroup]:
        """Return groups of a session."""
        return [group for group in self._groups.values() if group.session is session]

    def begin(self, request: RwsRequest, requested: Iterable[WantedResource]) -> EventGroup:
        """Create a group.

        RequestDenied: too many, or a resource without a source.
        """
        if len(self.of(request.session)) >= MOST_GROUPS:
            raise RequestDenied(503, "E_MAX_LIMIT_REACHED", "two groups are the most")
        self._made += 1
        group = EventGroup(self._made, request.session)
        self.add(request, group, requested)
        self._groups[str(group.number)] = group
        request.session.on_end.append(lambda: self.end(group))
        return group

    def add(
        self, request: RwsRequest, group: EventGroup, requested: Iterable[WantedResource]
    ) -> None:
        """Add resources to a group, all or none. Raises RequestDenied."""
        result = [_Watch(one, self._watched(request, one)) for one in requested]
        every = [*group.watches, *result]
        high = sum(w.wanted.priority == 2 for w in every)
        if len(every) > MOST_RESOURCES or high > MOST_HIGH:
            raise RequestDenied(503, "E_MAX_LIMIT_REACHED", "too many resources")
        if any(w.wanted.priority == 2 and not w.seen.fast for w in result):
            raise RequestDenied(400, "E_INVALIDARG", "high priority is for signals and persistents")
        for watch in result:
            group.watches.append(watch)
            watch.end = watch.seen.watch(self._changed(group, watch))

    def remove(self, group: EventGroup, resource: str) -> None:
        """Remove one resource; the last one ends the group.

        RequestDenied: the group does not have it.
        """
        for watch in group.watches:
            if watch.wanted.resource == resource:
                self._end_watch(watch)
                group.watches.remove(watch)
                if not group.watches:
                    self.end(group)
                return
        raise RequestDenied(400, "E_INVALIDARG", f"no resource {resource}")

    def initial(self, group: EventGroup) -> list[Item]:
        """Return the current events of a group."""
        return [w.seen.item() for w in group.watches if w.seen.has_state]

    def end(self, group: EventGroup) -> None:
        """End a group."""
        if self._groups.pop(str(group.number), None) is None:
            return
        for watch in group.watches:
            self._end_watch(watch)
        group.hang_up()

    def end_all(self) -> None:
        """End all groups, for a restart."""
        for group in tuple(self._groups.values()):
            self.end(group)

    @staticmethod
    def _end_watch(watch: _Watch) -> None:
        watch.end()
        if watch.timer is not None:
            watch.timer.cancel()

    # -- events ----------------------------------------------------------------------------------

    def listen(self, group: EventGroup, send: Send, hang_up: Callable[[], None]) -> None:
        """Connect the websocket.

        RequestDenied: RWS 2.0 uses a poll URL once.
        """
        if group.spent and self._generation is not Generation.ONE:
            raise RequestDenied(404, "E_UNRESOLVED_URL", "used already")
        listening = sum(g.send is not None for g in self._groups.values())
        if listening >= MOST_SOCKETS:
            raise RequestDenied(503, "E_MAX_LIMIT_REACHED", "19 websockets are the most")
        group.send, group.hang_up, group.spent = send, hang_up, True
        for item in group.waiting:
            self._tell(group, item)
        group.waiting.clear()

    def leave(self, number: str, send: Send) -> None:
        """Disconnect the websocket; RWS 2.0 permits no second one."""
        group = self._groups.get(number)
        if group is None or group.send is not send:
            return
        group.send, group.hang_up = None, lambda: None
        if self._generation is not Generation.ONE:
            self.end(group)

    def _changed(self, group: EventGroup, watch: _Watch) -> Callable[[Item | None], None]:
        """Return the callback for a change.

        It receives the event if a later read would miss it.
        """

        def now(item: Item) -> None:
            if group.send is None:
                group.waiting.append(item)
                del group.waiting[:-MOST_RESOURCES]
            else:
                self._tell(group, item)

        def later() -> None:
            watch.timer = None
            now(watch.seen.item())

        def changed(item: Item | None) -> None:
            period = _PERIODS[watch.wanted.priority]
            if item is not None or not period:
                now(item or watch.seen.item())
            elif watch.timer is None:
                watch.timer = self._scheduler().after(period, later)

        return changed

    def _tell(self, group: EventGroup, item: Item) -> None:
        """Send one message an event: a public client expects this."""
        assert group.send is not None
        group.send(write_events([item]))
