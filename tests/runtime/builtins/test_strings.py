"""Strings and conversions.

Sources: the S4 reference's page of each name [manual].
"""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rapidgen.rapid.numbers import number_text, single
from rapidgen.rapid.switches import Switches
from rapidgen.runtime.errors import RapidError
from rapidgen.runtime.text import (
    NotALiteral,
    literal_text,
    parse_value,
    value_text,
)
from rapidgen.runtime.values import BOOL, DNUM, NUM, STRING, Orient, Pos, Pose, RobTarget


@pytest.mark.parametrize(
    ("value", "text"),
    [
        (23, "23"),
        (1.141367, "1.14137"),
        (1.234567, "1.23457"),
        (0.5, "0.5"),
        (4.999998, "5"),  # a fraction above 0.999995 makes it whole
        (7.000004, "7"),  # so does one below 0.000005
        (-0.25, "-0.25"),
        (0.000004, "0"),
        (0.00001, "1E-05"),  # [mem]
        (-0.0, "0"),
        (100000, "100000"),
        (9e9, "9E+09"),  # [mem]
        (1e10, "1E+10"),  # [mem]
    ],
)
def test_standard_format_of_a_num(value, text):
    """S4 ValToStr, TPWrite, Write: one rule for all."""
    assert number_text(single(value)) == text


def test_val_to_str_of_everything(bench):
    pose = Pose(Pos(1817.3, 905.17, 879.11), Orient(0.96593, 0, 0.25882, 0))
    cases = {
        "[1817.3,905.17,879.11]": bench.box(pose.trans, Pos.rapid_type),
        "[[1817.3,905.17,879.11],[0.96593,0,0.25882,0]]": bench.box(pose, Pose.rapid_type),
        "TRUE": bench.box(True),
        '"hello"': bench.box("hello"),
        "[1,2.5]": bench.box({1: 1, 2: 2.5}, NUM, (2,)),
        "0.123456789012345": bench.dnum(0.123456789012345),
        "16777217": bench.dnum(16777217),
    }
    for text, value in cases.items():
        assert bench("ValToStr", value) == text


def test_val_to_str_over_80_characters(bench):
    value = bench.box({i: 123.456 for i in range(1, 13)}, NUM, (12,))
    with pytest.raises(RapidError) as caught:
        bench("ValToStr", value)
    assert caught.value.name == "ERR_STRTOOLNG"


def test_long_numbers_have_exact_text(bench):
    assert bench("NumToStr", single(3e38), 2).startswith("3")
    assert bench("NumToStr", single(3e38), 2, Exp=True) == "3.00E+38"


@pytest.mark.parametrize(
    ("text", "type_", "expected"),
    [
        ("3.85", NUM, single(3.85)),
        (" -2.5E-3 ", NUM, single(-0.0025)),
        (".5", NUM, 0.5),
        ("TRUE", BOOL, True),
        ("true", BOOL, True),  # a reserved word, in any case [K §2.3, 2.6]
        ('"a""b"', STRING, 'a"b'),
        ("0.1", DNUM, 0.1),
        ("[1,2,3]", Pos.rapid_type, Pos(1, 2, 3)),
        (" [ 1 , 2 , 3 ] ", Pos.rapid_type, Pos(1, 2, 3)),
    ],
)
def test_str_to_val(bench, text, type_, expected):
    target = bench.box(type_.default(), type_)
    assert bench("StrToVal", text, target) is True
    assert target.get() == expected


@pytest.mark.parametrize(
    ("text", "type_"),
    [
        ("", NUM),
        ("12abc", NUM),
        ("1e39", NUM),
        ("[1,2]", Pos.rapid_type),
        ("[1,2,3,4]", Pos.rapid_type),
        ("[1,2,TRUE]", Pos.rapid_type),
        ("hello", STRING),
        ("truee", BOOL),
        ("1 2", NUM),
        ("nan", NUM),
        ("[", Pos.rapid_type),
    ],
)
def test_failed_str_to_val_keeps_target(bench, text, type_):
    """FALSE, no error, and the target is as it was [S4 StrToVal]."""
    target = bench.box(type_.default(), type_)
    assert bench("StrToVal", text, target) is False
    assert target.get() == type_.default()


def test_str_to_val_of_an_array(bench):
    target = bench.box({1: 0, 2: 0}, NUM, (2,))
    assert bench("StrToVal", "[1.5,2]", target)
    assert target.get() == {1: 1.5, 2: 2}
    assert not bench("StrToVal", "[1,2,3]", target)


@given(
    st.builds(
        RobTarget,
        st.builds(Pos, *[st.integers(-99999, 99999)] * 3),
        st.builds(Orient, *[st.sampled_from([-1, -0.5, 0, 0.5, 1])] * 4),
    )
)
def test_text_of_a_record_reads_back(target):
    assert parse_value(value_text(target), RobTarget.rapid_type) == target


@given(st.text(st.characters(max_codepoint=255), max_size=30))
def test_text_of_a_string_reads_back(text):
    assert parse_value(value_text(text), STRING) == text


@given(st.floats(width=32, allow_nan=False, allow_infinity=False))
def test_a_saved_num_is_exactly_the_same_num(value):
    assert parse_value(literal_text(single(value), NUM), NUM) == single(value)


@given(st.floats(allow_nan=False, allow_infinity=False))
def test_a_saved_dnum_is_exactly_the_same_dnum(value):
    assert parse_value(literal_text(value, DNUM), DNUM) == value


@given(st.text(max_size=40))
def test_no_text_breaks_the_reader(text):
    for type_ in (NUM, BOOL, STRING, Pos.rapid_type):
        try:
            parse_value(text, type_)
        except NotALiteral:
            continue


# -- built-ins that compiled text does not call: it has code of its own for them ------------------


def test_str_part(bench):
    assert bench("StrPart", "Robotics", 1, 5) == "Robot"
    assert bench("StrPart", "Robotics", 8, 1) == "s"
    assert bench("StrPart", "Robotics", 3, 0) == ""


@pytest.mark.parametrize(("position", "length"), [(0, 1), (9, 1), (8, 2), (1, -1), (1.5, 1)])
def test_str_part_outside(bench, position, length):
    with pytest.raises(RapidError) as caught:
        bench("StrPart", "Robotics", position, length)
    assert caught.value.name == "ERR_OUTOFBND"


def test_str_find_and_match(bench):
    """No match is length + 1, an outside position an error.

    Source: [S4 StrFind, StrMatch]. Machina's driver [code] searches its next word right after the
    last one.
    """
    assert bench("StrFind", "Robotics", 1, "aeiou") == 2
    assert bench("StrFind", "Robotics", 1, "aeiou", NotInSet=True) == 1
    assert bench("StrFind", "Robotics", 2, "aeiou") == 2
    assert bench("StrFind", "Robotics", 8, "s") == 8
    assert bench("StrMatch", "Robotics", 3, "bo") == 3
    assert bench("StrFind", "Robotics", 3, "xyz") == 9
    assert bench("StrMatch", "Robotics", 1, "bo") == 3
    assert bench("StrMatch", "Robotics", 1, "BO") == 9
    assert bench("StrMatch", "Robotics", 4, "bo") == 9
    for name in ("StrFind", "StrMatch"):
        assert bench(name, "Robotics", 9, "x") == 9
        assert bench(name, "", 1, "x") == 1
        for place in (0, 10, 1.5):
            with pytest.raises(RapidError):
                bench(name, "Robotics", place, "x")


def test_search_past_end_is_error_by_switch(bench):
    bench.controller.dialect = Switches(find_past_end="error")
    for name in ("StrFind", "StrMatch"):
        with pytest.raises(RapidError):
            bench(name, "Robotics", 9, "x")
