"""When the robot is where on its path: speed profiles in closed form.

A path has one coordinate, its *nominal time* in s: at speed 1 everything moves as programmed.
A speed profile is a chain of phases of constant acceleration of that coordinate, so its state at
any time, and the time of any place, are formulas and no integration step exists.

Every axis divides its acceleration between the curvature of the path and the change of speed. With
its rate r and its curvature c along the path, |r s\" + c s'^2| <= a has to hold. A span states this
as shares (R, C) = (r/a, c/a): R |s\"| + C s'^2 <= 1. Over a span of length L that is linear in the
square of the speed, x = s'^2: from x0 at one end, x1 <= (x0 R + 2 L) / (R + 2 L C) at the other.
One pass backwards gives the largest speed at the beginning of each span from which all later
limits can be kept, one pass forwards the profile.
"""

from bisect import bisect_left, bisect_right
from collections.abc import Sequence
from math import inf, sqrt
from typing import Protocol

_TOLERANCE = 1e-7
Shares = tuple[tuple[float, float], ...]
"""(R, C) of the axes that may limit a span."""


class ProfileSegment(Protocol):
    """A stretch of path with constant limits; `stop` asks for standstill at its end.

    `tcp` is the TCP's way in m per nominal s (0 where it is not known)."""

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

    __slots__ = ("_accelerations", "_places", "_speeds", "_times", "duration", "place")

    def __init__(self, place: float) -> None:
        self._times: list[float] = []
        self._places: list[float] = []
        self._speeds: list[float] = []
        self._accelerations: list[float] = []
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
        return chain

    def _take(self, law: "SpeedProfile", phases: slice, offset: float) -> None:
        self._times += [t + offset for t in law._times[phases]]
        self._places += law._places[phases]
        self._speeds += law._speeds[phases]
        self._accelerations += law._accelerations[phases]

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


def plan(
    spans: Sequence[ProfileSegment],
    place: float,
    speed: float,
    cap: float = 1.0,
    tcp_limit: float = inf,
    pause: float = 0.0,
    wait: float = 0.0,
) -> SpeedProfile | None:
    """The fastest law from a state to standstill at the end of the last span.

    Spans behind `place` do not count. `cap` (share of the programmed speed) and `tcp_limit` (m/s)
    are ceilings that
    may be below `speed`: then the law comes down to them. At stops on the way it waits `pause` s,
    before it begins `wait` s. None: from this state the limits of a later span cannot be kept.
    """
    spans = _ahead(spans, place)
    bounds = _entry_bounds(spans, place)
    x = speed * speed
    if x > bounds[0]:
        if speed > sqrt(bounds[0]) * (1 + _TOLERANCE) + _TOLERANCE:
            return None
        x = bounds[0]
        speed = sqrt(x)
    law = SpeedProfile(place)
    law.add(place, speed, 0.0, wait)
    last = len(spans) - 1
    for i, span in enumerate(spans):
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
    return law


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


def _ahead(spans: Sequence[ProfileSegment], place: float) -> Sequence[ProfileSegment]:
    """From the span that contains a place on."""
    first = 0
    while first < len(spans) - 1 and spans[first].end <= place:
        first += 1
    return spans[first:] if first else spans


def _entry_bounds(spans: Sequence[ProfileSegment], place: float) -> list[float]:
    """Largest squared speed at the start of each span (the first: at `place`) that can be kept."""
    bounds = [0.0] * (len(spans) + 1)
    after = 0.0
    for i in range(len(spans) - 1, -1, -1):
        span = spans[i]
        start = spans[i - 1].end if i else place
        twice = 2 * max(0.0, span.end - max(start, place))
        most = span.speed * span.speed
        after = 0.0 if span.stop else min(after, most)
        before = most
        for rate, curvature in span.shares:
            reached = (after * rate + twice) / (rate + twice * curvature)
            if reached < before:
                before = reached
        bounds[i] = after = before
    return bounds
