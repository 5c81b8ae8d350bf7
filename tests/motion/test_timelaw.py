"""Speed profiles by property."""

from dataclasses import dataclass

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from rapidgen.motion.speed_profile import SpeedProfile, brake, plan


def law_of(*state, **settings):
    """The law of a plan; None where there is none."""
    result = plan(*state, **settings)
    return None if result is None else result.law


@dataclass(frozen=True)
class Stretch:
    end: float
    speed: float
    acceleration: float
    tcp: float = 0.0
    stop: bool = False
    curvature: float = 0.0
    programmed: float = 1.0

    @property
    def shares(self):
        return ((1 / self.acceleration, self.curvature),)


@st.composite
def paths(draw):
    end, spans = 0.0, []
    for _ in range(draw(st.integers(1, 8))):
        end += draw(st.floats(1e-3, 2.0))
        speed, acceleration = draw(st.floats(0.02, 1.0)), draw(st.floats(0.1, 50.0))
        spans.append(Stretch(end, speed, acceleration, draw(st.floats(0, 2)), draw(st.booleans())))
    return spans


def span_at(spans, place):
    return next((s for s in spans if place <= s.end), spans[-1])


def check(law, spans, start, ceiling=1.0):
    """Continuity, limits and standstill by looking closely."""
    count = 400
    step = law.duration / count
    before = law.state(0.0)
    assert before[0] == pytest.approx(start)
    for k in range(1, count + 1):
        place, speed = law.state(k * step)
        assert place >= before[0] - 1e-9
        path = place - before[0]
        assert abs(path - (speed + before[1]) / 2 * step) <= 60 * step * step + 1e-9
        hardest = max(s.acceleration for s in spans)
        assert abs(speed - before[1]) <= hardest * step + 1e-6
        span = span_at(spans, place)
        if place < span.end - 1e-6 and place > start + 1e-6:
            assert speed <= min(span.speed, ceiling) * (1 + 1e-6) + 1e-9
        before = place, speed
    assert law.state(law.duration)[1] == 0.0
    assert law.state(law.duration + 1) == (law.place, 0.0)


@settings(max_examples=150)
@given(paths(), st.floats(0.05, 1.0))
def test_a_plan_keeps_the_limits_and_ends_at_the_end(spans, cap):
    law = law_of(spans, 0.0, 0.0, cap)
    assert law is not None
    check(law, spans, 0.0, cap)
    assert law.place == spans[-1].end


@settings(max_examples=150)
@given(paths(), st.floats(0, 1), st.floats(0.05, 1.0))
def test_replanning_under_way_is_always_possible_and_keeps_the_end(spans, fraction, cap):
    first = law_of(spans, 0.0, 0.0)
    place, speed = first.state(fraction * first.duration)
    left = [s for s in spans if s.end > place]
    if left:
        again = law_of(left, place, speed, 1.0)
        assert again is not None
        assert again.duration == pytest.approx((1 - fraction) * first.duration, abs=1e-6)
        slower = law_of(left, place, speed, cap)
        assert slower.place == spans[-1].end
        assert slower.duration >= again.duration - 1e-6


@settings(max_examples=150)
@given(paths(), st.floats(0, 1))
def test_braking_ends_on_the_path_and_never_speeds_up(spans, fraction):
    law = law_of(spans, 0.0, 0.0)
    place, speed = law.state(fraction * law.duration)
    left = [s for s in spans if s.end > place] or [spans[-1]]
    halt = brake(left, place, speed)
    assert place - 1e-12 <= halt.place <= spans[-1].end + 1e-9
    check(halt, left, place)
    states = [halt.state(halt.duration * k / 50)[1] for k in range(51)]
    assert states == sorted(states, reverse=True)
    quick = brake(left, place, speed, 2.0)
    assert quick.place <= halt.place + 1e-12


@settings(max_examples=150)
@given(paths(), st.floats(0, 1))
def test_time_at_is_the_inverse_of_state(spans, fraction):
    law = law_of(spans, 0.0, 0.0)
    place = fraction * law.place
    assert law.state(law.time_at(place))[0] == pytest.approx(place, abs=1e-9)


def test_a_trapezoid_in_closed_form():
    law = law_of([Stretch(2.0, 1.0, 4.0)], 0.0, 0.0)
    assert law.duration == pytest.approx(2.0 + 1.0 / 4.0)
    assert law.last_braking() == pytest.approx(law.duration - 0.25)
    assert law.state(1.0) == pytest.approx((0.875, 1.0))


def test_the_tcp_limit_acts_where_the_tcp_moves():
    law = law_of([Stretch(1.0, 1.0, 100.0, tcp=0.5)], 0.0, 0.0, 1.0, tcp_limit=0.25)
    assert law.state(law.duration / 2)[1] == pytest.approx(0.5)


def test_too_fast_for_what_comes_is_no_plan():
    assert law_of([Stretch(0.1, 1.0, 1.0), Stretch(1.0, 0.1, 1.0)], 0.0, 1.0) is None


def test_one_law_after_the_other():
    first, second = SpeedProfile(0.0), SpeedProfile(1.0)
    first.add(0.0, 1.0, 0.0, 1.0)
    second.add(1.0, 0.5, 0.0, 2.0)
    chain = first.then(second)
    assert chain.duration == pytest.approx(3.0)
    assert chain.state(2.0) == pytest.approx((1.5, 0.5))


@st.composite
def bent_paths(draw):
    """Spans in which two axes divide their accelerations between curvature and speed."""
    end, spans = 0.0, []
    for _ in range(draw(st.integers(1, 12))):
        end += draw(st.floats(1e-3, 0.5))
        shares = tuple(
            (1 / draw(st.floats(0.5, 50.0)), draw(st.floats(0.0, 40.0))) for _ in range(2)
        )
        most = max(curvature for _, curvature in shares)
        speed = min(draw(st.floats(0.1, 1.0)), (0.9 / most) ** 0.5 if most else 1.0)
        spans.append(Bend(end, speed, shares))
    return spans


@dataclass(frozen=True)
class Bend:
    end: float
    speed: float
    shares: tuple[tuple[float, float], ...]
    tcp: float = 0.0
    stop: bool = False
    programmed: float = 1.0


def used(law, spans):
    """The largest share of an acceleration that a profile needs, by its phases."""
    most = 0.0
    ends = [*law.phases[0], law.duration]
    for start, place, speed, acceleration, then in zip(*law.phases, ends[1:], strict=True):
        final = speed + acceleration * (then - start)
        span = span_at(spans, place + 1e-9)
        fastest = max(speed, final) ** 2
        for rate, curvature in span.shares:
            most = max(most, rate * abs(acceleration) + curvature * fastest)
    return most


@settings(max_examples=150)
@given(bent_paths())
def test_curvature_and_speed_share_the_acceleration(spans):
    law = law_of(spans, 0.0, 0.0)
    assert law.place == spans[-1].end
    assert used(law, spans) <= 1 + 1e-6


@settings(max_examples=100)
@given(bent_paths(), st.floats(0, 1))
def test_a_plan_can_be_renewed_anywhere_on_a_bent_path(spans, fraction):
    law = law_of(spans, 0.0, 0.0)
    place, speed = law.state(fraction * law.duration)
    left = [s for s in spans if s.end > place]
    if left:
        again = law_of(left, place, speed)
        assert again is not None
        assert again.duration <= (1 - fraction) * law.duration + 1e-6
        halt = brake(left, place, speed)
        assert used(halt, left) <= 1 + 1e-6


@dataclass(frozen=True)
class Placed(Bend):
    start: float = 0.0


@settings(max_examples=150)
@given(bent_paths(), st.floats(0.0, 1.0), st.integers(1, 8))
def test_a_plan_that_is_extended_is_that_of_the_whole_path(bends, part, kept):
    """As if all spans had been known at the beginning; its own past stays."""
    starts = [0.0, *(bend.end for bend in bends)]
    spans = [
        Placed(b.end, b.speed, b.shares, start=start)
        for b, start in zip(bends, starts, strict=False)
    ]
    usual = 1.0, float("inf"), 0.0
    first, whole = plan(spans[:kept], 0.0, 0.0, *usual), plan(spans, 0.0, 0.0, *usual)
    now = part * first.law.duration
    extended = first.extended(spans, now, 0.05, usual)
    if extended is None:
        return
    assert extended.law.duration == pytest.approx(whole.law.duration, abs=1e-9)
    for k in range(21):
        time = k / 20 * whole.law.duration
        assert extended.law.state(time) == pytest.approx(whole.law.state(time), abs=1e-6)
        assert extended.law.state(now * k / 20) == pytest.approx(first.law.state(now * k / 20))
