"""Jerk: how a law of phases of constant acceleration becomes one with ramps of acceleration.

The robot follows the mean of the planned law over the last `width` s. A mean of places on a path
lies on that path, so corners and stops stay where they are; speed and acceleration become
continuous whatever was planned anew in between; and acceleration changes at no more than its
range over `width` (jerk <= 2 a / width), from nothing to full in `width` s. The planned law is
ahead by half of it while speed is constant, and all of it at a standstill.
"""

from bisect import bisect_right
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

from rapidgen.motion.speed_profile import ProfileSegment, SpeedProfile

_ROUNDS = 60
_EXACT = 1e-11


def state(law: SpeedProfile, time: float, width: float) -> tuple[float, float]:
    """Mean place over the `width` s before a time, and the speed of that mean."""
    if width <= 0.0:
        return law.state(time)
    if time >= law.duration + width:
        return law.place, 0.0
    begin = time - width
    base = law.state(begin)[0]
    times, places, speeds, accelerations = law.phases
    area = 0.0
    if time > law.duration:
        area = (law.place - base) * (time - max(law.duration, begin))
        time = law.duration
    last = law.place if time >= law.duration else law.state(time)[0]
    i = bisect_right(times, time) - 1
    while i >= 0:
        low = max(begin, times[i]) - times[i]
        high = time - times[i]
        if high > low:
            area += (places[i] - base) * (high - low) + (
                speeds[i] / 2 * (high * high - low * low)
                + accelerations[i] / 6 * (high * high * high - low * low * low)
            )
        if times[i] <= begin:
            break
        time = times[i]
        i -= 1
    return base + area / width, (last - base) / width


def time_at(law: SpeedProfile, place: float, width: float) -> float:
    """When the mean reaches a place; the standstill for places that it does not reach."""
    first = law.time_at(place)
    if width <= 0.0:
        return first
    if place >= law.place:
        return law.duration + width if law.phases[0] else law.duration
    low, high = first, first + width
    if law.state(high)[0] - place <= _EXACT:
        return high  # the planned law waits there
    time = (low + high) / 2
    for _ in range(_ROUNDS):
        result, speed = state(law, time, width)
        error = result - place
        if abs(error) <= _EXACT:
            break
        if error > 0.0:
            high = time
        else:
            low = time
        step = time - error / speed if speed > 0.0 else low
        time = step if low < step < high else (low + high) / 2
        if high - low < _EXACT:
            break
    return time


@dataclass(slots=True)
class _Widened:
    """A span whose limits hold for all that the mean mixes into it."""

    end: float
    speed: float
    acceleration: float
    tcp: float
    stop: bool


def widened(spans: Sequence[ProfileSegment], start: float, radius: float) -> list[ProfileSegment]:
    """Spans in which every limit holds `radius` further on both sides.

    The mean of a law at a place mixes what was planned up to half its width before and behind
    (path speed is at most 1). At a stop the planned law waits, so nothing is mixed across it.
    `start` is where the first span begins.
    """
    result: list[ProfileSegment] = []
    first = 0
    for i, span in enumerate(spans):
        if span.stop or i == len(spans) - 1:
            result += _between_stops(spans[first : i + 1], start, radius)
            first, start = i + 1, span.end
    return result


def _between_stops(
    spans: Sequence[ProfileSegment], start: float, radius: float
) -> Sequence[ProfileSegment]:
    if len(spans) == 1:
        return spans
    # A slower neighbour reaches into a span; only there it has to be cut.
    cuts = []
    for a, b in pairwise(spans):
        if b.speed < a.speed or b.acceleration < a.acceleration or b.tcp > a.tcp:
            cuts.append(a.end - radius)
        if a.speed < b.speed or a.acceleration < b.acceleration or a.tcp > b.tcp:
            cuts.append(a.end + radius)
    if not cuts:
        return spans
    end = spans[-1].end
    cuts = sorted(cut for cut in cuts if start < cut < end)
    cuts.append(end)
    result: list[ProfileSegment] = []
    low, left = 0, start
    for right in cuts:
        if right - left < _EXACT and right < end:
            continue
        middle = (left + right) / 2
        while spans[low].end < middle - radius and low < len(spans) - 1:
            low += 1
        speed, acceleration, tcp = spans[low].speed, spans[low].acceleration, spans[low].tcp
        i = low
        while spans[i].end < middle + radius and i < len(spans) - 1:
            i += 1
            span = spans[i]
            if span.speed < speed:
                speed = span.speed
            if span.acceleration < acceleration:
                acceleration = span.acceleration
            if span.tcp > tcp:
                tcp = span.tcp
        result.append(_Widened(right, speed, acceleration, tcp, False))
        left = right
    last = result[-1]
    assert isinstance(last, _Widened)
    last.end, last.stop = end, spans[-1].stop
    return result
