"""Odd LIST output, and names that could lead elsewhere."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rapidgen.deploy import TransportFault
from rapidgen.deploy.transports.listing import parse_facts, parse_list, parse_names
from rapidgen.deploy.transports.transport import Entry, safe


@pytest.mark.parametrize(
    ("line", "entry"),
    [
        ("-rw-r--r--   1 1000 1000  1234 Nov 21 08:16 a b.mod", Entry("a b.mod", 1234, False)),
        (
            "-rw-r--r--   1 user       12 Jan  1  2020 no_group.mod",
            Entry("no_group.mod", 12, False),
        ),
        (
            "drwxr-xr-x+  2 root root 4096 Feb 29 23:59 Default User",
            Entry("Default User", None, True),
        ),
        ("-rw-rw-rw-   1 a b c  7 2020-01-01 10:10 iso.mod", Entry("iso.mod", 7, False)),
        ("-rwxrwxrwx   1 0 0 9 21. Nov. 10:10 german.mod", Entry("german.mod", 9, False)),
        ("lrwxrwxrwx   1 0 0 9 Nov 21 08:16 link -> /etc/passwd", Entry("link")),
        ("11-21-26  08:16AM       <DIR>          HOME", Entry("HOME", None, True)),
        ("11-21-2026  08:16PM            1,234 x.sys", Entry("x.sys", 1234, False)),
        ("     512    JAN-01-1980   00:00:00   HOME              <DIR>", Entry("HOME", None, True)),
        (
            "    4711    NOV-21-2026   08:16:02   ROS_motion.mod",
            Entry("ROS_motion.mod", 4711, False),
        ),
    ],
)
def test_known_forms(line, entry):
    assert parse_list(["total 4\r", line + "\r"]) == (entry,)


def test_parse_list_unknown_form_is_none():
    assert parse_list(["total 0", ""]) == ()
    assert parse_list(["!! what is this", "and this"]) is None
    assert parse_names(["/hd0a/HOME/a.mod\r", "b.mod"]) == (Entry("a.mod"), Entry("b.mod"))


def test_facts():
    lines = ["type=cdir; .", "Type=file;Size=3;modify=2026; a;b c.mod", "type=dir; d"]
    assert parse_facts(lines) == (Entry("a;b c.mod", 3, False), Entry("d", None, True))


def test_names_that_lead_elsewhere_are_dropped():
    head = "-rw-r--r-- 1 0 0 1 Nov 21 08:16 "
    hostile = ["..", ".", "../x", "a/b", "a\\b", "a\x1b[31m", "good.mod"]
    assert parse_list([head + name for name in hostile]) == (Entry("good.mod", 1, False),)
    assert parse_names(["..", "x/.."]) == ()
    assert parse_facts([f"type=file; {name}" for name in hostile]) == (
        Entry("good.mod", None, False),
    )


@given(st.lists(st.text()))
def test_no_text_makes_the_parsers_fail(lines):
    for parse in (parse_list, parse_names, parse_facts):
        for entry in parse(lines) or ():
            assert entry.name not in ("", ".", "..")
            assert "/" not in entry.name


@pytest.mark.parametrize(
    "path",
    ["", "/etc", "../x", "a/../b", "a//b", "a/", "a\\b", "C:/x", "a\nb", "a\x00", "...", "é"],
)
def test_unsafe_paths(path):
    with pytest.raises(TransportFault) as caught:
        safe(path)
    assert caught.value.diagnostics[0].code == "RG508"
    assert safe("ROS/ROS motion (1).mod") == "ROS/ROS motion (1).mod"
