"""Subscriptions: groups of resources with events over a websocket.

Priority 0 is 5 s, 1 is 200 ms, 2 at once and only for signals and persistents [RWS manual]. A
resource that changes all the time has events 5.25 s and 0.4 s apart, and at priority 2 each change:
two persistents changed every 50 ms, RobotWare 6 [Clement-RACINET/abb-rws-client-python-rw6]. Events
are XHTML in either generation; a signal's event repeats the text that was subscribed. Sources of
events are in the files of the handlers of these resources, with `@subscribable(...)`.
"""

import re
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Protocol
from urllib.parse import unquote

from rapidgen.machine.scheduler import Timer
from rapidgen.servers.rws.messages import RequestDenied, RwsRequest, Session
from rapidgen.wire.rws.bodies import Item
from rapidgen.wire.rws.events import WantedResource, write_events

if TYPE_CHECKING:
    from rapidgen.servers.rws.application import RwsApplication

_PERIODS = {0: 5_000_000_000, 1: 200_000_000, 2: 0}
"""ns from a change to its event."""
_SPACING = {0: 5_250_000_000, 1: 400_000_000, 2: 0}
"""ns between two events of one resource."""
MOST_RESOURCES, MOST_GROUPS, MOST_HIGH = 1000, 2, 64
MOST_SOCKETS = 19
"""Sessions that may hold a websocket [RWS 2.0 manual]."""
Send = Callable[[bytes | None], None]
"""Callback of a websocket: an event, or None to close it."""


# -- sources -------------------------------------------------------------------------------------

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


@dataclass(frozen=True, slots=True)
class Topic:
    """A resource that a client subscribes: its text, and parts of it."""

    request: RwsRequest
    text: str
    suffix: str
    names: Mapping[str, str]


Make = Callable[["RwsApplication", Topic], EventSource]
_TABLE: list[tuple[re.Pattern[str], tuple[str, ...], Make]] = []


def subscribable(path: str, *suffixes: str) -> Callable[[Make], Make]:
    """Register the decorated function as the source of paths.

    `suffixes` are the texts that may follow a `;`; none: any.
    """

    def put(make: Make) -> Make:
        _TABLE.append((re.compile(path), suffixes, make))
        return make

    return put


class _Notifier(Protocol):
    """Something that calls functions when it changes."""

    def add(self, look: Callable[[], None], /) -> None: ...
    def remove(self, look: Callable[[], None], /) -> None: ...


def every_change(of: _Notifier, item: Callable[[], Item]) -> EventSource:
    """Return a source with an event for each notification, at once."""

    def watch(notify: Notify) -> Callable[[], None]:
        def look() -> None:
            notify(None)

        of.add(look)
        return lambda: of.remove(look)

    return EventSource(item, watch, fast=True)


def new_values(of: _Notifier, now: Callable[[], object], item: Callable[[], Item]) -> EventSource:
    """Return a source with an event for each notification that changed `now`."""

    def watch(notify: Notify) -> Callable[[], None]:
        last = now()

        def look() -> None:
            nonlocal last
            if (value := now()) != last:
                last = value
                notify(None)

        of.add(look)
        return lambda: of.remove(look)

    return EventSource(item, watch)


# -- groups --------------------------------------------------------------------------------------


@dataclass(slots=True, eq=False)
class _Watch:
    """One resource of a group."""

    wanted: WantedResource
    source: EventSource
    timer: Timer | None = None
    next: int = 0
    """Time (ns) of the earliest next event."""
    end: Callable[[], None] = lambda: None


@dataclass(slots=True, eq=False)
class EventGroup:
    """One subscription. `send` is set while a websocket is connected."""

    number: int
    session: Session
    watches: list[_Watch] = field(default_factory=list)
    send: Send | None = None
    spent: bool = False
    """RWS 2.0: its websocket has existed; it cannot be opened again."""
    waiting: list[Item] = field(default_factory=list)
    """Events before a websocket is connected."""


class Groups:
    """All subscriptions of an application."""

    def __init__(self, app: "RwsApplication") -> None:
        self._app = app
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
        result = [_Watch(one, self._source(request, one.resource)) for one in requested]
        every = [*group.watches, *result]
        high = sum(w.wanted.priority == 2 for w in every)
        if len(every) > MOST_RESOURCES or high > MOST_HIGH:
            raise RequestDenied(503, "E_MAX_LIMIT_REACHED", "too many resources")
        if any(w.wanted.priority == 2 and not w.source.fast for w in result):
            raise RequestDenied(400, "E_INVALIDARG", "high priority is for signals and persistents")
        for watch in result:
            group.watches.append(watch)
            watch.end = watch.source.watch(self._changed(group, watch))

    def _source(self, request: RwsRequest, text: str) -> EventSource:
        """Return the event source of a path such as `/rw/panel/ctrlstate`.

        RequestDenied: there is none.
        """
        path, _, suffix = text.partition(";")
        path = unquote(path).rstrip("/")
        for pattern, suffixes, make in _TABLE:
            match = pattern.fullmatch(path)
            if match is not None and (not suffixes or suffix in suffixes):
                return make(self._app, Topic(request, text, suffix, match.groupdict()))
        raise RequestDenied(400, "E_INVALIDARG", f"cannot be subscribed: {text}")

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
        return [w.source.item() for w in group.watches if w.source.has_state]

    def end(self, group: EventGroup) -> None:
        """End a group and its websocket."""
        if self._groups.pop(str(group.number), None) is None:
            return
        for watch in group.watches:
            self._end_watch(watch)
        if group.send is not None:
            group.send(None)

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

    def listen(self, number: str, session: Session, send: Send) -> None:
        """Connect a websocket to a group of a session.

        RequestDenied: there is no such group, or too many websockets, or RWS 2.0 has used its poll
        URL.
        """
        group = self.find(number, session)
        if group.spent and not self._app.is_one:
            raise RequestDenied(404, "E_UNRESOLVED_URL", "used already")
        listening = sum(g.send is not None for g in self._groups.values())
        if listening >= MOST_SOCKETS:
            raise RequestDenied(503, "E_MAX_LIMIT_REACHED", "19 websockets are the most")
        if group.send is not None:
            group.send(None)
        group.send, group.spent = send, True
        for item in group.waiting:
            send(write_events([item]))
        group.waiting.clear()

    def leave(self, number: str, send: Send) -> None:
        """Disconnect the websocket; RWS 2.0 permits no second one."""
        group = self._groups.get(number)
        if group is None or group.send is not send:
            return
        group.send = None
        if not self._app.is_one:
            self.end(group)

    def _changed(self, group: EventGroup, watch: _Watch) -> Notify:
        """Return the callback for a change.

        It receives the event if a later read would miss it.
        """

        def now(item: Item) -> None:
            if group.send is None:
                group.waiting.append(item)
                del group.waiting[:-MOST_RESOURCES]
            else:
                # One message an event: a public client expects this.
                group.send(write_events([item]))

        def later() -> None:
            watch.timer = None
            watch.next = self._app.controller.scheduler.now + _SPACING[watch.wanted.priority]
            now(watch.source.item())

        def changed(item: Item | None) -> None:
            period = _PERIODS[watch.wanted.priority]
            if item is not None or not period:
                now(item or watch.source.item())
            elif watch.timer is None:
                scheduler = self._app.controller.scheduler
                due = max(scheduler.now + period, watch.next)
                watch.timer = scheduler.at(due, later)

        return changed
