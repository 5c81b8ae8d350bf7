"""Numbers. Sources: the S4 reference's page of each name [manual]."""

import math

import pytest

from rapidgen.rapid.numbers import single
from rapidgen.runtime.errors import RapidError


@pytest.mark.parametrize(
    ("name", "arguments", "result"),
    [
        ("Sin", (30,), 0.5),
        ("Cos", (60,), 0.5),
        ("Tan", (45,), 1),
        ("ASin", (1,), 90),
        ("ACos", (-1,), 180),
        ("ATan", (1,), 45),
        ("ATan2", (1, -1), 135),
        ("ATan2", (-1, -1), -135),
        ("Pow", (2, 10), 1024),
        ("Pow", (-2, 3), -8),
        ("Sqrt", (2,), math.sqrt(2)),
        ("Exp", (1,), math.e),
        ("Abs", (-3,), 3),
        ("Max", (1, 2), 2),
        ("Min", (1, 2), 1),
    ],
)
def test_functions_work_in_degrees_and_give_a_num(bench, name, arguments, result):
    got = bench(name, *arguments)
    assert got == pytest.approx(result, rel=1e-6)
    assert got == single(got)


def test_dnum_twins_keep_their_digits(bench):
    assert bench("SqrtDnum", 2) == math.sqrt(2)
    assert bench("Sqrt", 2) != math.sqrt(2)


@pytest.mark.parametrize(
    ("name", "arguments"),
    [
        ("Sqrt", (-1,)),
        ("ASin", (1.001,)),
        ("ACos", (-1.001,)),
        ("Pow", (-2, 0.5)),
        ("Pow", (0, 0)),  # base 0 with an exponent of 0 or less is an error
        ("Pow", (0, -1)),
        ("Round", (1, -1)),
    ],
)
def test_invalid_arguments_raise_error(bench, name, arguments):
    options = {"Dec": arguments[1]} if name == "Round" else {}
    required = arguments[:1] if name == "Round" else arguments
    with pytest.raises(RapidError) as caught:
        bench(name, *required, **options)
    assert caught.value.name == "ERR_ARGVALERR"


def test_round_and_trunc(bench):
    assert bench("Round", single(0.38521), Dec=1) == single(0.4)
    assert bench("Trunc", single(0.38521), Dec=1) == single(0.3)
    assert [bench("Round", v) for v in (0.5, 1.5, -0.5, 2.4)] == [1, 2, -1, 2]
    assert [bench("Trunc", v) for v in (1.9, -1.9)] == [1, -1]


def test_counters_change_their_argument(bench):
    value = bench.box(5)
    bench("Incr", value)
    bench("Add", value, -3)
    bench("Decr", value)
    assert value.get() == 2
    bench("Clear", value)
    assert value.get() == 0


def test_num_and_dnum(bench):
    assert bench("NumToDnum", single(0.1)) == single(0.1)
    assert bench("DnumToNum", 0.1) == single(0.1)
    for value, options, error in (
        (1.5, {"Integer": True}, "ERR_INT_NOTVAL"),
        (8_388_609, {"Integer": True}, "ERR_INT_MAXVAL"),
        (1e300, {}, "ERR_ARGVALERR"),
    ):
        with pytest.raises(RapidError) as caught:
            bench("DnumToNum", value, **options)
        assert caught.value.name == error
    assert bench("DnumToNum", 8_388_608, Integer=True) == 8_388_608
