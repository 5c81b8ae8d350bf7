"""The law of guided axes against its differential equation.

Source: manual 3HAC073318 2.3 and 2.5: the speed is gain * (reference - position) + speed reference,
behind a low pass of first order.
"""

from math import exp, pi

import pytest

from rapidgen.motion.egm.law import CYCLE, Brake, Law, Line, Return, braking_time


def run(law, reference, speeds, cycles):
    for _ in range(cycles):
        law.accept(*law.propose(reference, speeds))
    return law.positions[0]


def integrated(gain, bandwidth, reference, rate, time):
    """x' = v, v' = 2 pi f (gain (r - x) + rate - v) in small steps (midpoint rule)."""
    x = v = 0.0
    step = 1e-5

    def slope(x, v):
        return v, 2 * pi * bandwidth * (gain * (reference - x) + rate - v)

    for _ in range(round(time / step)):
        a, b = slope(x, v)
        a, b = slope(x + a * step / 2, v + b * step / 2)
        x, v = x + a * step, v + b * step
    return x


@pytest.mark.parametrize(
    ("gain", "bandwidth", "rate"),
    [
        (5.0, 20.0, 0.0),  # two real rates
        (20.0, 5.0, 0.0),  # complex: it overshoots
        (pi / 2, 1.0, 0.0),  # equal rates
        (5.0, 20.0, 0.3),
        (0.0, 20.0, 0.3),  # speed control alone
    ],
)
def test_step_of_the_reference(gain, bandwidth, rate):
    law = Law((0.0,), gain, bandwidth)
    assert run(law, (0.1,), (rate,), 100) == pytest.approx(
        integrated(gain, bandwidth, 0.1, rate, 0.4), abs=1e-6
    )


def test_without_a_low_pass():
    law = Law((0.0,), 5.0, 0.0)
    assert run(law, (0.1,), (0.0,), 50) == pytest.approx(0.1 * (1 - exp(-5.0 * 0.2)), abs=1e-12)
    assert run(Law((0.0,), 0.0, 0.0), (9.9,), (0.5,), 50) == pytest.approx(0.1)


def test_ramp_in_begins_slowly():
    first = Law((0.0,), 5.0, 20.0, ramp_in=0.5).propose((0.1,), (0.0,))[0][0]
    whole = Law((0.0,), 5.0, 20.0).propose((0.1,), (0.0,))[0][0]
    assert 0 < first < whole / 100


def test_brake_and_return():
    brake = Brake((0.0,), (0.2,), 0.5)
    positions = [brake.advance(CYCLE)[0] for _ in range(125)]
    assert brake.done
    assert positions[-1] == pytest.approx(0.2 * 0.5 / 2)
    assert positions == sorted(positions)
    brake = Brake((0.1,), (0.2,), 0.1)
    back = Return(brake, Line(brake.end(), (0.0,), 0.4))
    while not back.done:
        last = back.advance(CYCLE)
    assert last == (0.0,)


def test_braking_time_keeps_room():
    assert braking_time((1.0,), [(9.0, 0.05)], 0.5) == pytest.approx(0.1)
    assert braking_time((-1.0,), [(9.0, 0.05)], 0.5) == 0.5
    assert braking_time((1.0,), [(9.0, 0.0)], 0.5) == CYCLE
