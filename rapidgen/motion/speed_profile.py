"""When the robot is where on its path: speed profiles in closed form.

A path has one coordinate, its *nominal time* in s: at speed 1 everything moves as programmed.
A speed profile is a chain of phases of constant acceleration of that coordinate, so its state at
any time, and the time of any place, are formulas and no integration step exists.

Every axis divides its acceleration between the curvature of the path and the change of speed. With
its rate r and its curvature c along the path, |r s\" + c s'^2| <= a has to hold. A span states this
as shares (R, C) = (r/a, c/a): R |s\"| + C s'^2 <= 1. Over a span of length L that is linear in the
square of the speed, x = s'^2: from x0 at one end, x1 <= (x0 R + 2 L) / (R + 2 L C) at the other.
One pass backwards gives the largest speed at the beginning of each span from which all later
limits can be kept, one pass forwards the profile. A path that only grows at its end is planned
again from the first span on at whose end that speed is another one (`Plan.extended`).
"""

from bisect import bisect_left, bisect_right
from collections.abc import Sequence
from math import inf, sqrt
from typing import Protocol

_TOLERANCE = 1e-7
_STALE = 64
"""Phases in the past above which `SpeedProfile.between` drops them."""
Shares = tuple[tuple[float, float], ...]
"""(R, C) of the axes that may limit a span."""


class ProfileSegment(Protocol):
    """A stretch of path with constant limits; `stop` asks for standstill at its end.

    `tcp` is the TCP's way in m per nominal s (0 where it is not known)."""

    @property
    def start(self) -> float: ...
    @property
    def end(self) -> float: ...
    @property
    def speed(self) -> float: ...
    @property
    def shares(self) -> Shares: ...
    @property
    def programmed(self) -> float: ...
    @property
    def tcp(self) -> float: ...
    @property
    def stop(self) -> bool: ...


class SpeedProfile:
    """Phases (start time s, place, speed, acceleration); at rest behind the last one."""

    __slots__ = (
        "_accelerations",
        "_area",
        "_areas",
        "_origin",
        "_places",
        "_speeds",
        "_times",
        "duration",
        "place",
    )

    def __init__(self, place: float) -> None:
        self._times: list[float] = []
        self._places: list[float] = []
        self._speeds: list[float] = []
        self._accelerations: list[float] = []
        self._areas: list[float] = []
        """Integrals of the place, counted from `_origin`, up to the beginning of each phase."""
        self._area = 0.0
        """The same up to `duration`."""
        self._origin = place
        self.duration = 0.0
        """Time at which it stands still, s."""
        self.place = place
        """Where it stands still."""

    def add(self, place: float, speed: float, acceleration: float, duration: float) -> None:
        """Append a phase that starts at `place` and lasts `duration`."""
        if duration <= 0.0:
            return
        self._times.append(self.duration)
        self._places.append(place)
        self._speeds.append(speed)
        self._accelerations.append(acceleration)
        self._areas.append(self._area)
        area = place - self._origin + (speed / 2 + acceleration * duration / 6) * duration
        self._area += area * duration
        self.duration += duration
        self.place = place + (speed + acceleration * duration / 2) * duration

    @property
    def phases(self) -> tuple[list[float], list[float], list[float], list[float]]:
        """Times, places, speeds and accelerations at which the phases begin; not to be changed."""
        return self._times, self._places, self._speeds, self._accelerations

    def then(self, other: "SpeedProfile", pause: float = 0.0) -> "SpeedProfile":
        """This law to its standstill, `pause` s of that, then `other`."""
        chain = SpeedProfile(self.place)
        chain._take(self, slice(None), 0.0)
        chain.duration = self.duration
        chain.add(self.place, 0.0, 0.0, pause)
        chain._take(other, slice(None), chain.duration)
        chain.duration += other.duration
        chain.place = other.place
        chain._integrate()
        return chain

    def after(self, before: "SpeedProfile", time: float, width: float) -> "SpeedProfile":
        """This law, and at negative times what `before` did in the `width` s up to `time`."""
        if width <= 0.0 or not before._times:
            return self
        chain = SpeedProfile(self.place)
        first = max(0, bisect_right(before._times, time - width) - 1)
        chain._take(before, slice(first, bisect_left(before._times, time)), -time)
        if before.duration < time:
            chain.duration = before.duration - time
            chain.add(before.place, 0.0, 0.0, time - before.duration)
        chain._take(self, slice(None), 0.0)
        chain.duration, chain.place = self.duration, self.place
        chain._integrate()
        return chain

    def between(self, begin: float, end: float) -> "SpeedProfile":
        """The phases from the one at `begin` on that begin before `end`; `end` begins a phase."""
        times = self._times
        first = max(0, bisect_right(times, begin) - 1)
        if first < _STALE:
            first = 0
        last = bisect_left(times, end)
        part = SpeedProfile(self.place)
        part._take(self, slice(first, last), 0.0)
        part.duration = end
        if first:
            part._integrate()
        else:
            part._origin, part._areas = self._origin, self._areas[:last]
            part._area = self._areas[last] if last < len(times) else self._area
        return part

    def _take(self, law: "SpeedProfile", phases: slice, offset: float) -> None:
        self._times += [t + offset for t in law._times[phases]] if offset else law._times[phases]
        self._places += law._places[phases]
        self._speeds += law._speeds[phases]
        self._accelerations += law._accelerations[phases]

    def _integrate(self) -> None:
        """Find the integrals of phases that were taken from other laws."""
        times, self._area = self._times, 0.0
        self._areas = []
        if self._places:
            self._origin = self._places[0]
        for i, start in enumerate(times):
            t = (times[i + 1] if i + 1 < len(times) else self.duration) - start
            self._areas.append(self._area)
            area = self._speeds[i] / 2 + self._accelerations[i] * t / 6
            self._area += (self._places[i] - self._origin + area * t) * t

    def mean(self, begin: float, end: float) -> tuple[float, float]:
        """Mean place and mean speed between two times, from the integrals.

        They are differences of sums, so their rounding grows with the time of the whole law.
        """
        (first, from_place), (last, to_place) = self._integral(begin), self._integral(end)
        span = end - begin
        return self._origin + (last - first) / span, (to_place - from_place) / span

    def _integral(self, time: float) -> tuple[float, float]:
        """Integral of the place from the origin on up to a time, and the place then."""
        if time >= self.duration:
            return self._area + (self.place - self._origin) * (time - self.duration), self.place
        i = bisect_right(self._times, time) - 1
        if i < 0:
            place = self._places[0]
            return (place - self._origin) * (time - self._times[0]), place
        t = time - self._times[i]
        place, speed, acceleration = self._places[i], self._speeds[i], self._accelerations[i]
        area = place - self._origin + (speed / 2 + acceleration * t / 6) * t
        return self._areas[i] + area * t, place + (speed + acceleration * t / 2) * t

    def state(self, time: float) -> tuple[float, float]:
        """Place and speed at a time (the first state for times before 0)."""
        if time >= self.duration or not self._times:
            return self.place, 0.0
        i = max(0, bisect_right(self._times, time) - 1)
        t = max(0.0, time - self._times[i])
        speed, acceleration = self._speeds[i], self._accelerations[i]
        return (
            self._places[i] + (speed + acceleration * t / 2) * t,
            max(0.0, speed + acceleration * t),
        )

    def time_at(self, place: float) -> float:
        """When `place` is reached; the end of the law for places that it does not reach."""
        if not self._places or place >= self.place:
            return self.duration
        i = max(0, bisect_left(self._places, place) - 1)
        path = place - self._places[i]
        if path <= 0.0:
            return self._times[i]
        speed = self._speeds[i]
        final = sqrt(max(0.0, speed * speed + 2 * self._accelerations[i] * path))
        return self._times[i] + 2 * path / (speed + final) if speed + final > 0 else self._times[i]

    def last_braking(self) -> float:
        """When the braking begins that ends at the final standstill."""
        i = len(self._times)
        while i and self._accelerations[i - 1] < 0.0:
            i -= 1
        return self._times[i] if i < len(self._times) else self.duration


class Plan:
    """A profile over spans, and what a profile over more spans can take from it."""

    __slots__ = ("_bounds", "_entries", "_settings", "_spans", "continues", "law")

    def __init__(
        self,
        spans: Sequence[ProfileSegment],
        law: SpeedProfile,
        bounds: list[float],
        entries: list[tuple[float, float]],
        settings: tuple[float, float, float],
        *,
        continues: bool = False,
    ) -> None:
        self._spans = spans
        self._bounds = bounds
        """Largest squared speed at the beginning of each span, and at the end."""
        self._entries = entries
        """Time and squared speed at the beginning of each span."""
        self._settings = settings
        """Cap, limit of the TCP and pause."""
        self.law = law
        self.continues = continues
        """Whether the law has the times of the one that was extended, or begins anew."""

    def extended(
        self,
        spans: Sequence[ProfileSegment],
        time: float,
        width: float,
        settings: tuple[float, float, float],
    ) -> "Plan | None":
        """The plan over other spans that begin with some of these.

        The law keeps its times, from `width` s before `time` on, and does not change before
        `time`. None: it would, so it has to be planned from the state at that time.
        """
        old, skipped = self._spans, _index(self._spans, spans[0])
        if skipped is None:
            ahead = _index(spans, old[0])
            spans, skipped = spans[ahead:] if ahead is not None else (), 0
        if settings != self._settings or not spans:
            return None
        same, high = 0, min(len(spans), len(old) - skipped)
        while same < high:
            middle = (same + high) // 2
            if spans[middle] is old[middle + skipped]:
                same = middle + 1
            else:
                high = middle
        # Where the path was extended before, the speeds are the same again from some span on.
        bounds = [0.0] * (len(spans) + 1)
        first = _bound(spans, spans[0].start, bounds, (self._bounds, skipped, same))
        if first == 0 or self._entries[skipped + first][0] < time:
            return None
        begin, x = self._entries[skipped + first]
        bounds[:first] = self._bounds[skipped : skipped + first]
        entries = self._entries[skipped : skipped + first]
        law = self.law.between(time - width, begin)
        _run(law, spans, first, spans[first - 1].end, x, bounds, entries, settings)
        return Plan(spans, law, bounds, entries, settings, continues=True)


def plan(
    spans: Sequence[ProfileSegment],
    place: float,
    speed: float,
    cap: float = 1.0,
    tcp_limit: float = inf,
    pause: float = 0.0,
    wait: float = 0.0,
) -> Plan | None:
    """The fastest law from a state to standstill at the end of the last span.

    Spans behind `place` do not count. `cap` (share of the programmed speed) and `tcp_limit` (m/s)
    are ceilings that
    may be below `speed`: then the law comes down to them. At stops on the way it waits `pause` s,
    before it begins `wait` s. None: from this state the limits of a later span cannot be kept.
    """
    spans = _ahead(spans, place)
    bounds = [0.0] * (len(spans) + 1)
    _bound(spans, place, bounds)
    x = speed * speed
    if x > bounds[0]:
        if speed > sqrt(bounds[0]) * (1 + _TOLERANCE) + _TOLERANCE:
            return None
        x = bounds[0]
        speed = sqrt(x)
    law = SpeedProfile(place)
    law.add(place, speed, 0.0, wait)
    entries: list[tuple[float, float]] = []
    settings = cap, tcp_limit, pause
    _run(law, spans, 0, place, x, bounds, entries, settings)
    return Plan(spans, law, bounds, entries, settings)


def _run(
    law: SpeedProfile,
    spans: Sequence[ProfileSegment],
    first: int,
    place: float,
    x: float,
    bounds: Sequence[float],
    entries: list[tuple[float, float]],
    settings: tuple[float, float, float],
) -> None:
    """Complete a law, and the entries, from the `first` span on: from a place, speed squared."""
    cap, tcp_limit, pause = settings
    speed, last = sqrt(x), len(spans) - 1
    for i in range(first, len(spans)):
        span = spans[i]
        entries.append((law.duration, x))
        path = span.end - place
        if path <= 0.0:
            continue
        ceiling = min(span.speed, cap * span.programmed)
        if span.tcp * ceiling > tcp_limit:
            ceiling = tcp_limit / span.tcp
        most = ceiling * ceiling
        if x > most:
            a = _reserve(span.shares, x)
            down = (x - most) / (2 * a)
            if down >= path:
                x -= 2 * a * path
                final = sqrt(x)
                law.add(place, speed, -a, (speed - final) / a)
                place, speed = span.end, final
                continue
            law.add(place, speed, -a, (speed - ceiling) / a)
            place, path, x, speed = place + down, path - down, most, ceiling
        bound = 0.0 if span.stop else min(most, bounds[i + 1])
        if x == bound == most > 0.0:
            law.add(place, speed, 0.0, path / speed)
            place = span.end
            continue
        twice = 2 * path
        final_x, peak_x = bound, most
        for rate, curvature in span.shares:
            share = twice * curvature
            reached = (x * rate + twice) / (rate + share)
            if reached < final_x:
                final_x = reached
        for rate, curvature in span.shares:
            reached = ((x + final_x) * rate + twice) / (2 * (rate + twice * curvature))
            if reached < peak_x:
                peak_x = reached
        peak_x = max(peak_x, x, final_x)
        peak, final = sqrt(peak_x), sqrt(final_x)
        a = max(_reserve(span.shares, peak_x), (2 * peak_x - x - final_x) / twice)
        if a > 0.0:
            rise, fall = (peak_x - x) / (2 * a), (peak_x - final_x) / (2 * a)
            law.add(place, speed, a, (peak - speed) / a)
            if peak > 0.0:
                law.add(place + rise, peak, 0.0, (path - rise - fall) / peak)
            law.add(span.end - fall, peak, -a, (peak - final) / a)
        else:
            law.add(place, peak, 0.0, path / peak)
        place, x, speed = span.end, final_x, final
        if span.stop and i < last:
            law.add(place, 0.0, 0.0, pause)
    law.place = place


def _reserve(shares: Shares, x: float) -> float:
    """Acceleration of the path that is left for a change of speed at the squared speed `x`."""
    least = inf
    for rate, curvature in shares:
        left = 1.0 - curvature * x
        if left < least * rate:
            least = left / rate
    return max(least, 0.0)


def brake(
    spans: Sequence[ProfileSegment], place: float, speed: float, factor: float = 1.0
) -> SpeedProfile:
    """Down to standstill on the path, with `factor` times the spans' accelerations."""
    law = SpeedProfile(place)
    x = speed * speed
    for span in spans:
        path = span.end - place
        if path <= 0.0:
            continue
        a = factor * _reserve(span.shares, x / factor)
        if x <= 2 * a * path:
            law.add(place, speed, -a, speed / a)
            return law
        x -= 2 * a * path
        final = sqrt(x)
        if a > 0.0:
            law.add(place, speed, -a, (speed - final) / a)
        else:
            law.add(place, speed, 0.0, path / speed)
        place, speed = span.end, final
        if span.stop:
            break
    law.place = place
    return law


def _index(spans: Sequence[ProfileSegment], span: ProfileSegment) -> int | None:
    """Where a span is among others; None: it is not."""
    return next((i for i, other in enumerate(spans) if other is span), None)


def _ahead(spans: Sequence[ProfileSegment], place: float) -> Sequence[ProfileSegment]:
    """From the span that contains a place on."""
    first = 0
    while first < len(spans) - 1 and spans[first].end <= place:
        first += 1
    return spans[first:] if first else spans


def _bound(
    spans: Sequence[ProfileSegment],
    place: float,
    bounds: list[float],
    known: tuple[Sequence[float], int, int] | None = None,
) -> int:
    """Find the largest squared speed at the start of each span (the first: at `place`).

    `known` are those of another path, where `spans` begin in it, and up to which of them both
    are the same. Returns the span at which both speeds are the same: those before it are, too.
    """
    after = 0.0
    other, skipped, same = known if known is not None else ((), 0, -1)
    for i in range(len(spans) - 1, -1, -1):
        span = spans[i]
        start = spans[i - 1].end if i else place
        twice = 2 * (span.end - (start if start > place else place))
        if twice < 0.0:
            twice = 0.0
        most = span.speed * span.speed
        after = 0.0 if span.stop else min(after, most)
        before = most
        for rate, curvature in span.shares:
            reached = (after * rate + twice) / (rate + twice * curvature)
            if reached < before:
                before = reached
        bounds[i] = after = before
        if i <= same and before == other[skipped + i]:
            return i
    return 0
