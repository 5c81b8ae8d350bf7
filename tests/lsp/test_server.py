"""The language server as its clients see it: each answer has the type of the protocol."""

import subprocess
import sys

import pytest

from rapidgen.wire.framing import MessageSplitter, encode
from tests.lsp.client import FULL, Client, Failed

MAIN = """MODULE Main
    ! Speed of all moves
    CONST num five := 2 + 3;
    CONST robtarget p10 := [[100,200,300],[1,0,0,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
    PROC main()
        VAR num unused;
        helper five, 2 \\fast;
        MoveL p10, v1000, z50, tool0;
        %"helper"% 1, 2;
    ENDPROC
    PROC helper(num a, num b \\switch fast)
        TPWrite ValToStr(a + b);
        counter := counter + 1;
    ENDPROC
ENDMODULE
"""
DATA = "MODULE Data\n    PERS num counter := 0;\nENDMODULE\n"


@pytest.fixture
def folder(tmp_path):
    (tmp_path / "Main.mod").write_text(MAIN)
    (tmp_path / "Data.sys").write_text(DATA)
    return tmp_path


@pytest.fixture
def client(folder):
    with Client() as client:
        client.start(folder)
        client.open(folder / "Main.mod")
        yield client


def starts(places):
    return [(p.range.start.line, p.range.start.character) for p in places]


# -- life cycle ------------------------------------------------------------------------------


def test_requests_before_initialize_and_after_shutdown_fail(folder):
    with Client() as client:
        with pytest.raises(Failed) as early:
            client.request("workspace/symbol", {"query": ""})
        client.start(folder)
        assert client.request("shutdown", None) is None
        with pytest.raises(Failed) as late:
            client.request("workspace/symbol", {"query": ""})
        client.notify("exit", None)
        client.thread.join(20)
    assert (early.value.code, late.value.code, client.codes) == (-32002, -32600, [0])


def test_a_client_that_dies_ends_the_server(folder):
    with Client() as client:
        client.start(folder)
    assert client.codes == [1]


@pytest.mark.parametrize(
    ("offered", "expected"),
    [(None, "utf-16"), (["utf-16"], "utf-16"), (["utf-8", "utf-16"], "utf-8"), (["x"], "utf-16")],
)
def test_units_are_negotiated(folder, offered, expected):
    capabilities = {"general": {"positionEncodings": offered}} if offered else {}
    with Client() as client:
        result = client.start(folder, capabilities)
    assert result.capabilities.position_encoding == expected


@pytest.mark.parametrize(
    ("message", "code"),
    [
        ({"id": 1, "method": "textDocument/hover", "params": {}}, -32602),
        ({"id": 1, "method": "textDocument/hover", "params": {"textDocument": 5}}, -32602),
        ({"id": 1, "method": "no/such"}, -32601),
        ({"id": 1, "method": 5}, -32600),
        ({"id": 1, "method": "initialize", "params": {}}, -32600),
    ],
)
def test_wrong_messages_get_an_error_and_the_server_stays(client, message, code):
    client.send({"jsonrpc": "2.0", **message})
    while "error" not in (answer := client.read()):
        pass
    assert answer["error"]["code"] == code
    assert client.request("workspace/symbol", {"query": "helper"})


def test_a_message_without_json_is_skipped(client):
    client.own.sendall(b"Content-Length: 3\r\n\r\n{]}")
    while "error" not in (answer := client.read()):
        pass
    assert answer["error"]["code"] == -32700
    assert client.request("workspace/symbol", {"query": "helper"})


def test_a_cancelled_request_is_not_executed(client, folder):
    # The cancellation is read before the server gets to the request: both are in one piece.
    hover = client.at(folder / "Main.mod", "hel|per five")
    request = {"jsonrpc": "2.0", "id": 77, "method": "textDocument/hover", "params": hover}
    cancel = {"jsonrpc": "2.0", "method": "$/cancelRequest", "params": {"id": 77}}
    busy = {"jsonrpc": "2.0", "id": 76, "method": "workspace/symbol", "params": {"query": ""}}
    client.server.queue.cancelled.add(77)
    client.own.sendall(encode(busy) + encode(cancel) + encode(request))
    with pytest.raises(Failed) as fault:
        client.finish(77)
    assert fault.value.code == -32800


def test_over_standard_streams_and_with_a_log(folder, tmp_path):
    log = tmp_path / "server.log"
    messages = [
        {"id": 1, "method": "initialize", "params": {"capabilities": {}}},
        {"id": 2, "method": "shutdown"},
        {"method": "exit"},
    ]
    data = b"".join(encode({"jsonrpc": "2.0", **m}) for m in messages)
    command = [sys.executable, "-m", "rapidgen", "lsp", "--log", str(log)]
    done = subprocess.run(command, input=data, capture_output=True, check=True, timeout=60)
    splitter = MessageSplitter()
    splitter.feed(done.stdout)
    assert [splitter.next()["id"], splitter.next()["id"], splitter.next()] == [1, 2, None]
    assert done.stderr == b""
    assert "rapidgen" in log.read_text()


# -- findings --------------------------------------------------------------------------------


def test_findings_are_pushed_and_follow_edits(client, folder):
    main = folder / "Main.mod"
    (finding,) = client.findings(main)
    assert (finding.code, finding.range.start.line, finding.tags) == ("RG324", 5, (1,))
    client.change(main, 2, (((5, 0), (6, 0)), ""), (((5, 22), (5, 22)), "\\slow"))
    (finding,) = client.findings(main)
    assert (finding.code, finding.range.start.line) == ("RG312", 5)


def test_an_edit_changes_findings_of_other_modules(client, folder):
    data = folder / "Data.sys"
    client.findings(folder / "Main.mod")
    client.open(data)
    client.change(data, 2, (((1, 13), (1, 20)), "other"))
    codes = [d.code for d in client.findings(folder / "Main.mod")]
    assert "RG302" in codes


def test_findings_are_pulled_and_not_pushed_by_a_client_that_asks(folder):
    main = folder / "Main.mod"
    capabilities = {**FULL, "textDocument": {"diagnostic": {}}}
    with Client() as client:
        client.start(folder, capabilities)
        client.open(main)
        report = client.ask_all("diagnostic", main)
        assert [d.code for d in report.items] == ["RG324"]
        client.change(main, 2, (((5, 0), (6, 0)), ""))
        assert client.ask_all("diagnostic", main).items == ()
        assert not client.notes


def test_a_closed_document_counts_as_its_file(client, folder):
    data = folder / "Data.sys"
    client.findings(folder / "Main.mod")
    client.open(data, "MODULE Data\nENDMODULE\n")
    assert "RG302" in [d.code for d in client.findings(folder / "Main.mod")]
    client.notify("textDocument/didClose", {"textDocument": {"uri": data.as_uri()}})
    assert [d.code for d in client.findings(folder / "Main.mod")] == ["RG324"]


def test_a_file_that_another_program_writes_is_read_again(client, folder):
    client.findings(folder / "Main.mod")
    (folder / "Data.sys").write_text("MODULE Data\nENDMODULE\n")
    changes = [{"uri": (folder / "Data.sys").as_uri(), "type": 2}]
    client.notify("workspace/didChangeWatchedFiles", {"changes": changes})
    assert "RG302" in [d.code for d in client.findings(folder / "Main.mod")]


def test_settings_change_findings(client, folder):
    client.open(folder / "Lone.mod", "MODULE Lone\nPROC p()\nfar := 1;\nENDPROC\nENDMODULE\n")
    assert [d.severity for d in client.findings(folder / "Lone.mod")] == [3]
    settings = {"rapidgen": {"strict": True, "encoding": 5}}
    client.notify("workspace/didChangeConfiguration", {"settings": settings})
    assert [d.severity for d in client.findings(folder / "Lone.mod")] == [1]


def test_quick_fixes_have_edits_for_the_present_version(client, folder):
    area = {"start": {"line": 5, "character": 0}, "end": {"line": 5, "character": 0}}
    actions = client.ask_all(
        "codeAction", folder / "Main.mod", range=area, context={"diagnostics": []}
    )
    assert [a.title for a in actions] == ["Remove unused", "Apply all safe fixes"]
    (change,) = actions[0].edit.document_changes
    assert change.text_document.version == 1
    only = {"diagnostics": [], "only": ["source"]}
    (action,) = client.ask_all("codeAction", folder / "Main.mod", range=area, context=only)
    assert action.kind == "source.fixAll"


# -- features --------------------------------------------------------------------------------


def test_hover_and_navigation(client, folder):
    main = folder / "Main.mod"
    text = client.ask("hover", main, "helper fi|ve").contents.value
    assert "CONST num five := 2 + 3" in text
    assert "Speed of all moves" in text
    assert "Value: `5`" in text
    assert "x 100, y 200, z 300 mm" in client.ask("hover", main, "MoveL p1|0").contents.value
    assert starts(client.ask("definition", main, "hel|per five")) == [(10, 9)]
    (place,) = client.ask("definition", main, "coun|ter :=")
    assert place.uri.endswith("Data.sys")
    (place,) = client.ask("definition", main, "Mo|veL")
    assert place.uri.endswith("motion.rapid")
    assert starts(client.ask("implementation", main, '%"hel|per"%')) == [(10, 9)]
    (place,) = client.ask("typeDefinition", main, "MoveL p1|0")
    assert place.uri.endswith("types.rapid")
    context = {"includeDeclaration": True}
    places = client.ask("references", main, "hel|per five", context=context)
    assert starts(places) == [(6, 8), (8, 10), (10, 9)]
    assert client.ask("hover", main, "ENDMOD|ULE") is None


def test_rename_counts_strings(client, folder):
    main = folder / "Main.mod"
    edit = client.ask("rename", main, "coun|ter :=", newName="total")
    changes = {
        c.text_document.uri.rsplit("/", 1)[1]: starts(c.edits) for c in edit.document_changes
    }
    assert changes == {"Data.sys": [(1, 13)], "Main.mod": [(12, 8), (12, 19)]}
    for new, reason in [("helper", "already"), ("IF", "reserved"), ("5x", "no name")]:
        with pytest.raises(Failed, match=reason):
            client.ask("rename", main, "coun|ter :=", newName=new)
    with pytest.raises(Failed, match="RobotWare"):
        client.ask("prepareRename", main, "Mo|veL")


def test_completion_and_signature(client, folder):
    main = folder / "Main.mod"
    items = client.ask("completion", main, "MoveL p10, |v1000").items
    best = sorted(items, key=lambda i: i.sort_text)[0]
    assert best.detail == "speeddata"
    (item,) = [i for i in items if i.label == "v500"]
    resolved = client.finish(
        client.begin("completionItem/resolve", {"label": item.label, "data": item.data})
    )
    assert "500 mm/s" in resolved["documentation"]["value"]
    assert [i.label for i in client.ask("completion", main, "2 \\|fast").items] == ["fast"]
    result = client.ask("signatureHelp", main, "helper five, |2")
    (signature,) = result.signatures
    assert signature.parameters[result.active_parameter].label == "num b"


def test_structure(client, folder):
    main = folder / "Main.mod"
    (module,) = client.ask_all("documentSymbol", main)
    assert [c.name for c in module.children] == ["five", "p10", "main", "helper"]
    folds = [(f.start_line, f.end_line) for f in client.ask_all("foldingRange", main)]
    assert folds == [(4, 9), (10, 13)]
    place = {"line": 12, "character": 10}
    (selection,) = client.ask_all("selectionRange", main, positions=[place])
    assert selection.parent.range.start.character == 8
    assert selection.parent.parent.range.end.line == 13
    assert [lens.command.title for lens in client.ask_all("codeLens", main)] == [
        "Run",
        "Debug",
        "Show in page",
    ]
    (found,) = client.request("workspace/symbol", {"query": "helper"})
    assert found.container_name == "Main"
    area = {"start": {"line": 0, "character": 0}, "end": {"line": 15, "character": 0}}
    hints = [h.label for h in client.ask_all("inlayHint", main, range=area)]
    assert hints == ["1000 mm/s", "50 mm"]


def test_calls(client, folder):
    main = folder / "Main.mod"
    (item,) = client.ask("prepareCallHierarchy", main, "hel|per five")
    data = {
        "name": item.name,
        "kind": 6,
        "uri": item.uri,
        "range": {"start": {"line": 10, "character": 4}, "end": {"line": 13, "character": 11}},
        "selectionRange": {
            "start": {"line": 10, "character": 9},
            "end": {"line": 10, "character": 15},
        },
    }
    (call,) = client.request("callHierarchy/incomingCalls", {"item": data})
    assert (call.from_.name, len(call.from_ranges)) == ("main", 2)
    assert client.request("callHierarchy/outgoingCalls", {"item": data}) == ()


def test_semantic_tokens_and_their_delta(client, folder):
    main = folder / "Main.mod"
    full = client.ask_all("semanticTokens/full", main)
    assert len(full.data) % 5 == 0
    client.change(main, 2, (((6, 15), (6, 19)), "p10"))
    delta = client.ask_all("semanticTokens/full/delta", main, previousResultId=full.result_id)
    (edit,) = delta.edits
    data = list(full.data)
    data[edit.start : edit.start + edit.delete_count] = edit.data
    assert tuple(data) == client.ask_all("semanticTokens/full", main).data


def test_formatting(client, folder):
    main = folder / "Main.mod"
    options = {"tabSize": 4, "insertSpaces": True}
    assert client.ask_all("formatting", main, options=options) == ()
    client.change(main, 2, (((4, 0), (4, 15)), "proc main()"), (((7, 0), (7, 8)), "  "))
    edits = client.ask_all("formatting", main, options=options)
    assert [e.new_text for e in edits] == [
        "    PROC main()\n",
        "        MoveL p10, v1000, z50, tool0;\n",
    ]
    area = {"start": {"line": 6, "character": 0}, "end": {"line": 8, "character": 0}}
    edits = client.ask_all("rangeFormatting", main, range=area, options=options)
    assert starts(edits) == [(7, 0)]
    client.change(main, 3, (((4, 0), (4, 11)), "    PROC main("))
    with pytest.raises(Failed, match="expected"):
        client.ask_all("formatting", main, options=options)
    place = {"line": 7, "character": 31}
    edits = client.ask_all("onTypeFormatting", main, position=place, ch=";", options=options)
    assert [e.new_text for e in edits] == ["        MoveL p10, v1000, z50, tool0;"]


def test_positions_count_utf16_units(folder):
    text = 'MODULE M\nPROC p()\nTPWrite "\U0001f916" + nowhere;\nENDPROC\nENDMODULE\n'
    with Client() as client:
        client.start(folder)
        client.open(folder / "M.mod", text)
        (finding,) = client.findings(folder / "M.mod")
        assert (finding.range.start.character, finding.range.end.character) == (15, 22)
        # The robot is two units: the edit behind it must not split it.
        client.change(folder / "M.mod", 2, (((2, 15), (2, 22)), '"x"'))
        assert client.findings(folder / "M.mod") == ()


def test_files_with_keys_have_findings_hover_and_completion(tmp_path):
    """The place of a completion covers the `-` of an attribute, which is no part of a word."""
    (tmp_path / "SYSPAR").mkdir()
    cfg, project = tmp_path / "SYSPAR" / "EIO.cfg", tmp_path / "rapidgen.toml"
    cfg.write_text('EIO:CFG_1.0:6:1::\n#\nEIO_SIGNAL:\n\n      -Name "do1" -SignalType "DO" -Ac\n')
    project.write_text("strict = 1\nign\n")
    with Client() as client:
        client.start(tmp_path)
        client.open(cfg, language="ini")
        client.open(project, language="toml")
        text = client.ask("hover", cfg, "-Signal|Type").contents.value
        assert "`GO`" in text
        items = client.ask("completion", cfg, "-Ac|\n")
        (access,) = [item for item in items if item.label == "Access"]
        assert access.text_edit.new_text == "-Access "
        area = access.text_edit.range
        assert (area.start.character, area.end.character) == (35, 38)
        (fault,) = client.ask_all("diagnostic", project).items
        assert (fault.code, fault.range.start.line) == ("RG730", 1)
        items = client.ask("completion", project, "\nign|\n")
        assert "ignore = []" in [item.text_edit.new_text for item in items]
        assert "error" in client.ask("hover", project, "str|ict").contents.value
