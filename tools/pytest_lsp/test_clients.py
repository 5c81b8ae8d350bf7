"""The language server as pytest-lsp sees it: a foreign client with the capabilities of editors.

`.ci/pytest_lsp` runs it in an environment of its own, because pytest-lsp brings pytest-asyncio,
which would take over the coroutines of all other tests. pygls checks the type of each answer.
"""

import os
from pathlib import Path

import pytest_lsp
from lsprotocol import types
from pytest_lsp import ClientServerConfig, LanguageClient, client_capabilities

TEXT = """MODULE m
    VAR num count;
    PROC main()
        count := 1;
        nowhere;
        MoveL 
    ENDPROC
ENDMODULE
"""  # noqa: W291  # the place of a completion
OTHER = "MODULE n\nPROC other()\ncount := 2;\nENDPROC\nENDMODULE\n"
SERVER = ClientServerConfig(
    server_command=[os.environ["RAPIDGEN_PYTHON"], "-m", "rapidgen", "lsp"],
    server_env={"PYTHONPATH": os.getcwd(), "PATH": os.environ["PATH"]},
)


@pytest_lsp.fixture(params=["neovim", "visual_studio_code", "emacs"], config=SERVER)
async def client(request, lsp_client: LanguageClient, tmp_path: Path):
    (tmp_path / "m.mod").write_text(TEXT)
    (tmp_path / "n.mod").write_text(OTHER)
    # pytest-lsp declares dynamic registration, and leaves its handler to the test.
    lsp_client.feature(types.CLIENT_REGISTER_CAPABILITY)(lambda _: None)
    folder = types.WorkspaceFolder(uri=tmp_path.as_uri(), name="cell")
    capabilities = client_capabilities(request.param)
    await lsp_client.initialize_session(
        types.InitializeParams(capabilities=capabilities, workspace_folders=[folder])
    )
    yield
    await lsp_client.shutdown_session()


async def test_a_session(client: LanguageClient, tmp_path: Path):
    uri = (tmp_path / "m.mod").as_uri()
    document = types.TextDocumentIdentifier(uri)
    name, argument = types.Position(3, 10), types.Position(5, 14)
    item = types.TextDocumentItem(uri=uri, language_id="rapid", version=1, text=TEXT)
    client.text_document_did_open(types.DidOpenTextDocumentParams(item))
    report = await client.text_document_diagnostic_async(types.DocumentDiagnosticParams(document))
    assert [(d.code, d.range.start.line) for d in report.items] == [("RG201", 6)]

    completion = await client.text_document_completion_async(
        types.CompletionParams(document, argument)
    )
    assert "Offs" in {i.label for i in completion.items}
    signature = await client.text_document_signature_help_async(
        types.SignatureHelpParams(document, argument)
    )
    assert signature.signatures[0].label.startswith("MoveL(")
    hover = await client.text_document_hover_async(types.HoverParams(document, name))
    assert "VAR num count" in hover.contents.value
    definition = await client.text_document_definition_async(types.DefinitionParams(document, name))
    found = definition[0]
    area = found.range if isinstance(found, types.Location) else found.target_selection_range
    assert area.start == types.Position(1, 12)
    renamed = await client.text_document_rename_async(
        types.RenameParams(text_document=document, position=name, new_name="total")
    )
    edits = renamed.changes or {c.text_document.uri: c.edits for c in renamed.document_changes}
    assert {path.rpartition("/")[2]: len(e) for path, e in edits.items()} == {
        "m.mod": 2,
        "n.mod": 1,
    }
    symbols = await client.text_document_document_symbol_async(types.DocumentSymbolParams(document))
    assert symbols[0].name == "m"
    tokens = await client.text_document_semantic_tokens_full_async(
        types.SemanticTokensParams(document)
    )
    assert len(tokens.data) % 5 == 0 < len(tokens.data)

    line = types.Range(types.Position(4, 0), types.Position(6, 0))
    change = types.TextDocumentContentChangePartial(range=line, text="")
    version = types.VersionedTextDocumentIdentifier(version=2, uri=uri)
    client.text_document_did_change(types.DidChangeTextDocumentParams(version, [change]))
    report = await client.text_document_diagnostic_async(types.DocumentDiagnosticParams(document))
    assert not report.items
