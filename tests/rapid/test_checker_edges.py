"""Corners of the checker that need no file of their own."""

import pytest

from rapidgen.diagnostics import Severity
from rapidgen.rapid import Dialect, check
from rapidgen.rapid.builtins import signatures
from rapidgen.rapid.builtins.signatures import Signature
from rapidgen.system import ModuleFile, System, TaskSpec


def codes(body, data="", remaining="", **options):
    text = f"MODULE Demo\n{data}\nPROC main()\n{body}\nENDPROC\n{remaining}\nENDMODULE\n"
    system = System(
        "s", (TaskSpec("T_ROB1", modules=(ModuleFile("Demo", "m.mod", text.encode()),)),)
    )
    return [d.code for d in check(system, **options)]


@pytest.mark.parametrize(
    ("index", "fits"),
    [
        ("n", True),
        ("n + 1", False),
        ("n - 1", True),
        ("n * 2", False),
        ("n / 3", True),
        ("-n", False),
        ("(n)", True),
        ("+n", True),
        ("m", False),
    ],
)
def test_indices_known_before_the_run(index, fits):
    data = "CONST num n := 3;\nCONST num m := n + n;\nVAR num a{n};"
    assert codes(f"a{{{index}}} := 1;", data) == ([] if fits else ["RG318"])


@pytest.mark.parametrize("value", ["n DIV 2", "Abs(n)", "v", "NOT_THERE"])
def test_unknown_indices_are_not_reported(value):
    data = "CONST num n := 3;\nVAR num v;\nVAR num NOT_THERE;\nVAR num a{n};"
    assert codes(f"a{{{value}}} := 1;", data) == []


def test_cyclic_constants_terminate():
    assert codes("a{x} := 1;", "CONST num x := y;\nCONST num y := x;\nVAR num a{3};") == []


@pytest.mark.parametrize("body", ["Hand_GripInward \\holdForce:=10;", "CamReqImage c;"])
def test_unknown_arguments_are_not_checked(body):
    assert codes(body, "VAR cameradev c;") == []


def test_alternatives_are_selected_by_type():
    data = "VAR dnum d;\nVAR byte b;\nVAR bool f;\nVAR num n;"
    assert codes("BitSet d, 52;\nBitSet b, 8;\nIncr d;\nAdd d, d;\nAdd n, 1;", data) == []
    assert codes("BitSet f, 1;", data) == ["RG307"]
    assert codes("BitSet d + 1, 1;", data) == ["RG315"]


def test_conditional_arguments_of_the_wrong_kind():
    remaining = "PROC p(\\num a)\nq \\s?a;\nq \\s?<VAR>;\nENDPROC\nPROC q(\\switch s)\nENDPROC"
    assert codes("p;", remaining=remaining) == ["RG316"]


def test_placeholder_parameters_are_not_checked():
    assert codes("p 1, 2, 3;", remaining="PROC p(<PAR>)\nENDPROC") == []


def test_unknown_traps_and_endless_steps():
    data = "VAR intnum i;"
    assert codes("CONNECT i WITH nothing;", data) == ["RG301"]
    assert codes("FOR k FROM 1 TO 3 STEP 0 DO\nENDFOR") == ["RG319"]


@pytest.mark.parametrize(
    ("line", "text"),
    [("IF b != c THEN", 1), ("IF b", 0), ("IF b ! = c", 0), ("IF b !==== c", 0), ("IF b <> c", 0)],
)
def test_condition_ending_before_unequal_is_reported(line, text):
    # What an IF without THEN takes is below it [K §2.10, 4.14].
    assert codes(f"{line}\nTPErase;", "VAR bool b;\nVAR bool c;") == ["RG332"] * text
    assert codes(f"{line}\nTHEN TPErase;\nENDIF", "VAR bool b;\nVAR bool c;") == ["RG332"] * text
    loop = line.replace("IF", "WHILE").removesuffix(" THEN")
    assert codes(f"{loop}\nDO\nENDWHILE", "VAR bool b;\nVAR bool c;") == ["RG332"] * text


def test_arrays_assigned_from_elements_are_not_compared_in_size():
    assert codes("r.x := 1;\na := b;", "VAR pos r;\nVAR pos a{2};\nVAR pos b{2};") == []


def test_cyclic_records_terminate():
    data = "RECORD r1\nr2 x;\nENDRECORD\nRECORD r2\nr1 y;\nENDRECORD\nVAR r1 a;"
    assert codes("a.x.y.x := a.x;", data) == []


def test_aggregates_left_of_an_operator():
    assert codes("p := [1, 2, 3] + p;\nb := [1, 2] = p;", "VAR pos p;\nVAR bool b;") == ["RG330"]


def test_members_out_of_range():
    assert codes("p := [1E39, 0, 0];", "VAR pos p;") == ["RG319"]
    assert codes("p := [16777217, 0, 0];", "VAR pos p;") == ["RG319"]


def test_unknown_types_are_reported_once():
    data = "VAR nosuch a;\nVAR nosuch b;"
    assert codes("a := b;\na.x := 1;\nUse a;", data, "PROC Use(VAR nosuch p)\nENDPROC") == ["RG303"]


def test_array_parameters_have_three_dimensions_at_most():
    assert codes("", remaining="PROC p(num a{*,*,*,*})\nENDPROC") == ["RG318"]


@pytest.mark.parametrize(
    ("body", "lasts"),
    [
        # Where from: rapidgen/rapid/builtins/*.rapid, beside each.
        ("StopMove \\Quick;", "until"),
        ("Break;", "until"),
        ("DebugBreak;", "since"),
        ("UnpackRawBytes r, 1, s \\ASCII:=4;", "until"),
        ("UnpackRawBytes r, 1, s \\UTF8Encoding:=4;", "since"),
        ("UnpackRawBytes r, 1, s \\ISOLatin1Encoding:=4;", "since"),
        ("SearchL \\PStop, di, p, p, v100, tool0;", "until"),
        ("StopMove;", "always"),
        ("PackRawBytes s, r, 1 \\ASCII;", "always"),
    ],
)
def test_robotware_7_features_are_checked(body, lasts):
    data = "VAR rawbytes r;\nVAR string s;\nVAR signaldi di;\nVAR robtarget p;"
    six, seven = (codes(body, data, dialect=Dialect(v)) == ["RG325"] for v in ((6, 15), (7, 0)))
    assert (six, seven) == {
        "until": (False, True),
        "since": (True, False),
        "always": (False, False),
    }[lasts]


def test_removed_routine_is_reported(monkeypatch):
    gone = Signature("Gone", "PROC", None, (), None, (7, 0))
    result = signatures.routine
    monkeypatch.setattr(signatures, "routine", lambda n: gone if n == "gone" else result(n))
    assert codes("Gone;", dialect=Dialect((7, 0))) == ["RG325"]
    assert codes("Gone;", dialect=Dialect((6, 15))) == []


@pytest.mark.parametrize("name", ["tool0", "main", "TPErase", "anytype"])
def test_unknown_type_is_reported(name):
    assert codes("a := a;", f"VAR {name} a;")[:1] == ["RG303"]


def test_a_persistent_has_literals_at_any_depth():
    data = "PERS pose a := [[1, 2 * 3, 4], [1, 0, 0, 0]];\nPERS num b{2} := [1, pi];"
    assert codes("a := a;\nb := b;", data) == ["RG317", "RG317"]


def test_unused_local_routines_are_reported():
    remaining = (
        "LOCAL PROC p()\nENDPROC\nLOCAL FUNC num f()\nRETURN 1;\nENDFUNC\nLOCAL TRAP t\nENDTRAP"
    )
    assert codes("", remaining=remaining) == ["RG324", "RG324", "RG324"]
    assert codes('%"m:p"%;', remaining=remaining) == []  # a name in a string may be any of them


@pytest.mark.parametrize("local", [True, False])
@pytest.mark.parametrize(
    ("data", "written", "is_unused"),
    [
        ("VAR num a;", "a := 1;", True),
        ("VAR num a;", "a := 1;\na := 2;", True),
        ("VAR num a;", "a := a + 1;", False),
        ("VAR num a{3};", "a := [1, 2, 3];", True),
        ("VAR num a{3};", "a{1} := 2;", False),
        ("VAR num a{3};", "a{1} := 2;\na := [1, 2, 3];", False),
        ("VAR num a{3};", "a := [1, 2, 3];\na{1} := 2;", False),
        ("VAR pos a;", "a := [1, 2, 3];", True),
        ("VAR pos a;", "a.x := 1;", False),
        ("VAR pos a{2};", "a{1}.x := 1;", False),
        ("VAR pose a;", "a.trans.x := 1;", False),
        ("VAR num a{3};\n{also}VAR num i;", "i := 1;\na{i} := 2;", False),
    ],
)
def test_written_datum_is_unused_unless_partly_written(local, data, written, is_unused):
    """A write to a part keeps the rest, so the datum counts as used."""
    expected = ["RG324"] if is_unused else []
    if local:
        assert codes(written, "LOCAL " + data.replace("{also}", "LOCAL ")) == expected
    else:
        assert codes(data.replace("{also}", "") + "\n" + written) == expected


@pytest.mark.parametrize(
    ("body", "data", "expected"),
    [
        ("again:", "", ["RG324"]),
        ("a := nothing(1);", "VAR num a;", ["RG301"]),
        ("a := main();", "VAR num a;", ["RG306"]),
        ("a := b(1);", "VAR num a;\nVAR num b{2};", ["RG306"]),
        ("a := a.x;", "VAR num a;", ["RG304"]),
        ("a := b.x;", "VAR num a;\nVAR pos b{2};", ["RG304"]),
        ("a := [1, 2];", "VAR num a;", ["RG330"]),
    ],
)
def test_unfitting_names_and_aggregates_are_reported(body, data, expected):
    assert codes(body, data) == expected


def test_raw_byte_index_out_of_range_is_warning():
    body = "VAR rawbytes r;\nPackRawBytes 1, r, 0 \\IntX:=1;"
    (result,) = check(f"MODULE m\nPROC main()\n{body}\nENDPROC\nENDMODULE")
    assert (result.code, result.severity) == ("RG319", Severity.WARNING)


def test_numbers_beyond_num_where_no_dnum_is():
    assert codes("IF 1E39 > 1 TPErase;", dialect=Dialect((5, 0))) == ["RG319"]
    assert codes("IF 1E39 > 1 TPErase;", dialect=Dialect((6, 0))) == []


def test_moves_are_followed_through_a_limited_depth_of_calls():
    """Deeper calls are not followed, so that no program ends the checker."""
    depth = 2000
    procedures = "".join(f"PROC p{n}()\np{n + 1};\nENDPROC\n" for n in range(depth))
    text = (
        f"MODULE m\nVAR robtarget p;\nTRAP t\np{depth - 5};\nENDTRAP\nTRAP u\np0;\nENDTRAP\n"
        f"{procedures}PROC p{depth}()\nMoveL p, v100, fine, tool0;\nENDPROC\nENDMODULE\n"
    )
    assert [(d.code, d.span.line) for d in check(text)] == [("RG334", 4)]
