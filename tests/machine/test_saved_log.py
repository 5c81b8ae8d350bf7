"""Saved event logs, in the form of those of RobotWare 5.15, 5.61 and 6.03 controllers."""

import pytest

from rapidgen.diagnostics import DiagnosticError
from rapidgen.machine.event_table import KINDS, SOURCE, Domain, domain_of
from rapidgen.machine.saved_log import read_saved_log

HEAD = "{title}\nDate:\t2026-01-02 03:04:05\n\nRobotWare: {release}\nKey:\tABC\n\n"
ROWS = (
    "12  \tW\tMotion \t50024 \t{corner} \t2026-01-02 03:04:06 \t{text}"
    '\t{{args: "T_ROB1", "/Main/main/MoveL/7"}}\n'
    "11  \tI\tOperational \t10125 \t{stopped} \t2026-01-02 03:04:05 \t{text}"
    '\t{{args: "1", "T_ROB1"}}\n'
)
LANGUAGES = {
    "English": ("Corner", "Stopped", "Because.", "utf-8"),
    "German": ("Überschleifen", "Gestoppt", "Ursache: Prüfung.", "cp1252"),
    "Chinese": ("转角", "停止", "原因", "gb18030"),
    "UTF-16": ("Corner", "Stopped", "Because.", "utf-16"),
    "byte order mark": ("Ecke", "Gestoppt", "Prüfung", "utf-8-sig"),
}


@pytest.mark.parametrize("language", LANGUAGES)
def test_log_is_read_in_every_language(tmp_path, language):
    corner, stopped, text, encoding = LANGUAGES[language]
    content = HEAD.format(title=text, release="6.03.02.00") + ROWS.format(
        corner=corner, stopped=stopped, text=text
    )
    path = tmp_path / "Elog_all.txt"
    path.write_bytes(content.encode(encoding))
    log = read_saved_log(path)
    assert log.robotware == "6.03.02.00"
    assert [(e.sequence, e.type, e.code, e.title, e.text, e.arguments) for e in log.events] == [
        (12, "W", 50024, corner, text, ("T_ROB1", "/Main/main/MoveL/7")),
        (11, "I", 10125, stopped, text, ("1", "T_ROB1")),
    ]


@pytest.mark.parametrize(
    "content",
    [
        b"",
        b"no log\n",
        b"1\tE\tx\tcode\tt\td\tt\t{args: }\n",
        b"1\tX\tx\t50024\tt\td\tt\t{args: }\n",
        b"1\tE\tx\t5002\xff\tt\td\tt\n",
        b"9" * 300 + b"\tE\tx\t50024\tt\td\tt\t{args: }\n",
        b"\0" * 5000,
        b"\xff\xfe\x00",
    ],
)
def test_other_file_is_rejected(tmp_path, content):
    path = tmp_path / "x.txt"
    path.write_bytes(content)
    with pytest.raises(DiagnosticError) as refused:
        read_saved_log(path)
    assert refused.value.diagnostics[0].code == "RG724"


def test_missing_file_is_rejected(tmp_path):
    with pytest.raises(DiagnosticError, match="no such file") as refused:
        read_saved_log(tmp_path / "none.txt")
    (finding,) = refused.value.diagnostics
    assert (finding.code, "path" in finding.help) == ("RG724", True)


def test_folder_in_place_of_a_file_is_rejected(tmp_path):
    with pytest.raises(DiagnosticError, match="cannot be read"):
        read_saved_log(tmp_path)


def test_every_kind_has_domain_text_and_source():
    for code, kind in KINDS.items():
        assert kind.code == code
        assert set(kind.types) <= set("EWI")
        assert kind.types
        assert kind.title
        assert kind.text
        assert kind.source
        assert kind.releases or kind.source != SOURCE
        assert len(kind.title) <= 60
        domain_of(code)


@pytest.mark.parametrize(
    ("code", "domain"),
    [(10_002, 1), (50_024, 5), (110_001, 11), (120_006, 12), (194_001, 4), (195_902, 5)],
)
def test_own_numbers_have_their_digit_as_domain(code, domain):
    assert domain_of(code) is Domain(domain)
