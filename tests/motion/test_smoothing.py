"""Smoothing: the mean of a motion keeps limits, is smooth whatever was planned anew, and stops."""

import random

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from rapidgen.machine.scheduler import S
from rapidgen.motion import MotionSettings, smoothing
from rapidgen.motion.moves import JointMove, MoveSpeed
from rapidgen.motion.pieces import AxisLimits, joint_corner, joint_line
from rapidgen.motion.speed_profile import brake
from tests.motion.test_timelaw import Stretch, law_of, paths
from tools.motion_campaign import disturb

WIDTH = 0.05


LIMITS = AxisLimits((1.0, 1.5), (5.0, 8.0), 0.9)


@st.composite
def bent_paths(draw):
    """Lines of two axes, 0.2 to 1 s each, with parabolas of any size between them."""
    rates = [
        tuple(draw(st.floats(-0.9, 0.9)) for _ in range(2)) for _ in range(draw(st.integers(1, 5)))
    ]
    times = [draw(st.floats(0.2, 1.0)) for _ in rates]
    pieces, place, point, cut = [], 0.0, (0.0, 0.0), 0.0
    for i, (rate, time) in enumerate(zip(rates, times, strict=True)):
        line = place, point, rate
        target = tuple(q + r * time for q, r in zip(point, rate, strict=True))
        last = i == len(rates) - 1
        size = 0.0 if last else draw(st.floats(0.001, 0.5)) * min(time, times[i + 1])
        pieces.append(joint_line(place + cut, place + time - size, line, LIMITS, 0.0))
        if not last:
            pieces += joint_corner(
                place + time - size,
                target,
                (rate, size, 1.0),
                (rates[i + 1], size, 1.0),
                LIMITS,
                0.0,
            )
        place, point, cut = place + time, target, size
    return pieces, point


@settings(max_examples=100)
@given(bent_paths(), st.floats(0.01, 0.2))
def test_the_mean_keeps_every_limit(path, width):
    """Speeds, accelerations and jerk of the axes, from the start to the standstill."""
    pieces, rest = path
    law = law_of(pieces, 0.0, 0.0)
    count = 400
    step = (law.duration + width) / count
    times = [k * step for k in range(count)]
    axes = np.array([smoothing.posture(law, pieces, rest, t, width) for t in times])
    assert axes[0] == pytest.approx((0.0, 0.0), abs=1e-12)
    speeds = np.diff(axes, axis=0) / step
    accelerations = np.diff(speeds, axis=0) / step
    jerk = np.diff(accelerations, axis=0) / step
    assert (np.abs(speeds) <= np.array(LIMITS.speeds) * (1 + 1e-6)).all()
    allowed = np.array(LIMITS.accelerations((0.0, 0.0)))
    assert (np.abs(accelerations) <= allowed * (1 + 1e-4) + 1e-6).all()
    assert (np.abs(jerk) <= 2 * allowed / width * (1 + 1e-3) + 0.1).all()
    assert np.abs(axes[-1] - rest).max() <= 8.0 * step * step


@settings(max_examples=100)
@given(paths())
def test_it_stands_at_every_stop(spans):
    law = law_of(spans, 0.0, 0.0, 1.0, pause=WIDTH)
    for span in [s for s in spans if s.stop] + [spans[-1]]:
        time = smoothing.time_at(law, span.end, WIDTH)
        place, speed = smoothing.state(law, time, WIDTH)
        assert place == pytest.approx(span.end, abs=1e-9)
        assert speed == pytest.approx(0.0, abs=1e-6)


@settings(max_examples=100)
@given(paths(), st.floats(0, 1))
def test_time_at_is_the_inverse_of_state(spans, fraction):
    law = law_of(spans, 0.0, 0.0, 1.0, pause=WIDTH)
    place = fraction * law.place
    time = smoothing.time_at(law, place, WIDTH)
    assert smoothing.state(law, time, WIDTH)[0] == pytest.approx(place, abs=1e-9)


@settings(max_examples=100)
@given(paths(), st.floats(0, 1))
def test_what_was_planned_before_is_still_felt(spans, fraction):
    """Braking at any moment: place, speed and acceleration go on without a jump."""
    law = law_of(spans, 0.0, 0.0, 1.0, pause=WIDTH)
    now = fraction * law.duration
    place, speed = law.state(now)
    left = [s for s in spans if s.end > place] or [spans[-1]]
    halt = brake(left, place, speed).after(law, now, WIDTH)
    for early in (0.0, 0.3, 0.9, 0.99):
        time = early * WIDTH
        if now >= time:
            before = smoothing.state(law, now - time, WIDTH * (1 - early))
            after = smoothing.state(halt, -time, WIDTH * (1 - early))
            assert after == pytest.approx(before, abs=1e-6)
    assert smoothing.state(halt, 0.0, WIDTH) == pytest.approx(
        smoothing.state(law, now, WIDTH), abs=1e-9
    )
    end = smoothing.state(halt, halt.duration + WIDTH, WIDTH)
    assert end == (halt.place, 0.0)


def test_a_trapezoid_with_a_ramp():
    """One move in closed form: the ramp adds its length, and half of it before the middle."""
    law = law_of([Stretch(2.0, 1.0, 4.0)], 0.0, 0.0)
    assert smoothing.time_at(law, 2.0, WIDTH) == pytest.approx(2.25 + WIDTH)
    assert smoothing.time_at(law, 1.0, WIDTH) == pytest.approx((2.25 + WIDTH) / 2)
    assert smoothing.state(law, WIDTH, WIDTH) == pytest.approx((4 * WIDTH**2 / 6, 4 * WIDTH / 2))


@pytest.mark.parametrize("seed", range(12))
def test_acceleration_has_no_jump_on_straight_ways_whatever_happens(make_cell, zones, seed):
    """Stops, starts, overrides, new moves at random: jerk stays what the ramp allows.

    Fine points: inside a corner the parabola's own turning begins at once
    (docs/rapid/motion-model.md).
    """
    rng = random.Random(seed)
    cell = make_cell()
    acts = rng.randrange(2, 9)
    disturb(cell, rng, count=acts)

    def program(task):
        values = list(cell.group.positions())
        for _ in range(6):
            task.sleep(1e-3)
            values = [v + rng.gauss(0, 0.2) if i < 3 else v for i, v in enumerate(values)]
            values = [
                min(max(v, j.lower), j.upper)
                for v, j in zip(values, cell.config.joints, strict=True)
            ]
            cell.group.move(
                task, JointMove(target=tuple(values), speed=MoveSpeed(1.0), zone=zones(0))
            )

    task = cell.start(program)
    cell.sample(lambda: not task.alive and cell.scheduler.now > 4.1 * S, limit=90)
    jerk = np.abs(np.diff(cell.path, n=3, axis=0)) / 0.002**3
    allowed = np.array(
        [2 * j.acceleration / MotionSettings().ramp_time for j in cell.config.joints]
    )
    assert (jerk <= allowed * (1 + 1e-3) + 0.1).all()


@pytest.mark.parametrize("ramp", [0.0, 0.03, 0.1])
def test_the_programmed_time_is_exact_with_any_ramp(make_cell, joint, ramp):
    cell = make_cell(settings=MotionSettings(ramp_time=ramp))
    times = []

    def program(task):
        start = task.scheduler.now
        for degrees, z in ((10, 20), (22, 20), (33, 0), (20, 0)):
            cell.group.move(task, joint(degrees, z=z, time=0.6))
        times.append((task.scheduler.now - start) / S)

    cell.run(program)
    assert times[0] == pytest.approx(4 * 0.6, abs=1e-6)


def test_a_new_ramp_holds_from_the_next_standstill_on(cell, joint):
    def program(task):
        cell.group.move(task, joint(10, z=5, time=0.5))
        cell.group.modal.ramp = 0.1
        cell.group.move(task, joint(20, time=0.5))
        seen.append(cell.group.motion.ramp)
        cell.group.move(task, joint(0, time=2.0))
        seen.append(cell.group.motion.ramp)

    seen = []
    cell.run(program)
    ramp = MotionSettings().ramp_time
    assert seen == [pytest.approx(ramp), pytest.approx(10 * ramp)]


def test_the_mean_over_many_phases_is_that_of_the_phases():
    """From integrals where there are many; one by one the result is the same."""
    rng = random.Random(3)
    spans, end = [], 0.0
    for _ in range(300):
        end += rng.uniform(0.001, 0.004)
        spans.append(Stretch(end, rng.uniform(0.2, 1.0), rng.uniform(5.0, 50.0)))
    law = law_of(spans, 0.0, 0.0)
    for k in range(-2, 60):
        time = (law.duration + WIDTH) * k / 57
        parts = 2000
        places = [law.state(time - WIDTH * (j + 0.5) / parts)[0] for j in range(parts)]
        place, speed = smoothing.state(law, time, WIDTH)
        assert place == pytest.approx(sum(places) / parts, abs=1e-8)
        step = (law.state(time)[0] - law.state(time - WIDTH)[0]) / WIDTH
        assert speed == pytest.approx(step, abs=1e-9)
