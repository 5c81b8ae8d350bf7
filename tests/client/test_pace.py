"""The speed of a driver's clock on a machine that is held up; `rapidgen.client.core.clock_rate`."""

import random

import pytest

from rapidgen.client.core.clock_rate import ClockRateEstimator


def rates_of(*reads):
    """Return the estimate after each read.

    A read is (s since the last one, states that arrived with it).
    """
    meter, now, number, rates = ClockRateEstimator(), 100.0, 0, []
    for step, count in reads:
        now += step
        for _ in range(count):
            number += 1
            meter.add_sample(now, number)
        rates.append(meter.rate)
    return rates


def even(period, count):
    return [(period, 1)] * count


def test_states_that_come_evenly_tell_it():
    rates = rates_of(*even(0.1, 20))
    assert rates[:5] == [None] * 5
    assert rates[5:] == pytest.approx([10.0] * 15)


@pytest.mark.parametrize("makes_up", [1, 57], ids=["time is lost", "time is made up for"])
def test_a_stall_among_the_first_states_is_not_the_clocks(makes_up):
    """Observed in CI: six states of a clock ten times as fast.

    0.57 s of the time was a stall.
    """
    rates = rates_of(*even(0.01, 2), (0.57, makes_up), *even(0.01, 30))
    known = [rate for rate in rates if rate is not None]
    assert rates[:7] == [None] * 7
    assert known == pytest.approx([100.0] * len(known))
    assert len(known) > 10


@pytest.mark.parametrize("makes_up", [(1,), (1, 56), (20, 37)])
def test_what_was_measured_counts_on_through_a_stall(makes_up):
    reads = [(0.57, makes_up[0]), *((0.001, count) for count in makes_up[1:])]
    rates = rates_of(*even(0.01, 16), *reads, *even(0.01, 30))
    assert rates[15:] == pytest.approx([100.0] * len(rates[15:]))


@pytest.mark.parametrize("pieces", [(10,), (5, 5), (1, 9), (8, 2), (7, 3)])
def test_clock_rate_after_delayed_tunnel_stays_real_time(pieces):
    """Its clock is not to seem faster: its robot would be left longer without a client."""
    stall = [(1.0, pieces[0]), *((0.001, count) for count in pieces[1:])]
    rates = rates_of(*even(0.1, 10), *stall, *even(0.1, 40))
    assert max(rate for rate in rates if rate is not None) * 0.1 < 1.2


def test_no_stall_of_a_tunnel_makes_a_controller_seem_a_simulation():
    """1.2 is where the client would give a simulation three times as long (`_SIMULATION`)."""
    for seed in range(1500):
        dice, meter, free = random.Random(seed), ClockRateEstimator(), 0.0
        stalls = [(dice.uniform(0, 6), dice.uniform(0.05, 1)) for _ in range(dice.randint(1, 3))]
        for number in range(1, 61):
            now = number * 0.1 + dice.uniform(0, 0.004)
            for begin, length in stalls:
                if begin <= now < begin + length:
                    now = begin + length
            free = max(now, free + dice.choice([0, 0.0005, 0.002]))
            meter.add_sample(free, number)
            assert (meter.rate or 0) * 0.1 <= 1.2, (seed, number)


def test_another_speed_is_measured_again():
    rates = rates_of(*even(0.1, 20), *even(0.02, 20))
    assert rates[-1] == pytest.approx(50.0)


def test_where_states_never_come_evenly_their_average_counts_in_the_end():
    rates = rates_of(*[*even(0.01, 3), (0.17, 1)] * 15)
    assert rates[38] is None
    assert rates[-1] == pytest.approx(20.0, rel=0.05)
