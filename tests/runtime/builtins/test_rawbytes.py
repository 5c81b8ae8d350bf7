"""Raw bytes. Sources: 3HAC16581-1 [manual], abb_driver [code]."""

import pytest

from rapidgen.rapid.switches import Switches
from rapidgen.runtime.errors import FatalError, RapidError
from rapidgen.runtime.rawbytes import RawBytes

USINT, UINT, UDINT, ULINT, SINT, INT, DINT, LINT = 1, 2, 4, 8, -1, -2, -4, -8


def pack(bench, raw, value, start, type_=None, **options):
    bench("PackRawBytes", bench.box(value, type_), raw, start, **options)


@pytest.mark.parametrize(
    ("value", "options", "expected"),
    [
        (1, {"IntX": DINT}, "01000000"),
        (-2, {"IntX": DINT}, "feffffff"),
        (4294967295, {"IntX": UDINT}, "ffffffff"),
        (258, {"IntX": UINT}, "0201"),
        (258, {"IntX": UINT, "Network": True}, "0102"),
        (-1, {"IntX": SINT}, "ff"),
        (-1, {"IntX": LINT}, "ff" * 8),
        (1.5, {"Float4": True}, "0000c03f"),
        (1.5, {"Float4": True, "Network": True}, "3fc00000"),
        (31, {"Hex1": True}, "1f"),
        ("AB", {"ASCII": True}, "4142"),
        (65, {"ASCII": True}, "41"),
    ],
)
def test_packing(bench, value, options, expected):
    raw = RawBytes()
    pack(bench, raw, value, 1, **options)
    assert raw.data.hex() == expected


def test_valid_length_grows_with_bytes_beyond_end(bench):
    raw = RawBytes()
    pack(bench, raw, 1, 5, IntX=DINT)
    assert bench("RawBytesLen", raw) == 8
    assert raw.data[:4] == bytes(4)
    pack(bench, raw, 2, 1, IntX=DINT)
    assert bench("RawBytesLen", raw) == 8


@pytest.mark.parametrize(
    ("value", "start", "options", "error"),
    [
        (1.5, 1, {"IntX": DINT}, "ERR_INT_NOTVAL"),
        (256, 1, {"IntX": USINT}, "ERR_ARGVALERR"),
        (-1, 1, {"IntX": UDINT}, "ERR_ARGVALERR"),
        (256, 1, {"Hex1": True}, "ERR_ARGVALERR"),
        (1, 0, {"IntX": DINT}, "ERR_OUTOFBND"),
        (1, 1022, {"IntX": DINT}, "ERR_OUTOFBND"),
        (1, 1.5, {"IntX": DINT}, "ERR_OUTOFBND"),
        ("", 1, {"ASCII": True}, "ERR_ARGVALERR"),
        ("x", 1, {"IntX": DINT}, "ERR_ARGVALERR"),
        (1, 1, {"IntX": 3}, "ERR_ARGVALERR"),
    ],
)
def test_invalid_packing_raises_error(bench, value, start, options, error):
    raw = RawBytes(b"keep")
    with pytest.raises(RapidError) as caught:
        pack(bench, raw, value, start, **options)
    assert caught.value.name == error
    assert raw.data == b"keep"


def test_a_format_is_mandatory(bench):
    with pytest.raises(FatalError):
        pack(bench, RawBytes(), 1, 1)


def test_the_last_byte_can_be_used(bench):
    raw = RawBytes()
    pack(bench, raw, 1, 1021, IntX=DINT)
    assert bench("RawBytesLen", raw) == 1024


@pytest.mark.parametrize(
    ("data", "options", "value"),
    [
        ("feffffff", {"IntX": DINT}, -2),
        ("feffffff", {"IntX": UDINT}, 4294967296),  # a num rounds 4294967294
        ("0102", {"IntX": UINT, "Network": True}, 258),
        ("0000c03f", {"Float4": True}, 1.5),
        ("ff", {"Hex1": True}, 255),
        ("41", {"ASCII": 1}, 65),
    ],
)
def test_unpacking_into_a_num(bench, data, options, value):
    target = bench.box(0)
    bench("UnpackRawBytes", RawBytes(bytes.fromhex(data)), 1, target, **options)
    assert target.get() == value


def test_unpacking_into_a_dnum_is_exact(bench):
    target = bench.dnum(0)
    bench("UnpackRawBytes", RawBytes(b"\xfe\xff\xff\xff"), 1, target, IntX=UDINT)
    assert target.get() == 4294967294


def test_unpacking_text(bench):
    target = bench.box("")
    bench("UnpackRawBytes", RawBytes(b"xhello"), 2, target, ASCII=5)
    assert target.get() == "hello"


@pytest.mark.parametrize(
    ("switch", "result"), [("exact", 64 + (11 << 32)), ("single", 11 << 32), ("error", None)]
)
def test_a_ulint_in_all_dialects(bench, switch, result):
    """3HAC16581-1 lists ULINT with a dnum; no source says if it is exact."""
    bench.controller.dialect = Switches(unpack_ulint=switch)
    target = bench.dnum(5)
    raw = RawBytes(bytes([64, 0, 0, 0, 11, 0, 0, 0]))
    if result is None:
        with pytest.raises(RapidError):
            bench("UnpackRawBytes", raw, 1, target, IntX=ULINT)
    else:
        bench("UnpackRawBytes", raw, 1, target, IntX=ULINT)
        assert target.get() == result
    # Other types are as they are.
    bench("UnpackRawBytes", raw, 5, target, IntX=DINT)
    assert target.get() == 11


def test_copying_out_of_an_empty_container(bench):
    """abb_driver copies an empty body behind the header of a reply [code]."""
    target = RawBytes(bytes(16))
    bench("CopyRawBytes", RawBytes(), 1, target, 17)
    assert len(target.data) == 16
    bench("CopyRawBytes", RawBytes(bytes(12)), 13, target, 1)
    assert target.data == bytes(16)


def test_copying(bench):
    target = RawBytes()
    bench("CopyRawBytes", RawBytes(b"abcdef"), 3, target, 2, NoOfBytes=2)
    assert target.data == b"\0cd"
    bench("CopyRawBytes", RawBytes(bytes(1024)), 1, target, 1000)
    assert len(target.data) == 1024
    with pytest.raises(RapidError):
        bench("CopyRawBytes", RawBytes(b"abc"), 2, target, 1, NoOfBytes=3)


def test_clearing(bench):
    raw = RawBytes(b"abcdef")
    bench("ClearRawBytes", raw, FromIndex=3)
    assert raw.data == b"ab"
    bench("ClearRawBytes", raw)
    assert raw.data == b""


def test_bits(bench):
    assert bench("BitAnd", 12, 10) == 8
    assert bench("BitOr", 12, 10) == 14
    assert bench("BitXOr", 12, 10) == 6
    assert bench("BitNeg", 1) == 254
    assert bench("BitLSh", 129, 1) == 2
    assert bench("BitRSh", 129, 1) == 64
    assert bench("BitCheck", 128, 8) is True
    assert bench("BitCheckDnum", 2**51, 52) is True
    assert bench("BitNegDnum", 0) == 2**52 - 1
    assert bench("BitNegDnum", 5, Size=4) == 10  # \\Size: 3HAC050917 [manual]
    assert bench("BitLShDnum", 12, 1, Size=4) == 8
    assert bench("BitLShDnum", 12, 1) == 24
    value, large = bench.box(0), bench.dnum(0)
    bench("BitSet", value, 8)
    bench("BitSet", DnumData=large, BitData=None, BitPos=52)
    assert (value.get(), large.get()) == (128, 2**51)
    bench("BitClear", value, 8)
    assert value.get() == 0
    for name, args in (("BitCheck", (1, 9)), ("BitAnd", (256, 1)), ("BitNeg", (1.5,))):
        with pytest.raises(RapidError) as caught:
            bench(name, *args)
        assert caught.value.name == "ERR_ARGVALERR"
    for value_too_large in ("BitNegDnum", "BitLShDnum"):
        steps = (1,) if value_too_large == "BitLShDnum" else ()
        with pytest.raises(RapidError) as caught:
            bench(value_too_large, 16, *steps, Size=4)
        assert caught.value.name == "ERR_ARGVALERR"


def test_no_characters_are_an_empty_string(bench):
    """motion_program_exec [code] reads the empty name of wobj0 so."""
    text = bench.box("before")
    bench("UnpackRawBytes", RawBytes(b"abc"), 2, text, ASCII=0)
    assert text.get() == ""
    with pytest.raises(RapidError):
        bench("UnpackRawBytes", RawBytes(b"abc"), 2, bench.box(1), ASCII=0)
