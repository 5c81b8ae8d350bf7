"""What a client or a disk may contain: no crash, no hang, no stale finding afterwards."""

import os
import time

import pytest

from rapidgen.diagnostics import DiagnosticError
from rapidgen.editor.documents import Document, Lines
from rapidgen.editor.formatting import format_document
from rapidgen.editor.workspace import TOO_LARGE, Workspace
from rapidgen.wire.framing import encode
from tests.lsp.client import Client, Failed

GOOD = (
    "MODULE {0}\n    VAR num x{0};\n    PROC p{0}()\n        x{0} := 1;\n    ENDPROC\nENDMODULE\n"
)


def codes(found):
    return [d.code for d in found]


def opened(path, text):
    workspace = Workspace()
    workspace.open(Document(str(path), text))
    return workspace


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("", ["RG208"]),
        ("\0\1\2\3" * 500, ["RG218"]),
        ("x" * 10_000_000, ["RG337"]),
        ("MODULE m\nPROC p()\n" + "a:=1;" * 150_000 + "ENDPROC\nENDMODULE", ["RG337"]),
        ("MODULE m " + "(" * 5_000, ["RG201"]),
        ("MODULE m\nPROC p()\n" + "IF TRUE THEN\n" * 2_000, ["RG210"]),
        ('MODULE m\nPROC p()\nTPWrite "' + "\u5b57" * 1000, ["RG207"]),
        ("MODULE m\r\rPROC p()\r\r\nENDPROC\x85\u2028\nENDMODULE", ["RG204"]),
    ],
    ids=["empty", "binary", "10 MB", "words", "open", "nested", "quote", "ends"],
)
def test_any_text_has_findings_and_answers(tmp_path, text, expected):
    path = tmp_path / "m.mod"
    workspace = opened(path, text)
    assert codes(workspace.findings_of(str(path)))[:1] == expected
    workspace.documents[str(path)].edit(None, GOOD.format("m"), "utf-16")
    workspace.edited(str(path))
    assert workspace.findings_of(str(path)) == []


def test_a_module_that_is_too_large_to_format_is_refused(tmp_path):
    text = "MODULE m\nPROC p()\n" + "a:=1;" * 60_000 + "ENDPROC\nENDMODULE"
    path = tmp_path / "m.mod"
    (view,) = opened(path, text).views(str(path))
    with pytest.raises(DiagnosticError) as refused:
        format_document(view)
    assert codes(refused.value.diagnostics) == ["RG337"]
    assert format_document(opened(path, GOOD.format("m")).views(str(path))[0]) == []


@pytest.mark.parametrize("units", ["utf-8", "utf-16", "utf-32"])
def test_places_in_long_lines_are_counted_in_units(units):
    """The specification of LSP 3.17 counts code units; the expected value encodes the text."""
    text = "a\u00e4\u5b57\U0001f916b\r\nplain\n\U0001f916\U0001f916"
    lines = Lines(text)
    size = {"utf-8": 1, "utf-16": 2, "utf-32": 4}[units]
    for number, line in ((2, "plain"), (1, "a\u00e4\u5b57\U0001f916b"), (3, "\U0001f916" * 2)):
        for column in range(1, len(line) + 2):
            expected = len(line[: column - 1].encode(f"{units}-le" if size > 1 else units)) // size
            assert lines.point(number, column, units) == (number - 1, expected)


def test_requests_in_a_line_of_10_mb_return(tmp_path):
    path = tmp_path / "m.mod"
    with Client() as client:
        client.start(tmp_path)
        client.open(path, "MODULE m" + "\u00e4" * 10_000_000)
        assert [d.code for d in client.findings(path)] == ["RG337"]
        place = {"line": 0, "character": 5_000_000}
        assert client.ask_all("hover", path, position=place) is None
        client.change(path, 2, (((0, 8), (0, 10_000_008)), "\nENDMODULE"))
        assert client.findings(path) == ()


def test_a_large_module_has_findings_of_its_syntax(tmp_path):
    line = "    VAR unknown_type a;\n"
    text = "MODULE m\n" + line * (1_100_000 // len(line)) + "x\nENDMODULE\n"
    assert len(text) < TOO_LARGE
    workspace = opened(tmp_path / "m.mod", text)
    assert {code[:3] for code in codes(workspace.findings_of(str(tmp_path / "m.mod")))} == {"RG2"}


@pytest.mark.parametrize(
    "listed", ["p.pgf", "../../m.mod", "missing.mod", "", "m.mod</Module><Module>p.pgf"]
)
def test_a_program_file_that_lists_itself_or_others(tmp_path, listed):
    (tmp_path / "p.pgf").write_text(f"<Program><Module>{listed}</Module></Program>")
    path = tmp_path / "m.mod"
    path.write_text(GOOD.format("m"))
    workspace = opened(path, GOOD.format("m"))
    assert [d for d in workspace.findings_of(str(path)) if d.severity == "error"] == []


def test_modules_that_load_each_other(tmp_path):
    for own, other in (("a", "b"), ("b", "a")):
        (tmp_path / f"{own}.mod").write_text(
            f'MODULE {own}\nPROC p{own}()\nLoad "HOME:/{other}.mod";\nENDPROC\nENDMODULE\n'
        )
    with Client() as client:
        client.start(tmp_path)
        client.open(tmp_path / "a.mod")
        (link,) = client.ask_all("documentLink", tmp_path / "a.mod")
        assert link.target.endswith("b.mod")
        assert [d.code for d in client.findings(tmp_path / "a.mod")] == []


@pytest.mark.skipif(os.geteuid() == 0, reason="root may read everything")
def test_a_folder_without_rights(tmp_path):
    folder = tmp_path / "closed"
    folder.mkdir()
    folder.chmod(0)
    workspace = opened(folder / "m.mod", GOOD.format("m"))
    folder.chmod(0o700)
    assert workspace.findings_of(str(folder / "m.mod")) == []


def test_folders_that_cannot_be_listed_leave_the_file_alone(tmp_path, monkeypatch):
    path = tmp_path / "m.mod"
    path.write_text(GOOD.format("m"))

    def refuse(*_):
        raise PermissionError(13, "no rights", str(tmp_path))

    monkeypatch.setattr(os, "listdir", refuse)
    monkeypatch.setattr(os, "scandir", refuse)
    workspace = opened(path, GOOD.format("m"))
    assert codes(workspace.findings_of(str(path))) in ([], ["RG704"])


def test_links_in_a_circle_and_files_that_vanish(tmp_path):
    (tmp_path / "loop.mod").symlink_to(tmp_path / "loop.mod")
    (tmp_path / "gone.mod").symlink_to(tmp_path / "nowhere.mod")
    path = tmp_path / "m.mod"
    path.write_text(GOOD.format("m"))
    workspace = opened(path, GOOD.format("m"))
    assert workspace.findings_of(str(path)) == []
    list(workspace.work())


def test_a_burst_of_edits_leaves_no_stale_finding(tmp_path):
    path = tmp_path / "m.mod"
    text = GOOD.format("m")
    with Client() as client:
        client.start(tmp_path)
        client.open(path, text)
        client.findings(path)
        messages = []
        for version in range(2, 1002):
            letter = ";" if version % 2 else " "
            area = {"start": {"line": 3, "character": 15}, "end": {"line": 3, "character": 16}}
            content = [{"range": area, "text": letter}]
            document = {"uri": path.as_uri(), "version": version}
            params = {"textDocument": document, "contentChanges": content}
            message = {"jsonrpc": "2.0", "method": "textDocument/didChange", "params": params}
            messages.append(encode(message))
        client.own.sendall(b"".join(messages))
        before = time.process_time()
        report = client.ask_all("diagnostic", path)
        assert report.items == ()
        assert client.server.session.workspace.documents[str(path)].version == 1001
        # 5,000 edits a minute are 83 a second: 1,000 of them must cost far less than 12 s.
        assert time.process_time() - before < 12


def test_edits_outside_of_the_text_and_of_closed_documents(tmp_path):
    path = tmp_path / "m.mod"
    with Client() as client:
        client.start(tmp_path)
        client.change(path, 2, (((0, 0), (0, 1)), "x"))
        client.open(path, GOOD.format("m"))
        client.change(path, 3, (((99, 5), (99, 9)), "\n! end"), (((3, 90), (3, 95)), " ! x"))
        client.change(path, 4, (((2, 5), (1, 0)), ""))
        assert client.ask_all("diagnostic", path).items == ()
        text = client.server.session.workspace.documents[str(path)].text
        assert text.endswith("ENDMODULE\n\n! end")
        assert "x m := 1" not in text
        with pytest.raises(Failed):
            client.ask_all("hover", path, position={"line": "x", "character": 0})


@pytest.mark.parametrize("uri", ["untitled:Untitled-1", "file:///c%3A/x/m.mod", "git:/a/m.mod", ""])
def test_any_address_is_a_document(uri):
    with Client() as client:
        client.start()
        item = {"uri": uri, "languageId": "rapid", "version": 1, "text": "MODULE m\n"}
        client.notify("textDocument/didOpen", {"textDocument": item})
        report = client.request("textDocument/diagnostic", {"textDocument": {"uri": uri}})
        assert [d.code for d in report.items] == ["RG201"]
