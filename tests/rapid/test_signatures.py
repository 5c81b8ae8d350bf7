"""The built-ins as data hold together."""

import pytest

from rapidgen.rapid.builtins import signatures


def test_types_in_headers_exist():
    known = {name.lower() for name in signatures.type_names()} | {"anytype", "switch"}
    named = {p.type.lower() for s in signatures.routines().values() for p in s.parameters}
    named |= {s.type.lower() for s in signatures.routines().values() if s.type}
    named |= {t.lower() for r in signatures.records().values() for t, _ in r.components}
    named |= {d.type.lower() for d in signatures.predefined().values()}
    assert named - known == set()


def test_names_are_found_in_any_case():
    assert signatures.routine("SOCKETSEND").name == "SocketSend"
    assert signatures.record("RobTarget").components[0] == ("pos", "trans")
    assert signatures.constant("TOOL0").value[0] is True
    assert signatures.routine("no_such_routine") is None


def test_alternatives_and_order_of_parameters():
    send = signatures.routine("SocketSend")
    displayed = [
        (p.mode, p.type, p.name, p.dimensions, p.optional, p.group) for p in send.parameters
    ]
    assert displayed == [
        ("VAR", "socketdev", "Socket", 0, False, -1),
        ("", "string", "Str", 0, True, 0),
        ("VAR", "rawbytes", "RawData", 0, True, 0),
        ("", "byte", "Data", 1, True, 0),
        ("", "num", "NoOfBytes", 0, True, -1),
    ]


def test_required_alternatives_have_a_group():
    bits = signatures.routine("BitSet").parameters
    assert [(p.name, p.optional, p.group) for p in bits] == [
        ("BitData", False, 0),
        ("DnumData", False, 0),
        ("BitPos", False, -1),
    ]


def test_error_numbers_are_distinct_and_no_users_numbers():
    numbers = [
        d.value
        for n, d in signatures.predefined().items()
        if n.startswith("err_") and d.type == "errnum"
    ]
    assert len(numbers) > 200
    assert len(set(numbers)) == len(numbers)
    assert min(numbers) > 90


@pytest.mark.parametrize(
    ("name", "kind"), [("rawbytes", "nonvalue"), ("signaldi", "semivalue"), ("errnum", "value")]
)
def test_type_classes(name, kind):
    assert signatures.type_class(name) == kind


@pytest.mark.parametrize(
    ("name", "value"),
    [
        ("v100", (100, 500, 5000, 1000)),
        ("z10", (False, 10, 15, 15, 1.5, 15, 1.5)),
        ("fine", (True, 0, 0, 0, 0, 0, 0)),
        ("SOCKET_CLOSED", 5),
        ("EOF_BIN", -1),
        ("LINT", -8),
        ("pi", 3.1415926),
    ],
)
def test_values(name, value):
    assert signatures.constant(name).value == value


def test_header_marks_are_parsed():
    assert signatures.marked("steps") == {"incr", "decr", "add", "clear"}
    assert signatures.marked("ends") == {"exitcycle"}
    assert signatures.marked("whole") == {"dim", "strfind", "strlen", "strmatch"}
    assert signatures.marked("inplace") == {"dim", "ispers", "isvar", "present"}
    assert signatures.marked("inplace") < signatures.marked("inline")
    assert signatures.routine("WaitUntil").marks == {"lazy": ("cond",)}
    assert signatures.routine("CopyRawBytes").marks == {"index": ("fromindex", "toindex")}
    since = signatures.routine("DnumToStr")
    assert (since.since, since.until, since.marks, since.checked) == ((5, 12), None, {}, True)
    assert not signatures.routine("SpotL").checked


def test_names_after_marks_are_parameters():
    for signature in signatures.routines().values():
        names = {p.name.lower() for p in signature.parameters}
        versions = ("came", "went")
        marked = [words for marker, words in signature.marks.items() if marker not in versions]
        marked += [words[1:] for marker, words in signature.marks.items() if marker in versions]
        assert {name for words in marked for name in words} <= names


def test_numbers_match_real_controller():
    text = {"ERR_WHLSEARCH": 1072, "ERR_SIGSUPSEARCH": 1073, "ERR_SOCK_CLOSED": 1095}
    assert {name: signatures.constant(name).value for name in text} == text
    numbers = [d.value for d in signatures.predefined().values() if d.type == "errnum"]
    assert len(set(numbers)) == len(numbers)


def test_readonly_data_are_marked():
    data = signatures.predefined().values()
    assert {d.name for d in data if d.readonly and d.kind != "CONST"} == {"ERRNO", "INTNO"}
    assert [d.name for d in data if not d.readonly and d.kind == "CONST"] == ["vmax"]


def test_fully_known_names_are_in_no_option_list():
    listed = signatures.option_names
    assert {n.lower() for n in signatures.type_names()} & listed("types") == set()
    routines = {n.lower() for n in signatures.routine_names()}
    assert routines & (listed("procedures") | listed("functions")) == set()
    assert set(signatures.predefined()) & listed("values") == set()


# -- places ----------------------------------------------------------------------------------


def test_every_built_in_routine_has_the_place_of_its_header():
    for name in signatures.routine_names():
        path, line, column, length = signatures.place(name)
        text = path.read_text().splitlines()[line - 1]
        assert text[column - 1 : column - 1 + length] == name
    assert signatures.place("nowhere") is None
